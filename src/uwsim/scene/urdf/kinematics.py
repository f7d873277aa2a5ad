"""Forward kinematics of a robot."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ...base.geometry import Pose, rotation_about
from ...base.numerics.linear import length
from .robot import JointSpec, RobotSpec


def joint_positions(robot: RobotSpec, joint_values: Sequence[float] = ()) -> dict[str, float]:
    """Return the position of every movable joint, mimicking joints included [rad or m].

    Args:
        robot: the robot.
        joint_values: the joint vector [rad or m], which is clamped to the limits; missing values
            are 0.
    """
    positions = {joint.name: 0.0 for joint in robot.joints if joint.moves}
    for index, joint in enumerate(robot.movable_joints):
        value = joint_values[index] if index < len(joint_values) else 0.0
        positions[joint.name] = joint.clamp(float(value))
    leader_values = {joint.name: positions[joint.name] for joint in robot.movable_joints}
    for joint in robot.joints:
        if joint.moves and joint.mimic is not None:
            positions[joint.name] = _follow(joint, leader_values.get(joint.mimic.joint, 0.0))
    return positions


def link_poses(robot: RobotSpec, joint_values: Sequence[float] = ()) -> dict[str, Pose]:
    """Return the pose of every link in the root link's frame, ``base_from_link``."""
    positions = joint_positions(robot, joint_values)
    poses = {robot.root: Pose.identity()}
    for joint in robot.joints:  # parents come before their children
        parent_from_joint = Pose.from_rpy(joint.position, joint.rpy)
        joint_from_child = _joint_from_child(joint, positions.get(joint.name, 0.0))
        poses[joint.child] = poses[joint.parent] @ parent_from_joint @ joint_from_child
    return poses


def _joint_from_child(joint: JointSpec, value: float) -> Pose:
    if not joint.moves:
        return Pose.identity()
    axis = np.array(joint.axis)  # (3,)
    if joint.kind == "prismatic":
        return Pose(axis / length(axis) * value, np.eye(3))
    return Pose(np.zeros(3), rotation_about(axis, value))


def _follow(joint: JointSpec, source: float) -> float:
    """Return the position of a mimicking joint; the reader has resolved chains.

    Args:
        joint: the mimicking joint.
        source: the position of the mimicked joint [rad or m].
    """
    assert joint.mimic is not None
    if joint.is_crank:
        reach = joint.mimic.offset * math.sin(source)
        return -(source + math.asin(min(max(reach, -1.0), 1.0)))
    return source * joint.mimic.multiplier + joint.mimic.offset
