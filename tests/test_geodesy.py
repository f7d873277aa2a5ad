"""Places on the ellipsoid of WGS84 and the local frame there."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.base.geodesy import FLATTENING, SEMI_MAJOR_AXIS, Geodetic

PLACE = Geodetic(latitude=math.radians(41.775), longitude=math.radians(3.033), altitude=12.0)


def test_the_equator_and_the_pole_are_on_the_axes_of_the_ellipsoid() -> None:
    equator = Geodetic(latitude=0.0, longitude=math.pi / 2, altitude=100.0)
    pole = Geodetic(latitude=math.pi / 2, longitude=1.0)
    assert np.allclose(equator.earth_centred, [0.0, 6378237.0, 0.0], atol=1e-9)
    assert np.allclose(pole.earth_centred, [0.0, 0.0, 6356752.314245], atol=1e-6)


def test_the_local_axes_are_right_handed_and_point_north_east_and_down() -> None:
    axes = PLACE.axes
    assert np.allclose(axes.T @ axes, np.eye(3), atol=1e-15)
    assert np.linalg.det(axes) == pytest.approx(1.0)
    higher = Geodetic(latitude=PLACE.latitude, longitude=PLACE.longitude, altitude=22.0)
    assert np.allclose(PLACE.north_east_down(higher), [0.0, 0.0, -10.0], atol=1e-8)


def test_small_angles_are_arcs_of_the_radii_of_curvature() -> None:
    sine = math.sin(PLACE.latitude)
    e2 = FLATTENING * (2.0 - FLATTENING)
    across = SEMI_MAJOR_AXIS / math.sqrt(1.0 - e2 * sine**2)
    along = across * (1.0 - e2) / (1.0 - e2 * sine**2)
    there = Geodetic(
        latitude=PLACE.latitude + 1e-6, longitude=PLACE.longitude + 2e-6, altitude=12.0
    )
    east = (across + 12.0) * math.cos(there.latitude) * 2e-6
    assert np.allclose(PLACE.north_east_down(there), [(along + 12.0) * 1e-6, east, 0.0], atol=5e-5)


def test_ten_kilometres_away_the_sea_lies_eight_metres_below_the_plane() -> None:
    origin = Geodetic(latitude=0.7, longitude=0.0)
    far = Geodetic(latitude=0.7 + 10e3 / 6.37e6, longitude=0.0)
    assert origin.north_east_down(far)[2] == pytest.approx(7.85, abs=0.1)
