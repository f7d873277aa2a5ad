r"""Forward and inverse kinematics of the arm ARM5E below the vehicle Girona 500.

The frame of the vehicle's base has x forward, y to starboard and z down. The frame of the arm's
base is 1.08 m below it and rotated by half a turn about z, so that its x axis points aft. The
Denavit-Hartenberg parameters of the joints q1 to q4 are:

======== ================ ======= ======== =====
joint    theta            d [m]   a [m]    alpha
======== ================ ======= ======== =====
slew     q1               0       0.08052  pi/2
shoulder q2 + 0.139277    0       0.44278  0
elbow    q3 + 1.972222    0       -0.083   pi/2
wrist    q4               0.34404 0        0
======== ================ ======= ======== =====

The *grip* is the point between the fingers at which they close on a bar, `GRIP_OFFSET` below the
wrist. Its frame has z out of the jaw and x along the axis along which the fingers close (the
*closing axis*). The four joints determine the position of the grip and the heading of the closing
axis; the tilt of the jaw follows from these. The inverse kinematics are computed by damped least
squares (Nakamura and Hanafusa 1986), with the joints limited to their ranges.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.jit import njit
from .normal_equations import cholesky_solve

JOINTS = ("Slew", "Shoulder", "Elbow", "JawRotate")
"""The names of the joints of the arm, without the joint of the fingers."""
JAW = "JawOpening"
"""The name of the joint of the fingers."""
JOINT_LIMITS = np.array([[-1.570796, 0.5488], [0.0, 1.58665], [0.0, 2.15294], [-math.pi, math.pi]])
"""The lower and upper limit of each of `JOINTS`, (4, 2) [rad]."""
JAW_OPEN, JAW_CLOSED = 0.55, -0.05
"""The positions of the joint of the fingers when the jaw is open, and closed [rad]."""
GRIP_OFFSET = 0.135
"""The distance of the grip below the wrist [m]."""
DOWN_POSTURE: Array = np.array([0.0, 0.7, 0.332, 0.0])
"""The joint positions at which the arm is down and aft, with the jaw vertical, (4,) [rad]."""
STOWED_POSTURE: Array = np.array([0.0, 0.0, 0.0, 0.0])
"""The joint positions at which the arm extends aft, out of the camera's view, (4,) [rad]."""

_DH_TABLE: Array = np.array(
    [
        [0.0, 0.0, 0.08052, math.pi / 2],
        [0.139277, 0.0, 0.44278, 0.0],
        [1.972222, 0.0, -0.083, math.pi / 2],
        [0.0, 0.34404, 0.0, 0.0],
    ]
)
"""The Denavit-Hartenberg parameters theta, d, a, alpha of each joint, (4, 4)."""
_ARM_BASE_DEPTH = 1.08
"""The depth of the arm's base below the vehicle's base [m]."""
_HEADING_WEIGHT = 0.1
"""The weight of an error of the jaw's heading relative to an error of its position [m/rad]."""
_N_ITERATIONS = 15
"""The number of iterations of the inverse kinematics."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Reach:
    """The result of inverse kinematics."""

    joints: Array
    """The joint positions: slew, shoulder, elbow, wrist, (4,) [rad]."""
    error: float
    """The distance of the grip from the requested position [m]."""


class Kinematics(Protocol):
    """The kinematics of an arm; see `Grasp.kinematics`."""

    def grip(self, joints: Array) -> Pose:
        """Return the pose ``base_from_grip`` for joint positions (4,) [rad].

        The frame of the grip has z out of the jaw and x along its closing axis.
        """

    def reach(self, position: Array, heading: float, start: Array) -> Reach:
        """Compute the joint positions for a position of the grip.

        Args:
            position: the position of the grip in the frame of the vehicle's base, (3,) [m].
            heading: the heading of the closing axis, modulo half a turn, about z of that frame
                [rad].
            start: the joint positions at which the iterations start, (4,) [rad].
        """


class Arm5e:
    """The kinematics of the ARM5E."""

    def wrist(self, joints: Array) -> Pose:
        """Return the pose ``base_from_wrist`` (link ``part4_base``) for joint positions (4,)."""
        pose = _wrist_pose(np.asarray(joints, dtype=np.float64), _DH_TABLE)
        return Pose(pose[:, 3].copy(), np.ascontiguousarray(pose[:, :3]))

    def grip(self, joints: Array) -> Pose:
        """Return the pose ``base_from_grip``; see `Kinematics`."""
        wrist = self.wrist(joints)
        return Pose(wrist.position + GRIP_OFFSET * wrist.rotation[:, 2], wrist.rotation)

    def reach(self, position: Array, heading: float, start: Array) -> Reach:
        """Compute joint positions within `JOINT_LIMITS`; see `Kinematics`."""
        joints, error = _solve_joints(position, heading, start, _DH_TABLE, JOINT_LIMITS)
        return Reach(joints=joints, error=error)


@njit
def _wrist_pose(joints: Array, table: Array) -> Array:
    """Return the rotation and the position [m] of the wrist in the vehicle's base, (3, 4)."""
    pose = np.zeros((3, 4))
    pose[0, 0], pose[1, 1], pose[2, 2], pose[2, 3] = -1.0, -1.0, 1.0, _ARM_BASE_DEPTH
    for k in range(4):
        angle, twist = joints[k] + table[k, 0], table[k, 3]
        c, s, ca, sa = math.cos(angle), math.sin(angle), math.cos(twist), math.sin(twist)
        a, d = table[k, 2], table[k, 1]
        for i in range(3):
            x, y, z = pose[i, 0], pose[i, 1], pose[i, 2]
            x_axis, y_axis = c * x + s * y, -s * x + c * y
            pose[i, 3] += a * x_axis + d * z
            pose[i, 0] = x_axis
            pose[i, 1] = ca * y_axis + sa * z
            pose[i, 2] = -sa * y_axis + ca * z
    return pose


