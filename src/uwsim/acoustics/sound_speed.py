"""Speed of sound in sea water, after Mackenzie.

K. V. Mackenzie, *Nine-term equation for sound speed in the oceans*, J. Acoust. Soc. Am. 70(3),
1981: for 2 to 30 degrees Celsius, salinities of 25 to 40 and depths to 8000 m, there to 0.07 m/s.
In fresh water of 15 degrees Celsius it gives 0.8 m/s less than Bilaniuk and Wong (1993) measured.
"""

from __future__ import annotations


def sound_speed(*, temperature: float, salinity: float, depth: float) -> float:
    """Return the speed of sound [m/s].

    Args:
        temperature: of the water [degrees Celsius].
        salinity: on the practical scale [g/kg].
        depth: below the surface [m].
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
