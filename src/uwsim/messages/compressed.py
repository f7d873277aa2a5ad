"""Compression of images as PNG and JPEG."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

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


def encode_png(
    pixels: npt.NDArray[np.uint8] | npt.NDArray[np.uint16], options: Sequence[int] = ()
) -> bytes:
    """Return a PNG file of colours (h, w, 3) or of values (h, w), of 8 or 16 bit.

    Args:
        pixels: the numbers of the pixels.
        options: OpenCV's options of the compression; any keep the numbers of the pixels.
    """
    return _encode(pixels, "png", options).tobytes()


def _compress(image: Image, name: str, options: Sequence[int]) -> CompressedImage:
    file_bytes = _encode(pixels_of(image), name, options)
    text = f"{image.encoding}; {name} compressed"
    return CompressedImage(header=image.header, format=text, data=file_bytes.reshape(-1))


def _encode(pixels: npt.NDArray[Any], name: str, options: Sequence[int]) -> npt.NDArray[np.uint8]:
    bgr_pixels = pixels if pixels.ndim == 2 else cv2.cvtColor(pixels, cv2.COLOR_RGB2BGR)
    _, file_bytes = cv2.imencode(f".{name}", bgr_pixels, options)
    return np.asarray(file_bytes, dtype=np.uint8)
