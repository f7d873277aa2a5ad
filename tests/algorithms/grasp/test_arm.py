"""Kinematics of the ARM5E against its URDF."""

from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from uwsim.algorithms.grasp.arm import DOWN_POSTURE, GRIP_OFFSET, JAW, JOINT_LIMITS, JOINTS, Arm5e
from uwsim.scene.urdf.kinematics import link_poses
from uwsim.scene.urdf.reader import read_urdf

URDF = Path(str(resources.files("uwsim"))) / "data" / "scenes" / "g500ARM5.urdf"


@pytest.fixture
def random() -> np.random.Generator:
    return np.random.Generator(np.random.Philox(7))


def test_the_wrist_is_where_the_urdf_has_it(random: np.random.Generator) -> None:
    robot, arm = read_urdf(URDF), Arm5e()
    for _ in range(20):
        joints = random.uniform(JOINT_LIMITS[:, 0], JOINT_LIMITS[:, 1])
        true = link_poses(robot, [*joints, 0.0])["part4_base"]
        found = arm.wrist(joints)
        assert found.position == pytest.approx(true.position, abs=1e-5)
        assert np.abs(found.rotation - true.rotation).max() < 1e-5


def test_names_and_limits_are_those_of_the_urdf() -> None:
    movable = read_urdf(URDF).movable_joints
    assert [joint.name for joint in movable] == [*JOINTS, JAW]
    for joint, (low, high) in zip(movable, JOINT_LIMITS, strict=False):
        assert (joint.lower, joint.upper) == pytest.approx((low, high), abs=1e-5)


def test_reaching_down_the_jaw_is_vertical_below_the_vehicle() -> None:
    grip = Arm5e().grip(DOWN_POSTURE)
    assert grip.rotation[2, 2] > 0.999
    assert grip.position[2] > 1.8
    wrist = Arm5e().wrist(DOWN_POSTURE)
    assert np.linalg.norm(grip.position - wrist.position) == pytest.approx(GRIP_OFFSET)


def test_the_inverse_finds_joints_for_a_place_and_a_heading(random: np.random.Generator) -> None:
    arm = Arm5e()
    for _ in range(10):
        joints = DOWN_POSTURE + random.uniform(-0.15, 0.15, 4) * [1, 1, 1, 5]
        true = arm.grip(joints)
        heading = np.arctan2(true.rotation[1, 0], true.rotation[0, 0])
        reach = arm.reach(true.position, heading, DOWN_POSTURE)
        assert reach.error < 1e-3
        closes = arm.grip(reach.joints).rotation[:, 0]
        off = (np.arctan2(closes[1], closes[0]) - heading + np.pi / 2) % np.pi - np.pi / 2
        assert abs(off) < 0.02


def test_what_is_out_of_reach_leaves_an_error_and_joints_within_limits() -> None:
    reach = Arm5e().reach(np.array([3.0, 0.0, 1.0]), 0.0, DOWN_POSTURE)
    assert reach.error > 1.0
    assert (reach.joints >= JOINT_LIMITS[:, 0]).all()
    assert (reach.joints <= JOINT_LIMITS[:, 1]).all()
