r"""Kinematics of the ARM5E on a free base: forward, and inverse within limits.

Denavit-Hartenberg parameters of the arm below the Girona 500 (theta, d, a, alpha), from its base
1.08 m below the vehicle's, turned by half a turn about z:

====== ================ ======= ======== =====
joint  theta            d [m]   a [m]    alpha
====== ================ ======= ======== =====
slew   q1               0       0.08052  pi/2
should q2 + 0.139277    0       0.44278  0
elbow  q3 + 1.972222    0       -0.083   pi/2
wrist  q4               0.34404 0        0
====== ================ ======= ======== =====

What is brought to a place is the *grip*: the point between the fingers, `REACH` below the wrist,
where they close on a bar. Four joints reach its place and the heading of the axis along
which the jaw closes; how far the jaw leans follows from that. The inverse is found by damped least
squares (Nakamura and Hanafusa 1986) with joints clamped to their limits.
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
"""Names of the joints that reach; the fingers' is `JAW`."""
JAW = "JawOpening"
LIMITS: Array = np.array([[-1.570796, 0.5488], [0.0, 1.58665], [0.0, 2.15294], [-math.pi, math.pi]])
"""Of the joints, (4, 2) [rad]."""
OPEN, CLOSED = 0.55, -0.05
"""Positions of the fingers [rad]."""
REACH = 0.135
"""Of the grip below the wrist [m]."""
DOWN: Array = np.array([0.0, 0.7, 0.332, 0.0])
"""The arm reaches down and aft, the jaw is vertical [rad]."""
FOLDED: Array = np.array([0.0, 0.0, 0.0, 0.0])
"""The arm is stretched aft, out of the way [rad]."""

_DH: Array = np.array(
    [
        [0.0, 0.0, 0.08052, math.pi / 2],
        [0.139277, 0.0, 0.44278, 0.0],
        [1.972222, 0.0, -0.083, math.pi / 2],
        [0.0, 0.34404, 0.0, 0.0],
    ]
)
_ARM_DEPTH = 1.08
"""Of the arm's base below the vehicle's [m]."""
_HEADING_WEIGHT = 0.1
"""Of the heading of the jaw beside its place [m/rad]."""
_ITERATIONS = 15


@dataclass(frozen=True, eq=False, kw_only=True)
class Reach:
    """What inverse kinematics found."""

    joints: Array
    """Slew, shoulder, elbow, wrist, (4,) [rad]."""
    error: float
    """Distance of the grip from where it should be [m]."""


class Kinematics(Protocol):
    """An arm; one of your own goes to `Grasp.kinematics`."""

    def grip(self, joints: Array) -> Pose:
        """``base_from_grip``: z out of the jaw, it closes along x; joints (4,) [rad]."""

    def reach(self, place: Array, heading: float, start: Array) -> Reach:
        """Return joints with the grip at a place (3,) [m] of the base's frame.

        Args:
            place: of the grip.
            heading: of the axis along which the jaw closes, modulo half a turn [rad].
            start: joints to begin from, (4,) [rad].
        """


class Arm5e:
    """The ARM5E."""

    def wrist(self, joints: Array) -> Pose:
        """``base_from_wrist``, the frame of the link ``part4_base``; joints (4,) [rad]."""
        found = _wrist(np.asarray(joints, dtype=np.float64), _DH)
        return Pose(found[:, 3].copy(), np.ascontiguousarray(found[:, :3]))

    def grip(self, joints: Array) -> Pose:
        """``base_from_grip``; see `Kinematics`."""
        wrist = self.wrist(joints)
        return Pose(wrist.position + REACH * wrist.rotation[:, 2], wrist.rotation)

    def reach(self, place: Array, heading: float, start: Array) -> Reach:
        """Return joints within `LIMITS`; see `Kinematics`."""
        joints, error = _reached(place, heading, start, _DH, LIMITS)
        return Reach(joints=joints, error=error)


@njit
def _wrist(joints: Array, table: Array) -> Array:
    """Rotation and position of the wrist in the vehicle's base, (3, 4)."""
    pose = np.zeros((3, 4))
    pose[0, 0], pose[1, 1], pose[2, 2], pose[2, 3] = -1.0, -1.0, 1.0, _ARM_DEPTH
    for k in range(4):
        angle, twist = joints[k] + table[k, 0], table[k, 3]
        c, s, ca, sa = math.cos(angle), math.sin(angle), math.cos(twist), math.sin(twist)
        a, d = table[k, 2], table[k, 1]
        for i in range(3):
            x, y, z = pose[i, 0], pose[i, 1], pose[i, 2]
            along, across = c * x + s * y, -s * x + c * y
            pose[i, 3] += a * along + d * z
            pose[i, 0] = along
            pose[i, 1] = ca * across + sa * z
            pose[i, 2] = -sa * across + ca * z
    return pose


@njit
def _values(joints: Array, table: Array) -> Array:
    """Place of the grip [m] and heading of the axis along which the jaw closes [rad], (4,)."""
    pose = _wrist(joints, table)
    found = np.empty(4)
    for i in range(3):
        found[i] = pose[i, 3] + REACH * pose[i, 2]
    found[3] = math.atan2(pose[1, 0], pose[0, 0])
    return found


@njit
def _reached(
    place: Array, heading: float, start: Array, table: Array, limits: Array
) -> tuple[Array, float]:
    """Joints (4,) and what is left of the distance [m]."""
    joints = np.minimum(np.maximum(start, limits[:, 0]), limits[:, 1])
    best, least = joints.copy(), 1e9
    error, slopes = np.empty(4), np.empty((4, 4))
    for _ in range(_ITERATIONS):
        now = _values(joints, table)
        error[:3] = place - now[:3]
        turn = heading - now[3]
        error[3] = _HEADING_WEIGHT * (turn - math.pi * math.floor(turn / math.pi + 0.5))
        off = math.sqrt(error[0] ** 2 + error[1] ** 2 + error[2] ** 2)
        if off + abs(error[3]) < least:
            best, least = joints.copy(), off + abs(error[3])
        for k in range(4):
            moved = joints.copy()
            moved[k] += 1e-5
            slopes[:, k] = (_values(moved, table) - now) / 1e-5
        slopes[3] *= _HEADING_WEIGHT
        normal, right = 1e-5 * np.eye(4), np.zeros(4)
        for i in range(4):
            for k in range(4):
                right[i] += slopes[k, i] * error[k]
                for j in range(4):
                    normal[i, j] += slopes[k, i] * slopes[k, j]
        by = np.minimum(np.maximum(cholesky_solve(normal, right), -0.2), 0.2)
        joints = np.minimum(np.maximum(joints + by, limits[:, 0]), limits[:, 1])
    left = place - _values(best, table)[:3]
    return best, math.sqrt(left[0] ** 2 + left[1] ** 2 + left[2] ** 2)
