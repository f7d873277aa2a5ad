"""The tracks over an area, the map of its bottom, and the soundings of a scan."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.algorithms.fake_node import FakeNode
from uwsim.algorithms.survey.bottom_map import BottomMap
from uwsim.algorithms.survey.bottom_survey import SurveyTruth
from uwsim.algorithms.survey.tracks import TrackGuidance, plan_tracks
from uwsim.base.geometry import Array
from uwsim.messages import LaserScan, Odometry, Point, PointCloud2, Quaternion, TwistStamped, points


@pytest.mark.parametrize(("width", "n_tracks"), [(15.0, 3), (16.0, 4), (4.0, 1)])
def test_tracks_are_no_further_apart_than_their_spacing(width: float, n_tracks: int) -> None:
    corners = np.array(plan_tracks(20.0, width, 5.0, 2.5))
    offsets = sorted(set(corners[:, 1].tolist()))
    assert len(offsets) == n_tracks
    assert np.all(np.diff(offsets) <= 5.0)
    assert corners[:4, 0].tolist() == [0.0, 20.0, 20.0, 0.0][: len(corners)]


def test_a_vehicle_that_obeys_passes_all_corners() -> None:
    corners = plan_tracks(20.0, 15.0, 5.0, 2.5)
    guidance, position = TrackGuidance(corners, 0.6, 2.0), np.zeros(2)
    trace: list[Array] = []
    while not guidance.has_arrived:
        velocity = guidance.command(position)
        assert math.hypot(*velocity.tolist()) == pytest.approx(0.6) or guidance.has_arrived
        position = position + 0.1 * velocity
        trace.append(position)
        assert len(trace) < 2000
    distances = [min(np.linalg.norm(np.array(trace) - corner, axis=1)) for corner in corners]
    assert max(distances) < 0.6
    assert guidance.command(position).tolist() == [0.0, 0.0]


def test_beside_a_track_the_vehicle_aims_at_the_point_ahead() -> None:
    guidance = TrackGuidance([np.array([10.0, 0.0])], 1.0, 2.0)
    guidance.command(np.zeros(2))
    half = 1.0 / math.sqrt(2.0)
    assert guidance.command(np.array([3.0, 2.0])) == pytest.approx([half, -half])


def test_a_cell_has_the_mean_of_its_soundings() -> None:
    bottom = BottomMap(2.0, 1.0, 1.0)
    bottom.add(np.array([[0.2, 0.2, 8.0], [0.6, 0.4, 9.0], [1.5, 0.5, 7.0], [2.5, 0.5, 1.0]]))
    bottom.add(np.array([[0.4, 0.6, 10.0]]))
    assert bottom.points() == pytest.approx(np.array([[0.4, 0.4, 9.0], [1.5, 0.5, 7.0]]))


def test_a_scan_over_a_level_bottom_is_mapped_at_its_depth() -> None:
    node = FakeNode(parameters={"cell": 1.0, "period": 0.0, "sonar_x": 0.0, "sonar_z": 0.5})
    survey = SurveyTruth()
    survey.start(node)  # type: ignore[arg-type]
    heading = Quaternion(w=math.cos(0.25), x=0.0, y=0.0, z=math.sin(0.25))
    for east in (-3.0, 1.0):  # the second position is 4 m east of the first
        odometry = Odometry()
        odometry.pose.pose.position = Point(x=2.0, y=east, z=6.0)
        odometry.pose.pose.orientation = heading
        node.readers["/bluerov2/odom"](odometry)
    angles = np.linspace(-0.5, 0.5, 11)
    scan = LaserScan(
        angle_min=-0.5, angle_increment=0.1, range_max=30.0,
        ranges=(4.0 / np.cos(angles)).astype(np.float32),
    )  # fmt: skip
    node.readers["/bluerov2/multibeam"](scan)
    (cloud,) = [m for _, m in node.published if isinstance(m, PointCloud2)]
    soundings = points(cloud)
    assert soundings[:, 2] == pytest.approx(10.5, abs=1e-5)
    assert soundings[:, 0].min() >= 0.0  # those south of the origin are outside of the area
    twist = next(m.twist for _, m in node.published if isinstance(m, TwistStamped))
    assert twist.linear.z == pytest.approx(0.4)  # down to the depth of 11 m, limited
    assert twist.angular.z == pytest.approx(-0.8 * 0.5)  # back to north
