r"""The magnetic field of the Earth that PX4's magnetometer measures.

The field is the negative gradient of the potential

.. math::

    V = a \sum_{n=1}^{12} \Bigl(\frac{a}{r}\Bigr)^{n+1} \sum_{m=0}^{n}
        (g_n^m \cos m\lambda + h_n^m \sin m\lambda) P_n^m(\cos\theta)

with the radius r, the longitude :math:`\lambda` and the colatitude :math:`\theta` about the
Earth's centre, a = 6371.2 km, and Schmidt's semi-normalized Legendre functions P. The coefficients
are those of the World Magnetic Model WMM2025 at its epoch 2025.0 (NOAA NCEI and BGS, file
WMM2025.COF, public domain). PX4 takes the declination from a table of a World Magnetic Model.

Not modelled: the change with the years (up to 0.2 degrees per year in most seas), the crust, iron
of the vehicle and of the seabed, currents of the thrusters.
"""

from __future__ import annotations

import math

import numpy as np

from ...base.geodesy import Geodetic
from ...base.geometry import Array

RADIUS = 6371200.0
"""The reference radius a [m]."""
DEGREE = 12
"""The greatest degree n."""
LEAST_SINE = 1e-9
"""The least sine of the colatitude, at which the field of a pole is computed [1]."""
COEFFICIENTS = (
    "-29351.8 0, -1410.8 4545.4; "
    "-2556.6 0, 2951.1 -3133.6, 1649.3 -815.1; "
    "1361 0, -2404.1 -56.6, 1243.8 237.5, 453.6 -549.5; "
    "895 0, 799.5 278.6, 55.7 -133.9, -281.1 212, 12.1 -375.6; "
    "-233.2 0, 368.9 45.4, 187.2 220.2, -138.7 -122.9, -142 43, 20.9 106.1; "
    "64.4 0, 63.8 -18.4, 76.9 16.8, -115.7 48.8, -40.9 -59.8, 14.9 10.9, -60.7 72.7; "
    "79.5 0, -77 -48.9, -8.8 -14.4, 59.3 -1, 15.8 23.4, 2.5 -7.4, -11.1 -25.1, "
    "14.2 -2.3; "
    "23.2 0, 10.8 7.1, -17.5 -12.6, 2 11.4, -21.7 -9.7, 16.9 12.7, 15 0.7, -16.8 -5.2, "
    "0.9 3.9; "
    "4.6 0, 7.8 -24.8, 3 12.2, -0.2 8.3, -2.5 -3.3, -13.1 -5.2, 2.4 7.2, 8.6 -0.6, "
    "-8.7 0.8, -12.9 10; "
    "-1.3 0, -6.4 3.3, 0.2 0, 2 2.4, -1 5.3, -0.6 -9.1, -0.9 0.4, 1.5 -4.2, 0.9 -3.8, "
    "-2.7 0.9, -3.9 -9.1; "
    "2.9 0, -1.5 0, -2.5 2.9, 2.4 -0.6, -0.6 0.2, -0.1 0.5, -0.6 -0.3, -0.1 -1.2, "
    "1.1 -1.7, -1 -2.9, -0.2 -1.8, 2.6 -2.3; "
    "-2 0, -0.2 -1.3, 0.3 0.7, 1.2 1, -1.3 -1.4, 0.6 -0, 0.6 0.6, 0.5 -0.1, -0.1 0.8, "
    "-0.4 0.1, -0.2 -1, -1.3 0.1, -0.7 0.2"
)
"""The pairs g, h for m = 0 to n, for each degree n from 1 [nT]."""


def magnetic_field(place: Geodetic) -> Array:
    """Return the field at a place, north, east and down, (3,) [T]."""
    x, y, z = place.earth_centred.tolist()
    radius = math.sqrt(x * x + y * y + z * z)
    cosine = z / radius
    sine = max(math.sqrt(x * x + y * y) / radius, LEAST_SINE)
    longitude = place.longitude
    legendre, slopes = _legendre(cosine, sine)
    south, east, up = 0.0, 0.0, 0.0
    for n, pairs in enumerate(COEFFICIENTS.split(";"), start=1):
        factor = (RADIUS / radius) ** (n + 2)
        for m, pair in enumerate(pairs.split(",")):
            g, h = map(float, pair.split())
            even_part = g * math.cos(m * longitude) + h * math.sin(m * longitude)
            odd_part = h * math.cos(m * longitude) - g * math.sin(m * longitude)
            up += factor * (n + 1) * even_part * legendre[n][m]
            south -= factor * even_part * slopes[n][m]
            east -= factor * m * odd_part * legendre[n][m] / sine
    # from the sphere's axes to those of the ellipsoid
    angle = math.asin(cosine) - place.latitude
    north, down = -south, -up
    field: Array = 1e-9 * np.array(
        [
            north * math.cos(angle) - down * math.sin(angle),
            east,
            north * math.sin(angle) + down * math.cos(angle),
        ]
    )
    return field


def _legendre(cosine: float, sine: float) -> tuple[list[list[float]], list[list[float]]]:
    """Return the functions P of n and m, and their derivatives with respect to the colatitude."""
    values = [[0.0] * (DEGREE + 1) for _ in range(DEGREE + 1)]
    slopes = [[0.0] * (DEGREE + 1) for _ in range(DEGREE + 1)]
    values[0][0] = 1.0
    for n in range(1, DEGREE + 1):
        scale = math.sqrt((2 * n - 1) / (2 * n)) if n > 1 else 1.0
        values[n][n] = scale * sine * values[n - 1][n - 1]
        slopes[n][n] = scale * (cosine * values[n - 1][n - 1] + sine * slopes[n - 1][n - 1])
        for m in range(n):
            factor = math.sqrt((n - 1) ** 2 - m * m)
            value_below = values[n - 2][m] if n > 1 else 0.0
            slope_below = slopes[n - 2][m] if n > 1 else 0.0
            norm = math.sqrt(n * n - m * m)
            values[n][m] = ((2 * n - 1) * cosine * values[n - 1][m] - factor * value_below) / norm
            slope = cosine * slopes[n - 1][m] - sine * values[n - 1][m]
            slopes[n][m] = ((2 * n - 1) * slope - factor * slope_below) / norm
    return values, slopes
