"""The view of a path, against geometry worked out by hand."""

from __future__ import annotations

import math

import numpy as np

from tests.support.fakes import FakeWorld
from uwsim.base.geometry import Pose
from uwsim.benchmark.environment.path_view import PathView
from uwsim.benchmark.measures import PathFollowingSpec
from uwsim.benchmark.reference_path import ReferencePathSpec


def view_of(points: tuple[float, ...]) -> PathView:
    reference = ReferencePathSpec(points=points)
    return PathView(PathFollowingSpec(name="p", target="v", reference=reference), FakeWorld())


def test_the_path_in_the_axes_of_a_turned_vehicle() -> None:
    pose = Pose.from_rpy((3.0, 1.0, 2.0), (0.0, 0.0, math.pi / 2.0))  # x of the base is y of W
    view = view_of((0.0, 0.0, 2.0, 10.0, 0.0, 2.0)).read(pose)
    np.testing.assert_allclose(view[:3], [-1.0, 0.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(view[3:6], [0.0, -1.0, 0.0], atol=1e-12)
    ahead = view[6:].reshape(3, 3)
    np.testing.assert_allclose(ahead, [[-1.0, -a, 0.0] for a in (0.5, 1.0, 2.0)], atol=1e-12)


def test_points_ahead_go_round_a_corner_and_stop_at_the_end() -> None:
    view = view_of((0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 1.2, 0.0))
    ahead = view.read(Pose.from_rpy((1.5, 0.0, 0.0), (0.0, 0.0, 0.0)))[6:].reshape(3, 3)
    np.testing.assert_allclose(ahead, [[0.5, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 1.2, 0.0]])


def test_several_short_segments_are_passed_at_once() -> None:
    points = tuple(number for i in range(11) for number in (0.1 * i, 0.0, 0.0))
    view = view_of(points).read(Pose.from_rpy((0.75, 0.2, 0.0), (0.0, 0.0, 0.0)))
    np.testing.assert_allclose(view[:3], [0.0, -0.2, 0.0], atol=1e-12)
