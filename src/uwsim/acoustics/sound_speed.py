"""Speed of sound in sea water, after Mackenzie.

K. V. Mackenzie, *Nine-term equation for sound speed in the oceans*, J. Acoust. Soc. Am. 70(3),
1981. Its error is 0.07 m/s between 2 and 30 degrees Celsius, salinities of 25 and 40 and depths of
0 and 8000 m. In fresh water of 15 degrees Celsius the result is 0.8 m/s below the measurement of
Bilaniuk and Wong (1993).
"""

from __future__ import annotations


def sound_speed(*, temperature: float, salinity: float, depth: float) -> float:
    """Return the speed of sound [m/s].

    Args:
        temperature: the temperature of the water [degrees Celsius].
        salinity: the practical salinity [g/kg].
        depth: the depth below the surface [m].
    """
    t, s, d = temperature, salinity - 35.0, depth
    return (
        1448.96
        + 4.591 * t
        - 5.304e-2 * t**2
        + 2.374e-4 * t**3
        + 1.340 * s
        + 1.630e-2 * d
        + 1.675e-7 * d**2
        - 1.025e-2 * t * s
        - 7.139e-13 * t * d**3
    )
