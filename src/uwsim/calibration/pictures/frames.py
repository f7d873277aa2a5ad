"""Frames of a camera from files: PNG and TIFF of 8 or 16 bit, NPY, and DNG.

A frame is an array of rows, columns and planes; a grey picture has one plane, a colour picture
red, green and blue. Sizes are checked before a picture is decoded. Raw files need the package rawpy
(`raw_files`). Other raw files become linear 16-bit TIFF by ``dcraw -4 -o 0 -r 1 1 1 1 -h -T``.
"""

from __future__ import annotations

import io
import math
import struct
import warnings
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...base.files.input_files import read_bytes
from ...errors import AssetError
from ...optics.phase_function import FloatArray
from . import raw_files

MAX_BYTES = 256 * 2**20
"""The greatest size of a file [bytes]."""
MAX_PIXELS = 26_000_000
"""The greatest number of pixels of a frame."""
MAX_PLANES = 4
SUFFIXES = (".png", ".tif", ".tiff", ".npy", *raw_files.SUFFIXES)
PHONE_SUFFIXES = (".jpg", ".jpeg", ".heic", ".heif")
"""The suffixes of pictures to which a phone has applied its tone curve."""


@dataclass(frozen=True, eq=False)
class FrameMean:
    """The mean of several frames of the same view, before any correction."""

    values: FloatArray
    """The mean of each pixel, in the numbers of the files, (rows, columns, planes)."""
    variances: FloatArray
    """The variance of the mean by noise, of the same shape; 0 if there is one frame."""
    peaks: FloatArray
    """The greatest number of each pixel in all frames, of the same shape."""


def read_frame(path: Path) -> FloatArray:
    """Read a picture as numbers of the file, (rows, columns, planes).

    Raises:
        AssetError: the file is not a picture of a known format, or is too large.
    """
    if path.suffix.lower() not in SUFFIXES:
        advice = ""
        if path.suffix.lower() in PHONE_SUFFIXES:
            advice = " Its tone curve is unknown: take raw pictures (.dng) with the phone."
        raise AssetError(
            f"{path}: {path.suffix or 'a file without suffix'} is not read; expected "
            f"{', '.join(SUFFIXES)}.{advice}"
        )
    try:
        data = read_bytes(path, at_most=MAX_BYTES)
    except OSError as error:
        raise AssetError(f"{path}: cannot be read: {error.strerror or error}.") from None
    frame = _decode(path, data)
    if frame.ndim == 2:
        frame = frame[..., None]
    if frame.ndim != 3 or not 1 <= frame.shape[2] <= MAX_PLANES or frame.size == 0:
        raise AssetError(
            f"{path}: has the shape {frame.shape}; expected rows, columns and 1 to {MAX_PLANES} "
            "planes."
        )
    values = np.asarray(frame[..., :3], dtype=np.float64)
    if not np.isfinite(values).all():
        raise AssetError(f"{path}: has numbers that are not finite.")
    return values


def average_frames(paths: Iterable[Path]) -> FrameMean:
    """Read frames of the same view and average them.

    Raises:
        AssetError: a file is invalid, or the sizes differ.
    """
    total = squares = peaks = np.zeros((0, 0, 0))
    first, count = Path(), 0
    for path in paths:
        frame = read_frame(path)
        if count == 0:
            first, total, squares, peaks = path, frame.copy(), frame * frame, frame
        elif frame.shape != total.shape:
            raise AssetError(
                f"{path}: has the shape {frame.shape}; expected that of {first.name}, "
                f"{total.shape}."
            )
        else:
            total, squares = total + frame, squares + frame * frame
            peaks = np.maximum(peaks, frame)
        count += 1
    if count == 0:
        raise AssetError("There is no frame.")
    means = total / count
    variances = np.zeros_like(means)
    if count > 1:
        variances = np.maximum(squares / count - means * means, 0.0) / (count - 1)
    return FrameMean(means, variances, peaks)


