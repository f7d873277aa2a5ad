"""Angles of a rotation, in both of UWSim's orders; points through a pose."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from uwsim.base.geometry import (
    Pose,
    rotation_from_rpy,
    rotation_from_xyz,
    rpy_from_rotation,
    xyz_from_rotation,
)

ANGLE = st.floats(-7.0, 7.0)


@given(ANGLE, ANGLE, ANGLE)
def test_the_angles_of_a_rotation_give_the_rotation(x: float, y: float, z: float) -> None:
    rotation = rotation_from_rpy(x, y, z)
    assert rotation_from_rpy(*rpy_from_rotation(rotation)) == pytest.approx(rotation, abs=1e-7)
    rotation = rotation_from_xyz(x, y, z)
    assert rotation_from_xyz(*xyz_from_rotation(rotation)) == pytest.approx(rotation, abs=1e-7)


@pytest.mark.parametrize("upright", [np.pi / 2, -np.pi / 2])
def test_where_two_axes_are_one_the_angles_still_give_the_rotation(upright: float) -> None:
    for make, angles in (
        (rotation_from_rpy, rpy_from_rotation),
        (rotation_from_xyz, xyz_from_rotation),
    ):
        rotation = make(0.4, upright, -0.9)
        assert make(*angles(rotation)) == pytest.approx(rotation, abs=1e-9)


def test_a_pose_transforms_one_point_as_it_does_many() -> None:
    pose = Pose(np.array([1.0, 2.0, 3.0]), rotation_from_rpy(0.1, 0.2, 0.3))
    points = np.array([[1.0, 0.0, 0.0], [0.5, -2.0, 4.0]])
    assert pose.transform(points[1]).tolist() == pose.transform(points)[1].tolist()
    assert pose.transform(points[1]).shape == (3,)
