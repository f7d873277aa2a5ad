"""Images of a task's phases: where the observer is, and the camera's image in the corner."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.base.geometry import Pose
from uwsim.runs.trial.images.phase_images import DISTANCE, observer_pose, with_inset

DOWN = np.diag([1.0, -1.0, -1.0])  # x ahead, y to starboard, z down, in a world with z up


def test_the_observer_looks_at_the_point_from_starboard_and_above() -> None:
    at = np.array([1.0, 2.0, -3.0])
    found = observer_pose(Pose(np.zeros(3), DOWN), at)
    away = found.position - at
    assert np.linalg.norm(away) == pytest.approx(DISTANCE)
    assert away[1] < 0.0  # starboard is -y here
    assert away[2] > 0.0
    np.testing.assert_allclose(-found.rotation[:, 2], -away / DISTANCE, atol=1e-12)


def test_the_camera_image_is_in_the_upper_left_corner() -> None:
    whole = np.zeros((200, 320, 3), np.uint8)
    for image in (np.full((240, 320, 3), 77, np.uint8), np.full((240, 320), 77, np.uint8)):
        drawn = with_inset(whole, image)
        assert (drawn[20, 20] == 77).all()
        assert (drawn[4, 4] == 255).all()
        assert (drawn[150, 250] == 0).all()
        assert (whole == 0).all()