def _read_array(path: Path, data: bytes) -> FloatArray:
    stream = io.BytesIO(data)
    try:
        shape, number_type = _read_array_header(stream)
    except (ValueError, EOFError, OSError) as error:
        raise AssetError(f"{path}: is not an NPY file: {str(error)[:100]}") from None
    if number_type.kind not in "uif":
        raise AssetError(f"{path}: has no real numbers.")
    _check_size(path, shape[:2])
    n_bytes, n_expected = len(data) - stream.tell(), math.prod(shape) * number_type.itemsize
    if n_bytes < n_expected:
        raise AssetError(
            f"{path}: has {n_bytes} bytes of numbers; expected {n_expected} for the shape {shape} "
            "of its header."
        )
    try:
        return np.asarray(np.load(io.BytesIO(data), allow_pickle=False))
    except (ValueError, EOFError, OSError) as error:
        raise AssetError(f"{path}: is not an NPY file: {str(error)[:100]}") from None


def _read_array_header(stream: io.BytesIO) -> tuple[tuple[int, ...], np.dtype[Any]]:
    """Read the shape and the type of the numbers of an NPY file; the numbers follow."""
    version = np.lib.format.read_magic(stream)
    if version not in ((1, 0), (2, 0)):
        raise ValueError(f"its version is {version}; expected 1 or 2")
    is_first = version == (1, 0)
    read = np.lib.format.read_array_header_1_0 if is_first else np.lib.format.read_array_header_2_0
    shape, _, number_type = read(stream)
    if any(length < 0 for length in shape):
        raise ValueError(f"its shape is {shape}")
    return shape, number_type


def _decode(path: Path, data: bytes) -> FloatArray:
    suffix = path.suffix.lower()
    if suffix == ".npy":
        return _read_array(path, data)
    if suffix in raw_files.SUFFIXES:
        return raw_files.decode_raw(path, data, MAX_PIXELS)
    return _decode_picture(path, data)


def _decode_picture(path: Path, data: bytes) -> FloatArray:
    import cv2
    from PIL import Image, UnidentifiedImageError

    try:
        if path.suffix.lower() == ".png":
            with Image.open(io.BytesIO(data)) as picture:
                size = (picture.height, picture.width)
        else:
            size = _read_tiff_size(data)
    except Image.DecompressionBombError:
        raise AssetError(f"{path}: has too many pixels; expected at most {MAX_PIXELS}.") from None
    except (UnidentifiedImageError, OSError, ValueError, SyntaxError, KeyError, struct.error):
        raise AssetError(f"{path}: is not a picture of the kind that its suffix names.") from None
    _check_size(path, size)
    try:
        frame = cv2.imdecode(np.frombuffer(data, dtype=np.uint8), cv2.IMREAD_UNCHANGED)
    except cv2.error:
        frame = None
    if frame is None:
        raise AssetError(f"{path}: is damaged, or of a kind that is not read.")
    if frame.ndim == 3 and frame.shape[2] >= 3:
        frame = frame[..., 2::-1]  # OpenCV's order is blue, green, red
    return np.asarray(frame)


def _read_tiff_size(data: bytes) -> tuple[int, int]:
    """Return rows and columns of a TIFF file; Pillow cannot open colour of 16 bit."""
    from PIL.TiffImagePlugin import ImageFileDirectory_v2

    stream = io.BytesIO(data)
    directory = ImageFileDirectory_v2(stream.read(8))
    stream.seek(directory.next)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # of damaged files, which lack the tags
        directory.load(stream)
    return int(directory[257]), int(directory[256])


def _check_size(path: Path, size: tuple[int, ...]) -> None:
    if math.prod(size) > MAX_PIXELS:
        raise AssetError(
            f"{path}: has {'x'.join(map(str, size))} pixels; expected at most {MAX_PIXELS}."
        )
