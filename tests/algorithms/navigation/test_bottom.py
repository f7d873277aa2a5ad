"""The plane of the bottom from four beams."""

import numpy as np
import pytest

from uwsim.algorithms.navigation import BottomPlane
from uwsim.algorithms.navigation.bottom import BEAMS, parse_ranges
from uwsim.base.geometry import Pose, rotation_from_rpy
from uwsim.messages import DVL


def ranges(pose: Pose, plane: tuple[float, float, float]) -> np.ndarray:
    """Along the beams of a DVL to the plane z = a + b x + c y."""
    a, b, c = plane
    directions = BEAMS @ pose.rotation.T
    x, y, z = pose.position
    closing = directions[:, 2] - b * directions[:, 0] - c * directions[:, 1]
    return (a + b * x + c * y - z) / closing


def test_a_slope_is_known_where_the_vehicle_is_not() -> None:
    plane, bottom = (5.0, 0.05, -0.03), BottomPlane()
    for k in range(5):
        pose = Pose(np.array([0.3 * k, -0.1, 2.0]), rotation_from_rpy(0.05, -0.1, 0.2 * k))
        bottom.update(ranges(pose, plane), pose)
    assert bottom.slopes == pytest.approx((0.05, -0.03), abs=1e-9)
    assert bottom.depth_at(np.array([2.0, 1.0])) == pytest.approx(5.07, abs=1e-9)


def test_a_beam_on_something_else_or_without_an_echo_counts_for_nothing() -> None:
    pose, bottom = Pose(np.array([0.0, 0.0, 2.0]), np.eye(3)), BottomPlane()
    level = ranges(pose, (5.0, 0.0, 0.0))
    bottom.update(level - np.array([0.4, 0.0, 0.0, 0.0]), pose)
    bottom.update(np.array([np.nan, 3.0, 3.0, 3.0]), pose)
    assert not bottom.is_known
    bottom.update(level, pose)
    assert bottom.depth_at(np.zeros(2)) == pytest.approx(5.0)


def test_ranges_are_read_from_the_raw_data_of_a_dvl() -> None:
    assert parse_ranges(DVL(raw_data="1.0 2.0 3.0 nan 0.1")).tolist()[:3] == [1.0, 2.0, 3.0]
    assert np.isnan(parse_ranges(DVL(raw_data="none"))).all()
