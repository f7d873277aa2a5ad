r"""Latitude, longitude and altitude on the ellipsoid of WGS84, and the local north, east and down.

National Imagery and Mapping Agency, TR8350.2, 1997: with the semi-major axis a, the square of the
eccentricity :math:`e^2 = f (2 - f)` and the radius of curvature :math:`N = a / \sqrt{1 - e^2
\sin^2 \varphi}`,

.. math::

    x &= (N + h) \cos\varphi \cos\lambda \\
    y &= (N + h) \cos\varphi \sin\lambda \\
    z &= ((1 - e^2) N + h) \sin\varphi .

The local frame is a plane that touches the ellipsoid at its origin: at 10 km from there it is 8 m
above it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .geometry import Array
from .numerics.linear import rotate, rotate_back

SEMI_MAJOR_AXIS = 6378137.0
"""Of the ellipsoid [m]."""
FLATTENING = 1.0 / 298.257223563
"""Of the ellipsoid [1]."""


@dataclass(frozen=True, kw_only=True)
class Geodetic:
    """A place on Earth."""

    latitude: float
    """[rad]."""
    longitude: float
    """[rad]."""
    altitude: float = 0.0
    """Above the ellipsoid [m]."""

    @property
    def earth_centred(self) -> Array:
        """Its coordinates in the frame that turns with the Earth, (3,) [m]."""
        sine, cosine = math.sin(self.latitude), math.cos(self.latitude)
        e2 = FLATTENING * (2.0 - FLATTENING)
        curvature = SEMI_MAJOR_AXIS / math.sqrt(1.0 - e2 * sine * sine)
        level = (curvature + self.altitude) * cosine
        return np.array(
            [
                level * math.cos(self.longitude),
                level * math.sin(self.longitude),
                ((1.0 - e2) * curvature + self.altitude) * sine,
            ]
        )

    @property
    def axes(self) -> Array:
        """North, east and down as columns in the Earth's frame, (3, 3)."""
        sine, cosine = math.sin(self.latitude), math.cos(self.latitude)
        east, north = math.sin(self.longitude), math.cos(self.longitude)
        return np.array(
            [
                [-sine * north, -east, -cosine * north],
                [-sine * east, north, -cosine * east],
                [cosine, 0.0, -sine],
            ]
        )

    def north_east_down(self, place: Geodetic) -> Array:
        """Return where another place is in the local frame of this one, (3,) [m]."""
        return rotate_back(self.axes, place.earth_centred - self.earth_centred)

    def place(self, north_east_down: Array) -> Geodetic:
        """Return the place at these local coordinates (3,) [m]: the inverse of the above.

        By iterating over the latitude; altitudes as Bowring's, Survey Review 28, 1985. Exact to
        1e-8 m near the ellipsoid.
        """
        x, y, z = (self.earth_centred + rotate(self.axes, north_east_down)).tolist()
        e2 = FLATTENING * (2.0 - FLATTENING)
        level = math.hypot(x, y)
        latitude = math.atan2(z, level * (1.0 - e2))
        for _ in range(8):
            sine = math.sin(latitude)
            curvature = SEMI_MAJOR_AXIS / math.sqrt(1.0 - e2 * sine * sine)
            latitude = math.atan2(z + e2 * curvature * sine, level)
        sine, cosine = math.sin(latitude), math.cos(latitude)
        root = math.sqrt(1.0 - e2 * sine * sine)
        altitude = level * cosine + z * sine - SEMI_MAJOR_AXIS * root
        return Geodetic(latitude=latitude, longitude=math.atan2(y, x), altitude=altitude)
