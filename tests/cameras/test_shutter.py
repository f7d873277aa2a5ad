"""The times of a shutter, the weights of its images, and the motion that they follow."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.base.geometry import Intrinsics, Pose
from uwsim.cameras import Shutter
from uwsim.cameras.shutter import MAX_IMAGES, find_motion, move_pose, turn

CAMERA = Intrinsics.from_fovy(160, 120, math.radians(60.0))


def test_a_camera_that_hardly_moves_takes_one_image() -> None:
    shutter = Shutter(exposure_time=0.01)
    assert shutter.choose_times(120, 0.0).tolist() == [0.0]
    assert shutter.choose_times(120, 9.0).tolist() == [0.0]
    assert len(shutter.choose_times(120, 500.0)) == 6
    assert len(shutter.choose_times(120, 1e6)) == MAX_IMAGES


def test_times_span_the_exposure_and_the_readout() -> None:
    shutter = Shutter(mode="rolling", row_time=1e-4, exposure_time=0.004)
    times = shutter.choose_times(101, 1000.0)
    assert times[0] == pytest.approx(-0.007)
    assert times[-1] == pytest.approx(0.007)
    assert np.diff(times).max() * 1000.0 <= 1.0 + 1e-9


@pytest.mark.parametrize("exposure_time", [0.0, 0.004])
@pytest.mark.parametrize("row_time", [0.0, 1e-4])
def test_a_row_is_the_mean_of_its_exposure(exposure_time: float, row_time: float) -> None:
    """The means of light that grows with the time, or its square, have closed forms."""
    shutter = Shutter(
        mode="rolling" if row_time else "global", row_time=row_time, exposure_time=exposure_time
    )
    times = shutter.choose_times(61, 3000.0)
    weights = shutter.compute_weights(61, times).astype(float)
    np.testing.assert_allclose(weights.sum(axis=0), 1.0, atol=1e-6)
    middles = (np.arange(61) - 30.0) * row_time
    np.testing.assert_allclose((weights * times[:, None]).sum(axis=0), middles, atol=1e-8)
    squares = (weights * times[:, None] ** 2).sum(axis=0)
    step = times[1] - times[0] if len(times) > 1 else 0.0
    expected = middles**2 + exposure_time**2 / 12.0
    assert np.abs(squares - expected).max() <= step**2 / 4.0 + 1e-12


def test_a_pose_turns_about_its_own_origin() -> None:
    pose = Pose.from_rpy((1.0, 2.0, 3.0), (0.1, 0.2, 0.3))
    moved_pose = move_pose(pose, np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 2.0]), 0.25)
    assert moved_pose.position.tolist() == [1.25, 2.0, 3.0]
    yaw = Pose.from_rpy((0.0, 0.0, 0.0), (0.0, 0.0, 0.5)).rotation
    np.testing.assert_allclose(moved_pose.rotation, yaw @ pose.rotation, atol=1e-14)
    rotation = turn(np.array([0.3, -0.7, 0.2]), 1.3)
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-14)


def test_the_motion_in_the_image_is_that_of_projected_points() -> None:
    velocity, rate = np.array([0.4, -0.2, 0.3]), np.array([0.2, -0.1, 0.4])
    depth = 1.0 + np.add.outer(np.arange(120), np.arange(160)) * 0.01
    points = (CAMERA.rays() * depth[..., None]).reshape(-1, 3)
    step = 1e-6
    moved_pose = move_pose(Pose.identity(), velocity, rate, step)
    later_points = (points - moved_pose.position) @ moved_pose.rotation
    motions = CAMERA.project(later_points) - CAMERA.project(points)
    speeds = np.linalg.norm(motions, axis=1) / step
    assert find_motion(depth, CAMERA, velocity, rate) == pytest.approx(speeds.max(), rel=1e-4)


def test_what_has_no_surface_only_turns() -> None:
    depth = np.full((120, 160), np.inf)
    zero = np.zeros(3)
    assert find_motion(depth, CAMERA, np.array([1.0, 2.0, 3.0]), zero) == 0.0
    rate = find_motion(depth, CAMERA, zero, np.array([0.0, 0.0, 1.0]))
    assert rate == pytest.approx(math.hypot(79.5, 59.5), rel=1e-6)
