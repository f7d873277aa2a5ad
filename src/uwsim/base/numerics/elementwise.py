"""Elementwise functions of arrays with identical results on every processor.

numpy has several codes for each of these and chooses by the processor; they differ in the last bit
(those that do not, such as the sine, the cosine and the square root, are not here). These call the
C library's for each element, which are the same on every processor since 2015: only older ones lack
the fused multiply-add that they use. Beyond where a function is defined they give NaN or infinity,
as numpy's do.
"""

from __future__ import annotations

import math

from .jit import elementwise


@elementwise
def arccos(x: float) -> float:
    """Arc cosine [rad]."""
    return math.acos(x)


@elementwise
def arccosh(x: float) -> float:
    """Inverse hyperbolic cosine."""
    return math.acosh(x)


@elementwise
def arcsin(x: float) -> float:
    """Arc sine [rad]."""
    return math.asin(x)


@elementwise
def arcsinh(x: float) -> float:
    """Inverse hyperbolic sine."""
    return math.asinh(x)


@elementwise
def arctan(x: float) -> float:
    """Arc tangent [rad]."""
    return math.atan(x)


@elementwise
def arctanh(x: float) -> float:
    """Inverse hyperbolic tangent."""
    return math.atanh(x)


@elementwise
def cosh(x: float) -> float:
    """Hyperbolic cosine."""
    return math.cosh(x)


@elementwise
def exp(x: float) -> float:
    """Exponential function."""
    return math.exp(x)


@elementwise
def log(x: float) -> float:
    """Natural logarithm."""
    return math.log(x)


@elementwise
def log10(x: float) -> float:
    """Decimal logarithm."""
    return math.log10(x)


@elementwise
def log2(x: float) -> float:
    """Binary logarithm."""
    return math.log2(x)


@elementwise
def sinh(x: float) -> float:
    """Hyperbolic sine."""
    return math.sinh(x)


@elementwise
def tan(x: float) -> float:
    """Tangent of an angle [rad]."""
    return math.tan(x)


@elementwise
def tanh(x: float) -> float:
    """Hyperbolic tangent."""
    return math.tanh(x)


@elementwise
def arctan2(y: float, x: float) -> float:
    """Angle of the point (x, y) [rad]."""
    return math.atan2(y, x)


@elementwise
def power(x: float, y: float) -> float:
    """``x`` to the power ``y``."""
    return math.pow(x, y)
