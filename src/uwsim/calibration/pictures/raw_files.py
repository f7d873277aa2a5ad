"""Raw files of a camera (DNG), by the optional package rawpy, a wrapper of LibRaw.

A colour of a raw picture is the mean of the pixels of that colour in each cell of 2 by 2 pixels.
The picture has half of the rows and columns, and half of the focal length in pixels. The black
level that the file states is subtracted, so that full scale is the white level less it.
"""

from __future__ import annotations

import importlib
import importlib.util
import io
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import AssetError, MissingExtra
from ...optics.phase_function import FloatArray

SUFFIXES = (".dng",)
CELL = 2
"""The rows and columns of a cell of the Bayer pattern."""


def decode_raw(path: Path, data: bytes, max_pixels: int) -> FloatArray:
    """Decode a raw file to red, green and blue, (rows, columns, 3).

    Raises:
        MissingExtra: rawpy is not installed.
        AssetError: the file is damaged, too large, or has no Bayer pattern.
    """
    if importlib.util.find_spec("rawpy") is None:
        raise MissingExtra(
            f"{path}: raw files need rawpy, which is not installed. Install it with: "
            "pip install 'uwsim[raw]'; 16-bit TIFF does not need it."
        )
    rawpy: Any = importlib.import_module("rawpy")
    try:
        with rawpy.RawPy() as raw_file:
            raw_file.open_buffer(io.BytesIO(data))
            sizes = raw_file.sizes  # known before the pixels are decoded
            if sizes.raw_height * sizes.raw_width > max_pixels:
                raise AssetError(
                    f"{path}: has {sizes.raw_height}x{sizes.raw_width} pixels; expected at most "
                    f"{max_pixels}."
                )
            raw_file.unpack()
            numbers = np.array(raw_file.raw_image_visible, dtype=np.float64)
            colours = np.array(raw_file.raw_colors_visible)
            names = raw_file.color_desc.decode("ascii", errors="replace")
            black_levels = list(raw_file.black_level_per_channel)
    except (rawpy.LibRawError, ValueError, AttributeError) as error:
        raise AssetError(f"{path}: is not a raw file that LibRaw reads: {error!s:.100}") from None
    if numbers.ndim != 2 or not set("RGB") <= set(names):
        raise AssetError(f"{path}: has no Bayer pattern; convert it to 16-bit TIFF.")
    return average_cells(numbers, colours, names, black_levels)


def average_cells(
    numbers: FloatArray, colours: np.ndarray, names: str, black_levels: list[int]
) -> FloatArray:
    """Average the pixels of each colour in cells of 2 by 2 pixels, without the black level.

    Args:
        numbers: the numbers of the sensor, (rows, columns).
        colours: the index of each pixel's colour, of the same shape.
        names: the letter of each index, such as RGBG.
        black_levels: the black level of each index.
    """
    rows, columns = numbers.shape[0] // CELL * CELL, numbers.shape[1] // CELL * CELL
    light = numbers - np.array(black_levels, dtype=np.float64)[colours]
    planes = []
    for letter in "RGB":
        indices = [index for index, name in enumerate(names) if name == letter]
        mask = np.isin(colours, indices)[:rows, :columns].astype(np.float64)
        total = _sum_cells(light[:rows, :columns] * mask)
        planes.append(total / np.maximum(_sum_cells(mask), 1.0))
    return np.stack(planes, axis=-1)


def _sum_cells(values: FloatArray) -> FloatArray:
    rows, columns = values.shape[0] // CELL, values.shape[1] // CELL
    total: FloatArray = values.reshape(rows, CELL, columns, CELL).sum(axis=(1, 3))
    return total
