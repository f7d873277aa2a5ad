"""Compression of images as PNG and JPEG."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np

from .build import pixels_of
from .sensor_msgs import CompressedImage, Image

JPEG_QUALITY = 90
"""The quality of JPEG images, 0 to 100."""


def as_png(image: Image) -> CompressedImage:
    """Return an ``rgb8`` or ``mono8`` image as PNG, without loss."""
    return _compress(image, "png", ())


def as_jpeg(image: Image) -> CompressedImage:
    """Return an ``rgb8`` or ``mono8`` image as JPEG."""
    return _compress(image, "jpeg", (cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY))


def _compress(image: Image, name: str, options: Sequence[int]) -> CompressedImage:
    pixels = pixels_of(image)
    bgr_pixels = pixels if pixels.ndim == 2 else np.ascontiguousarray(pixels[..., ::-1])
    _, file_bytes = cv2.imencode(f".{name}", bgr_pixels, options)
    text = f"{image.encoding}; {name} compressed"
    return CompressedImage(header=image.header, format=text, data=file_bytes.reshape(-1))
