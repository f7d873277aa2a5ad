"""Elementwise functions of arrays with identical results on every processor.

numpy has several implementations of each of these functions and chooses by the processor; their
results differ in the last bit. (Its sine, cosine and square root do not, so they are not here.) The
functions below call the C library for each element. It gives the same results on all processors
since 2015; older ones lack the fused multiply-add that it uses. Outside of its domain a function
gives NaN or infinity, as in numpy.
"""

from __future__ import annotations

import math

from .jit import elementwise


@elementwise
def arccos(x: float) -> float:
    """Return the arc cosine [rad]."""
    return math.acos(x)


@elementwise
def arccosh(x: float) -> float:
    """Return the inverse hyperbolic cosine."""
    return math.acosh(x)


@elementwise
def arcsin(x: float) -> float:
    """Return the arc sine [rad]."""
    return math.asin(x)


@elementwise
def arcsinh(x: float) -> float:
    """Return the inverse hyperbolic sine."""
    return math.asinh(x)


@elementwise
def arctan(x: float) -> float:
    """Return the arc tangent [rad]."""
    return math.atan(x)


@elementwise
def arctanh(x: float) -> float:
    """Return the inverse hyperbolic tangent."""
    return math.atanh(x)


@elementwise
def cosh(x: float) -> float:
    """Return the hyperbolic cosine."""
    return math.cosh(x)


@elementwise
def exp(x: float) -> float:
    """Return the exponential function."""
    return math.exp(x)


@elementwise
def log(x: float) -> float:
    """Return the natural logarithm."""
    return math.log(x)


@elementwise
def log10(x: float) -> float:
    """Return the decimal logarithm."""
    return math.log10(x)


@elementwise
def log2(x: float) -> float:
    """Return the binary logarithm."""
    return math.log2(x)


@elementwise
def sinh(x: float) -> float:
    """Return the hyperbolic sine."""
    return math.sinh(x)


@elementwise
def tan(x: float) -> float:
    """Return the tangent of an angle [rad]."""
    return math.tan(x)


@elementwise
def tanh(x: float) -> float:
    """Return the hyperbolic tangent."""
    return math.tanh(x)


@elementwise
def arctan2(y: float, x: float) -> float:
    """Return the angle of the point (x, y) [rad]."""
    return math.atan2(y, x)


@elementwise
def power(x: float, y: float) -> float:
    """Return ``x`` to the power ``y``."""
    return math.pow(x, y)
