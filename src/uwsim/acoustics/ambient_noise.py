r"""Ambient noise of the sea from turbulence, ships, wind and thermal agitation of the water.

The formulas of R. F. W. Coates, *Underwater acoustic systems*, 1990, for the curves of Wenz, as in
M. Stojanovic, *On the relationship between capacity and distance in an underwater acoustic
communication channel*, 2007. With the frequency f in kHz, the shipping activity s from 0 to 1 and
the wind speed w in m/s, the spectral levels of the four sources, in dB re 1 uPa^2/Hz, are

.. math::

    N_t &= 17 - 30 \log f \\
    N_s &= 40 + 20 (s - 0.5) + 26 \log f - 60 \log(f + 0.03) \\
    N_w &= 50 + 7.5 \sqrt{w} + 20 \log f - 40 \log(f + 0.4) \\
    N_{th} &= -15 + 20 \log f

and the powers of the sources add up. Not modelled: rain, animals, the vehicle's own thrusters.
"""

from __future__ import annotations

import math
from collections.abc import Iterable


def ambient_noise(frequency: float, *, shipping: float, wind_speed: float) -> float:
    """Return the spectral level of the noise, in dB re 1 uPa^2/Hz.

    Args:
        frequency: the frequency [Hz].
        shipping: the shipping activity, from 0 (few ships) to 1 (heavy traffic) [1].
        wind_speed: the wind speed at the surface [m/s].
    """
    f = frequency / 1000.0
    log_f = math.log10(f)
    ships = 40.0 + 20.0 * (shipping - 0.5) + 26.0 * log_f - 60.0 * math.log10(f + 0.03)
    wind = 50.0 + 7.5 * math.sqrt(wind_speed) + 20.0 * log_f - 40.0 * math.log10(f + 0.4)
    return power_sum((17.0 - 30.0 * log_f, ships, wind, -15.0 + 20.0 * log_f))


def power_sum(levels: Iterable[float]) -> float:
    """Return the level of the summed power of incoherent sources from their levels [dB]."""
    return 10.0 * math.log10(math.fsum(10.0 ** (level / 10.0) for level in levels))
