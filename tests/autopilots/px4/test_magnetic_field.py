"""Tests of the magnetic field against the values that NOAA publishes for WMM2025."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.autopilots.px4 import magnetic_field
from uwsim.base.geodesy import Geodetic


def field_at(latitude, longitude, altitude=0.0):
    place = Geodetic(
        latitude=math.radians(latitude), longitude=math.radians(longitude), altitude=altitude
    )
    return 1e9 * magnetic_field(place)  # [nT]


@pytest.mark.parametrize(
    ("latitude", "longitude", "altitude", "declination"),
    [
        (80.0, 0.0, 0.0, 1.28),
        (0.0, 120.0, 0.0, -0.16),
        (-80.0, 240.0, 0.0, 68.78),
        (80.0, 0.0, 1e5, 0.85),
        (0.0, 120.0, 1e5, -0.15),
        (-80.0, 240.0, 1e5, 68.21),
    ],
)
def test_the_declination_is_that_of_the_published_test_values(
    latitude, longitude, altitude, declination
):
    north, east, _ = field_at(latitude, longitude, altitude)
    assert math.degrees(math.atan2(east, north)) == pytest.approx(declination, abs=0.005)


def test_the_field_has_no_divergence():
    """Sum the flux through the faces of a cube of 2 km, which is 0 for every magnetic field."""
    centre = Geodetic(latitude=0.7, longitude=0.05)
    flux, mean = 0.0, 0.0
    for axis in range(3):
        for sign in (-1.0, 1.0):
            offset = np.zeros(3)
            offset[axis] = 1000.0 * sign
            place = centre.position_at(offset)
            earth_field = place.axes @ magnetic_field(place)
            flux += sign * float(centre.axes[:, axis] @ earth_field)
            mean += abs(float(centre.axes[:, axis] @ earth_field))
    assert abs(flux) < 1e-6 * mean


def test_the_field_is_finite_at_the_poles():
    assert np.isfinite(field_at(90.0, 0.0)).all()
    assert field_at(90.0, 0.0)[2] == pytest.approx(56845.7, rel=0.01)
