"""Random numbers in compiled code, bit for bit those of the same generator in Python.

A compiled function draws from the generator object itself, by the addresses that numpy provides.
The generator then continues in Python after the last number of the compiled code. Normal numbers
are those of numpy by the ziggurat method (Marsaglia and Tsang 2000), with the tables of numba.
"""

from __future__ import annotations

import ctypes
import math
from typing import Any

import numpy as np
from numba.np.random import _constants  # the tables of numpy's own source

from .calls import call_word
from .jit import njit

STREAM = np.dtype([("state", np.int64), ("next", np.int64)])
"""The addresses of a bit generator's state, and of the function that returns its next 64 bits."""

_LAYER_TOPS, _WIDTHS, _HEIGHTS = _constants.ki_double, _constants.wi_double, _constants.fi_double
_TAIL, _INVERSE_TAIL = float(_constants.ziggurat_nor_r), float(_constants.ziggurat_nor_inv_r)
_UNIT_SCALE = 1.0 / 9007199254740992.0  # 2**-53

Stream = Any
"""A record of `STREAM` in compiled code."""


def stream_of(generator: np.random.Generator) -> tuple[int, int]:
    """Return the numbers of `STREAM` of a generator, which must not be freed."""
    interface: Any = generator.bit_generator.ctypes
    next_word = ctypes.cast(interface.next_uint64, ctypes.c_void_p).value
    return int(interface.state_address), int(next_word or 0)


@njit
def uniform(stream: Stream) -> float:
    """Draw a uniform number from 0 to 1, as ``Generator.random``."""
    number: float = float(call_word(stream.next, stream.state) >> np.uint64(11)) * _UNIT_SCALE
    return number


@njit
def normal(stream: Stream) -> float:
    """Draw a standard normal number, as ``Generator.standard_normal``."""
    while True:
        word = call_word(stream.next, stream.state)
        layer = np.int64(word & np.uint64(0xFF))
        sign = (word >> np.uint64(8)) & np.uint64(1)
        place = (word >> np.uint64(9)) & np.uint64(0x000FFFFFFFFFFFFF)
        number: float = np.float64(place) * _WIDTHS[layer]
        if sign != np.uint64(0):
            number = -number
        if place < _LAYER_TOPS[layer]:
            return number
        if layer == 0:
            return _tail(stream, place)
        height = _HEIGHTS[layer]
        if (_HEIGHTS[layer - 1] - height) * uniform(stream) + height < math.exp(
            -0.5 * number * number
        ):
            return number


@njit
def _tail(stream: Stream, place: int) -> float:
    """Draw a normal number beyond the lowest layer."""
    while True:
        distance = -_INVERSE_TAIL * math.log1p(-uniform(stream))
        exponential = -math.log1p(-uniform(stream))
        if exponential + exponential > distance * distance:
            is_negative = (np.uint64(place) >> np.uint64(8)) & np.uint64(1)
            return -(_TAIL + distance) if is_negative != np.uint64(0) else _TAIL + distance
