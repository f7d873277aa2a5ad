r"""Conversion of poses and twists between the frames of logs and those of uwsim.

Logs use two pairs of frames. ROS (REP 103) has a world with axes east, north, up (ENU) and a body
with axes forward, left, up (FLU). Autopilots and Fossen have north, east, down (NED) and forward,
right, down (FRD). The frame L of nearly all scenes is north-east-down, and the base of the bundled
vehicles is forward-right-down (docs/conventions.md). With the constant rotations

.. math:: R_\mathrm{ned}^\mathrm{enu} = \begin{pmatrix} 0&1&0\\1&0&0\\0&0&-1 \end{pmatrix},
    \qquad R_\mathrm{frd}^\mathrm{flu} = \mathrm{diag}(1, -1, -1)

an orientation becomes :math:`R_L^B = R_\mathrm{ned}^\mathrm{enu} R_\mathrm{enu}^\mathrm{flu}
R_\mathrm{flu}^\mathrm{frd}`. Magnetic declination and the curvature of the Earth are not modelled.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from ..base.geometry import Array

WorldFrame = Literal["local", "ned", "enu"]
"""The world frame of a log: that of the scene's files (L), north-east-down, or east-north-up."""
BodyFrame = Literal["base", "frd", "flu"]
"""The body frame of a log: the base of the URDF, forward-right-down, or forward-left-up."""
WORLD_FRAMES: tuple[WorldFrame, ...] = ("local", "ned", "enu")
BODY_FRAMES: tuple[BodyFrame, ...] = ("base", "frd", "flu")

_HALF_ROOT = math.sqrt(0.5)
_NED_FROM_ENU = (0.0, _HALF_ROOT, _HALF_ROOT, 0.0)
"""The quaternion of a half turn about the axis (1, 1, 0)."""
_FRD_FROM_FLU = (0.0, 1.0, 0.0, 0.0)
"""The quaternion of a half turn about x."""


def multiply_quaternions(left: Array, right: Array) -> Array:
    """Return the products of quaternions wxyz, (n, 4) and (n, 4) or (4,)."""
    a, b, c, d = left.T
    w, x, y, z = np.broadcast_to(right, left.shape).T
    products: Array = np.array(
        [
            a * w - b * x - c * y - d * z,
            a * x + b * w + c * z - d * y,
            a * y - b * z + c * w + d * x,
            a * z + b * y - c * x + d * w,
        ]
    ).T
    return products


def rotate_vectors(quaternions: Array, vectors: Array) -> Array:
    """Return vectors (n, 3) rotated by quaternions wxyz (n, 4): coordinates in the outer frame."""
    w, axis = quaternions[:, :1], quaternions[:, 1:]
    half_turn = 2.0 * np.cross(axis, vectors)
    rotated_vectors: Array = vectors + w * half_turn + np.cross(axis, half_turn)
    return rotated_vectors


def rotate_vectors_back(quaternions: Array, vectors: Array) -> Array:
    """Return vectors (n, 3) rotated by the inverses of quaternions wxyz (n, 4)."""
    return rotate_vectors(quaternions * np.array([1.0, -1.0, -1.0, -1.0]), vectors)


def quaternions_from_rpy(angles: Array) -> Array:
    """Return the quaternions wxyz (n, 4) of ``Rz(yaw) Ry(pitch) Rx(roll)``, angles (n, 3) [rad]."""
    (cr, cp, cy), (sr, sp, sy) = np.cos(0.5 * angles).T, np.sin(0.5 * angles).T
    quaternions: Array = np.array(
        [
            cr * cp * cy + sr * sp * sy,
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
        ]
    ).T
    return quaternions


def convert_positions(positions: Array, frame: WorldFrame) -> Array:
    """Return positions or vectors (n, 3) of a log's world frame in L."""
    if frame == "enu":
        positions_in_l: Array = positions[:, [1, 0, 2]] * np.array([1.0, 1.0, -1.0])
        return positions_in_l
    return positions


def convert_orientations(quaternions: Array, world: WorldFrame, body: BodyFrame) -> Array:
    """Return the orientations ``localized_from_base`` of a log's ``world_from_body``, (n, 4)."""
    if world == "enu":
        turn = np.broadcast_to(np.array(_NED_FROM_ENU), quaternions.shape)
        quaternions = multiply_quaternions(turn, quaternions)
    if body == "flu":
        quaternions = multiply_quaternions(quaternions, np.array(_FRD_FROM_FLU))
    return quaternions


def convert_body_vectors(vectors: Array, frame: BodyFrame) -> Array:
    """Return vectors (n, 3) of a log's body frame in the base frame."""
    return vectors * np.array([1.0, -1.0, -1.0]) if frame == "flu" else vectors