@njit
def _grip_coordinates(joints: Array, table: Array) -> Array:
    """Return the position of the grip [m] and the heading of the closing axis [rad], (4,)."""
    pose = _wrist_pose(joints, table)
    coordinates = np.empty(4)
    for i in range(3):
        coordinates[i] = pose[i, 3] + GRIP_OFFSET * pose[i, 2]
    coordinates[3] = math.atan2(pose[1, 0], pose[0, 0])
    return coordinates


@njit
def _solve_joints(
    position: Array, heading: float, start: Array, table: Array, limits: Array
) -> tuple[Array, float]:
    """Return joint positions (4,) [rad] and the distance of the grip from its goal [m]."""
    joints = np.minimum(np.maximum(start, limits[:, 0]), limits[:, 1])
    best_joints, least_error = joints.copy(), 1e9
    error, jacobian = np.empty(4), np.empty((4, 4))
    for _ in range(_N_ITERATIONS):
        coordinates = _grip_coordinates(joints, table)
        error[:3] = position - coordinates[:3]
        angle = heading - coordinates[3]
        error[3] = _HEADING_WEIGHT * (angle - math.pi * math.floor(angle / math.pi + 0.5))
        distance = math.sqrt(error[0] ** 2 + error[1] ** 2 + error[2] ** 2)
        if distance + abs(error[3]) < least_error:
            best_joints, least_error = joints.copy(), distance + abs(error[3])
        for k in range(4):
            shifted_joints = joints.copy()
            shifted_joints[k] += 1e-5
            jacobian[:, k] = (_grip_coordinates(shifted_joints, table) - coordinates) / 1e-5
        jacobian[3] *= _HEADING_WEIGHT
        normal, right = 1e-5 * np.eye(4), np.zeros(4)
        for i in range(4):
            for k in range(4):
                right[i] += jacobian[k, i] * error[k]
                for j in range(4):
                    normal[i, j] += jacobian[k, i] * jacobian[k, j]
        step = np.minimum(np.maximum(cholesky_solve(normal, right), -0.2), 0.2)
        joints = np.minimum(np.maximum(joints + step, limits[:, 0]), limits[:, 1])
    offset = position - _grip_coordinates(best_joints, table)[:3]
    return best_joints, math.sqrt(offset[0] ** 2 + offset[1] ** 2 + offset[2] ** 2)
