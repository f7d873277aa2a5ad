r"""Latitude, longitude and altitude on the ellipsoid of WGS84, and local NED coordinates.

A position with latitude :math:`\varphi`, longitude :math:`\lambda` and altitude :math:`h` has the
earth-centred, earth-fixed coordinates (National Imagery and Mapping Agency, TR8350.2, 1997)

.. math::

    x &= (N + h) \cos\varphi \cos\lambda \\
    y &= (N + h) \cos\varphi \sin\lambda \\
    z &= ((1 - e^2) N + h) \sin\varphi .

with the semi-major axis :math:`a`, the flattening :math:`f`, the square of the eccentricity
:math:`e^2 = f (2 - f)` and the radius of curvature
:math:`N = a / \sqrt{1 - e^2 \sin^2 \varphi}`. The horizontal plane of a local NED frame is tangent
to the ellipsoid at the frame's origin; at a distance of 10 km it is 8 m above the ellipsoid.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .geometry import Array
from .numerics.linear import rotate, rotate_back

SEMI_MAJOR_AXIS = 6378137.0
"""The semi-major axis of the ellipsoid [m]."""
FLATTENING = 1.0 / 298.257223563
"""The flattening of the ellipsoid [1]."""


@dataclass(frozen=True, kw_only=True)
class Geodetic:
    """A position on Earth."""

    latitude: float
    """The geodetic latitude [rad]."""
    longitude: float
    """The longitude [rad]."""
    altitude: float = 0.0
    """The altitude above the ellipsoid [m]."""

    @property
    def earth_centred(self) -> Array:
        """The earth-centred, earth-fixed coordinates, (3,) [m]."""
        sine, cosine = math.sin(self.latitude), math.cos(self.latitude)
        e2 = FLATTENING * (2.0 - FLATTENING)
        curvature = SEMI_MAJOR_AXIS / math.sqrt(1.0 - e2 * sine * sine)
        axis_distance = (curvature + self.altitude) * cosine
        return np.array(
            [
                axis_distance * math.cos(self.longitude),
                axis_distance * math.sin(self.longitude),
                ((1.0 - e2) * curvature + self.altitude) * sine,
            ]
        )

    @property
    def axes(self) -> Array:
        """The north, east and down axes at this position in the earth-fixed frame, as columns."""
        sine, cosine = math.sin(self.latitude), math.cos(self.latitude)
        east, north = math.sin(self.longitude), math.cos(self.longitude)
        return np.array(
            [
                [-sine * north, -east, -cosine * north],
                [-sine * east, north, -cosine * east],
                [cosine, 0.0, -sine],
            ]
        )

    def north_east_down(self, position: Geodetic) -> Array:
        """Return the coordinates of ``position`` in the NED frame at this position, (3,) [m]."""
        return rotate_back(self.axes, position.earth_centred - self.earth_centred)

    def position_at(self, north_east_down: Array) -> Geodetic:
        """Return the position with coordinates (3,) [m] in the NED frame at this position.

        This is the inverse of `north_east_down`. The latitude is iterated; the altitude is computed
        as in Bowring, Survey Review 28, 1985. The error near the ellipsoid is 1e-8 m.
        """
        x, y, z = (self.earth_centred + rotate(self.axes, north_east_down)).tolist()
        e2 = FLATTENING * (2.0 - FLATTENING)
        axis_distance = math.hypot(x, y)
        latitude = math.atan2(z, axis_distance * (1.0 - e2))
        for _ in range(8):
            sine = math.sin(latitude)
            curvature = SEMI_MAJOR_AXIS / math.sqrt(1.0 - e2 * sine * sine)
            latitude = math.atan2(z + e2 * curvature * sine, axis_distance)
        sine, cosine = math.sin(latitude), math.cos(latitude)
        root = math.sqrt(1.0 - e2 * sine * sine)
        altitude = axis_distance * cosine + z * sine - SEMI_MAJOR_AXIS * root
        return Geodetic(latitude=latitude, longitude=math.atan2(y, x), altitude=altitude)
