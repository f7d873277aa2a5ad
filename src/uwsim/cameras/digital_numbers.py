"""Digital numbers of 12 bit, their sRGB values of 8 bit, and the light of stored sRGB values.

The curve is that of `base.numerics.srgb`, with its powers.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import numpy.typing as npt

from ..base.numerics.jit import njit
from ..base.numerics.linear import Array
from ..base.numerics.srgb import decode_array, encode_array

FULL_SCALE = 4095
"""The greatest digital number."""


def encode(light: Array) -> Array:
    """Compute stored values 0..1 of sRGB from relative light, which is clipped to 0..1."""
    return encode_array(np.clip(light, 0.0, 1.0))


@cache
def srgb_table(black_level: float) -> npt.NDArray[np.uint8]:
    """Return the 8-bit sRGB value of each digital number, (4096,); the black level is black."""
    numbers = np.arange(FULL_SCALE + 1, dtype=np.float64)
    stored_values = encode((numbers - black_level) / (FULL_SCALE - black_level))
    table: npt.NDArray[np.uint8] = np.floor(255.0 * stored_values + 0.5).astype(np.uint8)
    return table


@cache
def light_table() -> npt.NDArray[np.float32]:
    """Return the relative light of each sRGB value of 16 bit, (65536,)."""
    light: npt.NDArray[np.float32] = decode_array(np.arange(65536) / 65535.0).astype(np.float32)
    return light


@njit
def look_up(numbers: npt.NDArray[np.uint16], table: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """Return the entry of a table for each number, an array of one shape."""
    values = np.empty(numbers.shape, np.uint8)
    flat_numbers, flat_values = numbers.reshape(-1), values.reshape(-1)
    for index in range(len(flat_numbers)):
        flat_values[index] = table[flat_numbers[index]]
    return values
