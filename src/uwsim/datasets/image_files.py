"""The image files of a data set: colour, depth, instance and class masks."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt

from ..errors import ResultError, name_file_in_errors
from ..messages.compressed import encode_png
from .pixel_counts import round_millimetres

JPEG_QUALITY = 95
"""The quality of JPEG images, 0 to 100."""
COLOUR_PNG = (
    cv2.IMWRITE_PNG_STRATEGY,
    cv2.IMWRITE_PNG_STRATEGY_HUFFMAN_ONLY,
    cv2.IMWRITE_PNG_FILTER,
    cv2.IMWRITE_PNG_FILTER_SUB,
)
"""The compression of colours: noise and particles have few repeated bytes to search for."""
DEPTH_PNG = (
    cv2.IMWRITE_PNG_STRATEGY,
    cv2.IMWRITE_PNG_STRATEGY_DEFAULT,
    cv2.IMWRITE_PNG_FILTER,
    cv2.IMWRITE_PNG_FILTER_SUB,
)
"""The compression of depths, whose differences repeat on planes."""
MASK_PNG = (
    cv2.IMWRITE_PNG_STRATEGY,
    cv2.IMWRITE_PNG_STRATEGY_DEFAULT,
    cv2.IMWRITE_PNG_FILTER,
    cv2.IMWRITE_PNG_FILTER_NONE,
)
"""The compression of masks, whose rows repeat."""
MAX_DEPTH_MM = np.float32(65535.0)
"""The greatest depth in a 16-bit image [mm]; greater depths are stored as this number."""
SONAR_FOLDERS = ("images", "instances", "classes")
"""The folders of sonar images and masks."""
FOLDERS = ("images", "depth", "instances", "classes")
"""The folders of colour images, depths, and masks."""
SUFFIXES = {"png": ".png", "jpeg": ".jpg"}
"""The suffix of colour images by encoding."""
FILE_ENDS = {".png": b"IEND\xaeB`\x82", ".jpg": b"\xff\xd9"}
"""The last bytes of a complete image by suffix."""


def encode_colour(pixels: npt.NDArray[np.uint8], encoding: str) -> bytes:
    """Return the file of a colour image (h, w, 3) or a grey one (h, w)."""
    if encoding == "png":
        return encode_png(pixels, COLOUR_PNG)
    image = pixels if pixels.ndim == 2 else cv2.cvtColor(pixels, cv2.COLOR_RGB2BGR)
    return cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])[1].tobytes()


def encode_depth(depth: npt.NDArray[np.float32]) -> bytes:
    """Return the file of depths (h, w) [m]: millimetres, rounded to nearest; 0: no surface."""
    return encode_png(round_millimetres(depth, MAX_DEPTH_MM), DEPTH_PNG)


def encode_mask(mask: npt.NDArray[np.uint8] | npt.NDArray[np.uint16]) -> bytes:
    """Return the file of a mask, (h, w)."""
    return encode_png(mask, MASK_PNG)


def file_paths(index: int, encoding: str, folders: Sequence[str] = FOLDERS) -> dict[str, str]:
    """Return the path of each file of an image, relative to the data set."""
    return {
        folder: f"{folder}/{index:06d}{SUFFIXES[encoding] if folder == 'images' else '.png'}"
        for folder in folders
    }


def is_complete(path: Path) -> bool:
    """Return whether an image is there with its last bytes; the others are not read."""
    end = FILE_ENDS[path.suffix]
    try:
        with path.open("rb") as file:
            file.seek(-len(end), os.SEEK_END)
            return file.read() == end
    except OSError:
        return False


def write_file(path: Path, content: bytes) -> None:
    """Write a file; a file that an interruption leaves incomplete is written again."""
    with name_file_in_errors(path):
        path.write_bytes(content)


def read_colour(path: Path) -> npt.NDArray[np.uint8]:
    """Return a colour image, (h, w, 3); raise ResultError if damaged."""
    pixels = cv2.imread(str(path))
    if pixels is None:
        raise _make_error(path)
    return np.ascontiguousarray(np.asarray(pixels, dtype=np.uint8)[..., ::-1])


def read_values(path: Path) -> npt.NDArray[np.uint16]:
    """Return the numbers of a mask or a depth image, (h, w); raise ResultError if damaged."""
    values = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    if values is None or values.ndim != 2:
        raise _make_error(path)
    return np.asarray(values, dtype=np.uint16)


def _make_error(path: Path) -> ResultError:
    return ResultError(f"{path}: is damaged. Remove the file, and make the data set again.")
