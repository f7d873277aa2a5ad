r"""The transfer curve of sRGB (IEC 61966-2-1), between relative light x and stored values s, 0..1.

.. math:: s = 12.92\,x \text{ for } x \le 0.0031308, \quad 1.055\,x^{1/2.4} - 0.055 \text{ above}

Functions of a number are not compiled, so that a start without images compiles nothing.
"""

from __future__ import annotations

from .jit import elementwise

LINEAR_LIMIT = 0.0031308
"""The light below which the curve is a line."""
STORED_LIMIT = 0.04045
"""The stored value below which the curve is a line."""


def encode_number(light: float) -> float:
    """Convert relative light, 0..1, to a stored value."""
    if light <= LINEAR_LIMIT:
        return 12.92 * light
    return float(1.055 * light ** (1.0 / 2.4) - 0.055)


def decode_number(stored_value: float) -> float:
    """Convert a stored value, 0..1, to relative light."""
    if stored_value <= STORED_LIMIT:
        return stored_value / 12.92
    return float(((stored_value + 0.055) / 1.055) ** 2.4)


encode_array = elementwise(encode_number)
"""The function that converts arrays of relative light, 0..1, to stored values."""
decode_array = elementwise(decode_number)
"""The function that converts arrays of stored values, 0..1, to relative light."""
