"""GPS: on the ellipsoid with an origin, in metres without, and only near the surface."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.sensors.acoustic_world import AcousticWorld, FakeCarrier
from uwsim.base.geodesy import Geodetic
from uwsim.base.geometry import Pose
from uwsim.messages import NavSatFix
from uwsim.sensors.gps_sensor import GpsSensor, GpsSensorSpec

ORIGIN = Geodetic(latitude=math.radians(41.775), longitude=math.radians(3.033))


def make(
    position: tuple[float, float, float],
    origin: Geodetic | None = ORIGIN,
    compatibility: frozenset[str] = frozenset(),
    **fields: float,
) -> GpsSensor:
    """At a place in W, where x is east and the surface at 0; L is north, east, down."""
    world = AcousticWorld(surface_height=0.0, compatibility=compatibility)
    world.earth_origin = origin
    spec = GpsSensorSpec(name="gps", relative_to="base", **fields)
    carrier = FakeCarrier(Pose(np.array(position), np.eye(3)))
    return spec.bind(world, carrier)  # type: ignore[arg-type]


def sampled(sensor: GpsSensor) -> NavSatFix:
    message = sensor.sample(2.5)
    assert message is not None
    return message


def test_it_measures_latitude_and_longitude_where_the_origin_is_given() -> None:
    """1000 m north on the meridian's radius 6 363 834 m (M = a (1-e2) / (1 - e2 sin2)^1.5)."""
    sine = math.sin(ORIGIN.latitude)
    e2 = 0.00669437999014
    radius = 6378137.0 * (1.0 - e2) / (1.0 - e2 * sine**2) ** 1.5
    message = sampled(make((0.0, 1000.0, 0.0)))
    assert message.latitude - 41.775 == pytest.approx(math.degrees(1000.0 / radius), rel=1e-3)
    assert message.longitude == pytest.approx(3.033, abs=1e-12)
    assert message.altitude == pytest.approx(1000.0**2 / (2.0 * radius), rel=1e-2)
    assert (message.status.status, message.status.service) == (0, 1)
    east = sampled(make((500.0, 0.0, 0.0)))
    curvature = 6378137.0 / math.sqrt(1.0 - e2 * sine**2)
    angle = 500.0 / (curvature * math.cos(ORIGIN.latitude))
    assert east.longitude - 3.033 == pytest.approx(math.degrees(angle), rel=1e-6)


def test_a_place_on_earth_and_back() -> None:
    for there in ([0.0, 0.0, 0.0], [1234.5, -678.9, 12.0], [-9000.0, 8000.0, -300.0]):
        back = ORIGIN.north_east_down(ORIGIN.position_at(np.array(there)))
        assert back == pytest.approx(there, abs=1e-8)


def test_without_an_origin_it_measures_metres_as_the_original() -> None:
    for sensor in (
        make((3.0, 7.0, -0.1), origin=None),
        make((3.0, 7.0, -0.1), compatibility=frozenset({"gps-metres"})),
    ):
        message = sampled(sensor)
        assert (message.latitude, message.longitude, message.altitude) == (7.0, 3.0, 0.0)


def test_under_water_there_is_no_fix() -> None:
    message = sampled(make((0.0, 0.0, -0.5)))
    assert message.status.status == NavSatFix().status.STATUS_NO_FIX
    assert math.isnan(message.latitude)
    assert sampled(make((0.0, 0.0, -0.49))).status.status == 0
    assert sampled(make((0.0, 0.0, -0.9), max_depth=1.0)).status.status == 0


def test_the_original_is_silent_under_water() -> None:
    sensor = make((0.0, 0.0, -0.6), compatibility=frozenset({"gps-metres"}))
    assert sensor.sample(0.0) is None


def test_noise_has_its_standard_deviation_in_metres() -> None:
    """3 x 700 samples: within 6 %, 3.9 standard errors (99.99 %)."""
    sensor = make((0.0, 0.0, 0.0), std=0.5)
    errors = []
    for _ in range(700):
        message = sampled(sensor)
        place = Geodetic(
            latitude=math.radians(message.latitude),
            longitude=math.radians(message.longitude),
            altitude=message.altitude,
        )
        errors.append(ORIGIN.north_east_down(place))
    assert np.std(errors) == pytest.approx(0.5, rel=0.06)
    assert sampled(sensor).position_covariance == pytest.approx((0.25 * np.eye(3)).ravel())
