r"""The dispersion of linear gravity waves on water of constant depth.

.. math:: \omega^2 = g k \tanh(k h)

Source: Airy; see Dean and Dalrymple, Water Wave Mechanics for Engineers and Scientists (1991),
chapter 3. Not modelled: surface tension, which matters for waves shorter than 2 cm, and the Doppler
shift in a current.
"""

from __future__ import annotations

import numpy as np

from ..base.geometry import Array
from ..base.numerics.elementwise import exp, power, tanh
from ..world import GRAVITY

N_ITERATIONS = 8
"""The number of Newton steps; the error is below 1e-14 after five."""


def wave_numbers(angular_frequencies: Array, depth: float) -> Array:
    r"""Solve the dispersion relation for the wave number, by Newton's method.

    The first guess is :math:`k_0 (1 - e^{-y^{5/4}})^{-2/5}` with :math:`k_0 = \omega^2 / g` and
    :math:`y = \omega \sqrt{h/g}` (Guo 2002, within 0.75 %).

    Args:
        angular_frequencies: the angular frequencies, (n,) [rad/s], above 0.
        depth: the depth of the water [m], above 0.

    Returns:
        The wave numbers, (n,) [rad/m].
    """
    omega = np.asarray(angular_frequencies, dtype=np.float64)
    deep_number = omega**2 / GRAVITY
    y = omega * np.sqrt(depth / GRAVITY)
    k = deep_number / power(1.0 - exp(-power(y, 1.25)), 0.4)
    for _ in range(N_ITERATIONS):
        t = tanh(k * depth)
        slope = t + k * depth * (1.0 - t * t)
        k = k - (k * t - deep_number) / slope
    result: Array = k
    return result
