"""Images as compressed images."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np

from .build import pixels_of
from .sensor_msgs import CompressedImage, Image

JPEG_QUALITY = 90
"""Of JPEG, 0..100."""


def as_png(image: Image) -> CompressedImage:
    """Return an ``rgb8`` or ``mono8`` image as PNG, without loss."""
    return _compressed(image, "png", ())


def as_jpeg(image: Image) -> CompressedImage:
    """Return an ``rgb8`` or ``mono8`` image as JPEG."""
    return _compressed(image, "jpeg", (cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY))


def _compressed(image: Image, name: str, options: Sequence[int]) -> CompressedImage:
    pixels = pixels_of(image)
    ordered = pixels if pixels.ndim == 2 else np.ascontiguousarray(pixels[..., ::-1])
    _, packed = cv2.imencode(f".{name}", ordered, options)
    return CompressedImage(
        header=image.header, format=f"{image.encoding}; {name} compressed", data=packed.reshape(-1)
    )
