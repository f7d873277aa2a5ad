r"""The share of each wave length in the slopes of ripples.

The saturation :math:`B(k)` is the variance of slopes for each unit of the logarithm of the wave
number. Its form is that of a fully developed sea after T. Elfouhaily, B. Chapron, K. Katsaros and
D. Vandemark (*J. Geophys. Res.* 102, 15781 (1997), equations 31 to 49), with the inverse wave age
:math:`\Omega = 0.84`, the peak :math:`k_p = g \Omega^2 / W^2`, the phase speed :math:`c`, and its
least value :math:`c_m` = 0.23 m/s at :math:`k_m`:

.. math::
    B &= \frac{\alpha_p}{2} \frac{c_p}{c}\, e^{-1.25 (k_p/k)^2 - 0.266 (\sqrt{k/k_p} - 1)}
        + \frac{\alpha_m}{2} \frac{c_m}{c}\, e^{-(k/k_m - 1)^2/4} \\
    \alpha_p &= 0.006 \sqrt{\Omega}, \quad
    \alpha_m = 0.01 \max\left(1 + (1 \text{ or } 3) \ln \frac{u_*}{c_m},\, 0\right)

where 3 is that of :math:`u_* > c_m`, and :math:`u_*^2 = (0.8 + 0.065\, W)\, 10^{-3}\, W^2` (J. Wu,
*J. Geophys. Res.* 87, 9704 (1982)). From 4 to 10 m/s the sum over all waves has the slopes of Cox
and Munk within 12 %; `ripples` makes it exact.

In light wind a film of natural surfactants lies on water: *slicks* and pools are smooth. In the
slicks of C. Cox and W. Munk (*J. Opt. Soc. Am.* 44, 838 (1954)) waves shorter than one foot were
missing. So the share :math:`e^{-(0.3 \text{m} / \lambda)^2}` of the waves is left in winds up to 2
m/s, and from 4 m/s on, where breaking waves disperse films, all are. It is this that makes a net of
thin lines: where all lengths have slopes, the short waves blur the light that longer ones focus.

Below 2 m/s the form is that of 2 m/s: waves that are left of it, or come from elsewhere.

Not modelled: the enhancement of the peak, fetch, and slicks beside ruffled water.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from ...base.geometry import Array
from ...base.numerics.elementwise import exp
from ...world import GRAVITY

SURFACE_TENSION = 7.4e-5
"""The surface tension of water over its density [m3/s2]."""
INVERSE_WAVE_AGE = 0.84
"""The inverse wave age of a fully developed sea [1]."""
PEAK_COEFFICIENT, SHORT_COEFFICIENT = 0.006, 0.01
"""The coefficients of the saturation of long and of short waves [1]."""
MIN_WIND = 2.0
"""The least wind speed that has a form of its own [m/s]."""
FILM_WIND, CLEAN_WIND = 2.0, 4.0
"""The wind speeds up to which a film covers the water, and from which on none does [m/s]."""
FILM_LENGTH = 0.3
"""The wave length below which a film damps waves [m]: one foot."""
LIMITS, N_LENGTHS = (0.003, 1000.0), 2048
"""The shortest and the longest waves of the sum over the spectrum [m], and their number."""


def compute_saturation(wave_numbers: Array, wind_speed: float) -> Array:
    """Compute the relative variance of slopes for each unit of the logarithm of the wave number.

    Args:
        wave_numbers: the wave numbers [rad/m].
        wind_speed: the speed of the wind [m/s].
    """
    wind = max(wind_speed, MIN_WIND)
    peak = GRAVITY * (INVERSE_WAVE_AGE / wind) ** 2
    speeds = np.sqrt(GRAVITY / wave_numbers + SURFACE_TENSION * wave_numbers)
    capillary_number = math.sqrt(GRAVITY / SURFACE_TENSION)
    least_speed = math.sqrt(2.0 * GRAVITY / capillary_number)
    decay = INVERSE_WAVE_AGE / math.sqrt(10.0) * (np.sqrt(wave_numbers / peak) - 1.0)
    long_waves = (
        0.5 * PEAK_COEFFICIENT * math.sqrt(INVERSE_WAVE_AGE) * (wind / INVERSE_WAVE_AGE) / speeds
    ) * exp(-1.25 * (peak / wave_numbers) ** 2 - decay)
    friction_speed = wind * math.sqrt(1e-3 * (0.8 + 0.065 * wind))
    log_ratio = math.log(friction_speed / least_speed)
    growth = max(1.0 + (3.0 if log_ratio > 0.0 else 1.0) * log_ratio, 0.0)
    short_waves = (0.5 * SHORT_COEFFICIENT * growth * least_speed / speeds) * exp(
        -0.25 * (wave_numbers / capillary_number - 1.0) ** 2
    )
    film = min(max((CLEAN_WIND - wind_speed) / (CLEAN_WIND - FILM_WIND), 0.0), 1.0)
    damped_share = exp(-((FILM_LENGTH / (2.0 * math.pi) * wave_numbers) ** 2))
    saturation: Array = (long_waves + short_waves) * (1.0 - film + film * damped_share)
    return saturation


@lru_cache(maxsize=64)
def find_slope_share(wind_speed: float, min_length: float, max_length: float) -> float:
    """Return the share of the waves between two lengths [m] in the variance of slopes [1]."""
    step = math.log(LIMITS[1] / LIMITS[0]) / N_LENGTHS
    lengths = LIMITS[0] * exp(step * (np.arange(N_LENGTHS) + 0.5))
    saturation = compute_saturation(2.0 * math.pi / lengths, wind_speed)
    is_between = (lengths >= min_length) & (lengths < max_length)
    return float(saturation[is_between].sum() / saturation.sum())
