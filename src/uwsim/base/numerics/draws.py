"""Random numbers in compiled code, bit for bit equal to those of numpy's generator in Python.

A compiled function draws from the same generator object, by the addresses that numpy provides: in
Python the generator then continues after the last number that compiled code has drawn. Normal
numbers are computed as in numpy, by the ziggurat method (Marsaglia and Tsang 2000).
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
"""A record of the type `STREAM` in compiled code."""


def stream_of(generator: np.random.Generator) -> tuple[int, int]:
    """Return the addresses of a generator (`STREAM`), which must not be freed."""
    interface: Any = generator.bit_generator.ctypes
    next_word = ctypes.cast(interface.next_uint64, ctypes.c_void_p).value
    return int(interface.state_address), int(next_word or 0)


@njit
def uniform(stream: Stream) -> float:
    """Draw a uniform number from 0 to 1 (excluded), as ``Generator.random`` does."""
    number: float = float(call_word(stream.next, stream.state) >> np.uint64(11)) * _UNIT_SCALE
    return number


@njit
def normal(stream: Stream) -> float:
    """Draw a standard normal number, as ``Generator.standard_normal`` does."""
    while True:
        word = call_word(stream.next, stream.state)
        layer = np.int64(word & np.uint64(0xFF))
        sign = (word >> np.uint64(8)) & np.uint64(1)
        magnitude = (word >> np.uint64(9)) & np.uint64(0x000FFFFFFFFFFFFF)
        number: float = np.float64(magnitude) * _WIDTHS[layer]
        if sign != np.uint64(0):
            number = -number
        if magnitude < _LAYER_TOPS[layer]:
            return number
        if layer == 0:
            return _tail(stream, magnitude)
        height = _HEIGHTS[layer]
        if (_HEIGHTS[layer - 1] - height) * uniform(stream) + height < math.exp(
            -0.5 * number * number
        ):
            return number


@njit
def _tail(stream: Stream, magnitude: int) -> float:
    """Draw a normal number beyond the lowest layer; its sign is a bit of ``magnitude``."""
    while True:
        distance = -_INVERSE_TAIL * math.log1p(-uniform(stream))
        exponential = -math.log1p(-uniform(stream))
        if exponential + exponential > distance * distance:
            is_negative = (np.uint64(magnitude) >> np.uint64(8)) & np.uint64(1)
            return -(_TAIL + distance) if is_negative != np.uint64(0) else _TAIL + distance
