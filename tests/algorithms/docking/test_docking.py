"""Guidance into docks: the law, the filter of the beacon, and courses of homing."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.algorithms.docking.beacon import FLOOR_STD, BeaconFilter
from uwsim.algorithms.docking.guidance import GAINS, DockingGains, DockingGuidance
from uwsim.algorithms.docking.homing import Homing, HomingLineOfSight
from uwsim.base import rng


def make_guidance() -> DockingGuidance:
    return DockingGuidance(DockingGains(**{name: float(value) for name, value in GAINS.items()}))


def test_on_the_axis_the_vehicle_moves_along_it() -> None:
    # the bow is 0.3 rad to starboard of the axis, which is thus to port
    error = 3.0 * np.array([math.cos(-0.3), math.sin(-0.3), 0.0])
    velocity, rate = make_guidance().command(error, -0.3, 0.1)
    assert velocity == pytest.approx(0.25 * error / 3.0)
    assert rate == pytest.approx(0.8 * -0.3)


def test_beside_the_funnel_the_vehicle_waits_before_it() -> None:
    velocity, _ = make_guidance().command(np.array([1.0, 0.6, 0.0]), 0.0, 0.0)
    assert velocity[0] < 0.0
    assert velocity[1] == pytest.approx(0.48)


def test_a_heading_error_of_more_than_a_turn_is_the_same_error() -> None:
    _, rate = make_guidance().command(np.zeros(3), 0.2 + 4.0 * math.pi, 0.0)
    assert rate == pytest.approx(0.16)


def test_the_filter_averages_replies_as_least_squares_does() -> None:
    # without drift, the estimate is the mean, weighted by the inverse covariances
    stream = rng.stream(0, "tests/beacon")
    beacon, origin = np.array([20.0, 3.0, 1.0]), np.zeros(3)
    estimator = BeaconFilter(0.1, 0.02, 0.0)
    information, weighted_sum = np.zeros((3, 3)), np.zeros(3)
    for k in range(6):
        offset = beacon + 0.2 * stream.standard_normal(3)
        estimator.update(0.5 * k, origin, offset)
        distance = np.sqrt(np.sum(offset**2))
        radial = np.outer(offset, offset) / distance**2
        variance = (0.02 * distance) ** 2 + FLOOR_STD**2
        noise = variance * (np.eye(3) - radial) + (0.1**2 + FLOOR_STD**2) * radial
        information += np.linalg.inv(noise)
        weighted_sum += np.linalg.inv(noise) @ offset
    assert estimator.position == pytest.approx(np.linalg.solve(information, weighted_sum), abs=1e-9)
    assert estimator.covariance == pytest.approx(np.linalg.inv(information), abs=1e-9)


def test_pure_pursuit_points_at_the_beacon() -> None:
    assert Homing().course(3.0, -4.0) == pytest.approx(math.atan2(-4.0, 3.0))


class MovingNavigator:
    """A navigator of a vehicle that is heading north and moves north-east."""

    heading = 0.0

    def __init__(self, north: float, east: float) -> None:
        self.velocity = np.array([north, east, 0.0])


@pytest.mark.parametrize(
    ("east_speed", "crab"), [(0.0, 0.0), (0.5, math.atan2(0.5, 1.0)), (-0.5, -math.atan2(0.5, 1.0))]
)
def test_line_of_sight_turns_the_bow_against_the_current(east_speed: float, crab: float) -> None:
    # the beacon is 2 m to the west of a vehicle on a course to the north
    helmsman = HomingLineOfSight()
    helmsman._numbers = {"axis": 0.0, "look_ahead": 4.0}
    helmsman._navigator = MovingNavigator(1.0, east_speed)  # type: ignore[assignment]
    course = helmsman.course(20.0, -2.0)
    assert course == pytest.approx(-math.atan2(2.0, 4.0) - crab)
