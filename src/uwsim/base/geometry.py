"""Poses, rotations and pinhole cameras.

A transform ``a_from_b`` maps coordinates in frame b to coordinates in frame a.
Quaternions are wxyz.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

import numpy as np

from .numerics.jit import njit
from .numerics.linear import Array as Array
from .numerics.linear import compose, length, product, rotate_back, transform_points

Triple = tuple[float, float, float]
"""The x, y and z components of a vector."""
ZERO: Triple = (0.0, 0.0, 0.0)
UNIT_SCALE: Triple = (1.0, 1.0, 1.0)


def rotation_x(angle: float) -> Array:
    """Return the right-handed rotation about x by ``angle`` [rad], (3, 3)."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def rotation_y(angle: float) -> Array:
    """Return the right-handed rotation about y by ``angle`` [rad], (3, 3)."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


def rotation_z(angle: float) -> Array:
    """Return the right-handed rotation about z by ``angle`` [rad], (3, 3)."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def rotation_from_rpy(roll: float, pitch: float, yaw: float) -> Array:
    """Return ``Rz(yaw) Ry(pitch) Rx(roll)``: fixed axes, as in ROS and URDF [rad], (3, 3)."""
    rotation = np.empty((3, 3))
    write_rotation(roll, pitch, yaw, rotation)
    return rotation


@njit
def write_rotation(roll: float, pitch: float, yaw: float, rotation: Array) -> None:
    """Write the result of `rotation_from_rpy` into (3, 3)."""
    a, b, c = math.cos(roll), math.cos(pitch), math.cos(yaw)
    u, v, w = math.sin(roll), math.sin(pitch), math.sin(yaw)
    cv, wv = c * v, w * v
    rotation[0, 0], rotation[0, 1], rotation[0, 2] = c * b, cv * u - w * a, w * u + cv * a
    rotation[1, 0], rotation[1, 1], rotation[1, 2] = w * b, c * a + wv * u, wv * a - c * u
    rotation[2, 0], rotation[2, 1], rotation[2, 2] = -v, b * u, b * a
    rotation += 0.0  # no zero is negative


def rotation_from_xyz(x: float, y: float, z: float) -> Array:
    """Return ``Rx(x) Ry(y) Rz(z)``, (3, 3): UWSim's order in vehicles, offsetr, twists [rad]."""
    return product(product(rotation_x(x), rotation_y(y)), rotation_z(z))


def rpy_from_rotation(rotation: Array) -> tuple[float, float, float]:
    """Return roll, pitch, yaw [rad] of ``Rz(yaw) Ry(pitch) Rx(roll)``, (3, 3); |pitch| <= pi/2."""
    r = rotation
    pitch = math.atan2(-r[2, 0], math.hypot(r[0, 0], r[1, 0]))
    if math.hypot(r[0, 0], r[1, 0]) < 1e-9:  # roll and yaw turn about one axis: all is yaw
        return 0.0, pitch, math.atan2(-r[0, 1], r[1, 1])
    return math.atan2(r[2, 1], r[2, 2]), pitch, math.atan2(r[1, 0], r[0, 0])


def xyz_from_rotation(rotation: Array) -> tuple[float, float, float]:
    """Return the angles x, y, z [rad] of ``Rx(x) Ry(y) Rz(z)``, (3, 3); |y| <= pi/2."""
    x, y, z = rpy_from_rotation(rotation.T)  # the inverse has the other order and other signs
    return -x, -y, -z


def cross_matrix(vector: Array) -> Array:
    """Return the matrix (3, 3) whose product with u is the cross product of ``vector`` and u."""
    x, y, z = vector
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def twist_shift(offset: Array) -> Array:
    """Return the matrix (6, 6) from the twist of a point to that of another point of the body.

    Twists have the velocity first; ``offset`` is from the first point to the other, (3,) [m].
    """
    shift = np.eye(6)
    shift[:3, 3:] = -cross_matrix(offset)
    return shift


def rotation_about(axis: Array, angle: float) -> Array:
    """Return the rotation by ``angle`` [rad] about an axis, (3,) of any length, as (3, 3)."""
    unit = np.asarray(axis, dtype=np.float64) / length(axis)
    k = cross_matrix(unit)
    rotation: Array = np.eye(3) + math.sin(angle) * k + (1.0 - math.cos(angle)) * product(k, k)
    return rotation


def quaternion_from_rotation(rotation: Array) -> Array:
    """Return the unit quaternion wxyz, w >= 0, of a rotation (3, 3) (Shepperd's method), (4,)."""
    quaternion = np.empty(4)
    write_quaternion(np.ascontiguousarray(rotation, dtype=np.float64), quaternion)
    return quaternion


@njit
def write_quaternion(rotation: Array, quaternion: Array) -> None:
    """Write the result of `quaternion_from_rotation` into (4,)."""
    xx, xy, xz = rotation[0]
    yx, yy, yz = rotation[1]
    zx, zy, zz = rotation[2]
    trace = xx + yy + zz
    largest_term = max(trace, xx, yy, zz)
    if trace == largest_term:
        w, x, y, z = 1.0 + trace, zy - yz, xz - zx, yx - xy
    elif xx == largest_term:
        w, x, y, z = zy - yz, 1.0 + xx - yy - zz, yx + xy, zx + xz
    elif yy == largest_term:
        w, x, y, z = xz - zx, xy + yx, 1.0 + yy - zz - xx, zy + yz
    else:
        w, x, y, z = yx - xy, xz + zx, yz + zy, 1.0 + zz - xx - yy
    size = math.sqrt(w * w + x * x + y * y + z * z)
    if w / size < 0.0:
        size = -size
    quaternion[0], quaternion[1] = w / size, x / size
    quaternion[2], quaternion[3] = y / size, z / size


def rotation_from_quaternion(wxyz: Array) -> Array:
    """Return the rotation matrix (3, 3) of a quaternion wxyz (4,), normalised first."""
    w, x, y, z = np.asarray(wxyz, dtype=np.float64).tolist()
    size = math.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / size, x / size, y / size, z / size
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


@dataclass(frozen=True, eq=False, slots=True)
class Pose:
    """A rigid transform ``a_from_b``: position and orientation of frame b in frame a."""

    position: Array
    """The origin of b in a, (3,) [m]."""
    rotation: Array
    """The axes of b in a as columns, (3, 3)."""

    @staticmethod
    def identity() -> Pose:
        """Return the pose of a frame in itself."""
        return Pose(np.zeros(3), np.eye(3))

    @staticmethod
    def from_rpy(position: tuple[float, float, float], rpy: tuple[float, float, float]) -> Pose:
        """Return the pose with a position [m] and fixed-axis angles, ``Rz Ry Rx`` [rad]."""
        return Pose(np.array(position, dtype=np.float64), rotation_from_rpy(*rpy))

    @staticmethod
    def from_xyz(position: tuple[float, float, float], xyz: tuple[float, float, float]) -> Pose:
        """Return the pose with a position [m] and angles in UWSim's order, ``Rx Ry Rz`` [rad]."""
        return Pose(np.array(position, dtype=np.float64), rotation_from_xyz(*xyz))

    @staticmethod
    def from_quaternion(position: Array, wxyz: Array) -> Pose:
        """Return the pose with a position (3,) [m] and a quaternion wxyz (4,)."""
        return Pose(np.array(position, dtype=np.float64), rotation_from_quaternion(wxyz))

    @property
    def quaternion(self) -> Array:
        """The rotation as a unit quaternion wxyz, (4,)."""
        return quaternion_from_rotation(self.rotation)

    @property
    def matrix(self) -> Array:
        """The homogeneous matrix, (4, 4)."""
        matrix = np.zeros((4, 4))
        matrix[:3, :3], matrix[:3, 3], matrix[3, 3] = self.rotation, self.position, 1.0
        return matrix

    def __matmul__(self, other: Pose) -> Pose:
        return Pose(*compose(self.rotation, self.position, other.rotation, other.position))

    def copy(self) -> Pose:
        """Return a copy with copied arrays."""
        return Pose(self.position.copy(), self.rotation.copy())

    def inverse(self) -> Pose:
        """Return ``b_from_a``."""
        return Pose(-rotate_back(self.rotation, self.position), self.rotation.T)

    def transform(self, points: Array) -> Array:
        """Return the coordinates in a of points in b, (n, 3) or one (3,), same shape [m]."""
        rows = np.asarray(points, dtype=np.float64)
        coordinates = transform_points(np.atleast_2d(rows), self.rotation, self.position)
        return coordinates.reshape(rows.shape)


def image_centre(width: int, height: int) -> tuple[float, float]:
    """Return the centre of an image in image coordinates (see `Intrinsics`) [px]."""
    return (width - 1) / 2.0, (height - 1) / 2.0


def is_in_image(u: float, v: float, width: int, height: int) -> bool:
    """Return whether a point is on a pixel of an image, edges included (see `Intrinsics`)."""
    return -0.5 <= u <= width - 0.5 and -0.5 <= v <= height - 0.5


class LensMap(Protocol):
    """A lens: the map from ideal normalised coordinates, right and down, to those in the image."""

    def distort(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Return the coordinates in the image of directions; NaN: not in the image."""

    def undistort(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Return the directions of coordinates in the image; NaN: there is none."""


@dataclass(frozen=True, kw_only=True)
class Intrinsics:
    r"""A pinhole camera with OpenGL axes: x right, y up, looking along -z.

    Image coordinates (u, v) are in pixels from the *centre of the first pixel*, top left, as in
    ROS and OpenCV: u to the right, v down. The centre of a pixel is at its column and row.

    .. math:: u = c_x + (f_x X + k Y) / (-Z), \qquad v = c_y - f_y Y / (-Z)

    A lens maps :math:`X / (-Z)` and :math:`-Y / (-Z)` before.
    """

    width: int
    """The number of columns [px]."""
    height: int
    """The number of rows [px]."""
    fx: float
    """The focal length along u [px]."""
    fy: float
    """The focal length along v [px]."""
    cx: float
    """The column of the principal point, from the centre of the first column [px]."""
    cy: float
    """The row of the principal point, from the centre of the first row [px]."""
    skew: float = 0.0
    """The skew k [px]."""
    near: float = 0.18
    """The planar depth of the near plane [m]."""
    far: float = 2000.0
    """The planar depth of the far plane [m]."""
    lens: LensMap | None = None
    """The lens, which distorts the image of the pinhole; None: it does not."""

    @staticmethod
    def from_fovy(
        width: int, height: int, fovy: float, *, near: float = 0.18, far: float = 2000.0
    ) -> Intrinsics:
        """Return the pinhole with a vertical field of view [rad], square pixels, a centred axis."""
        focal = height / (2.0 * math.tan(fovy / 2.0))
        cx, cy = image_centre(width, height)
        return Intrinsics(
            width=width,
            height=height,
            fx=focal,
            fy=focal,
            cx=cx,
            cy=cy,
            near=near,
            far=far,
        )

    def with_size(self, width: int, height: int) -> Intrinsics:
        """Return the pinhole of an image of another size, with the same vertical field of view.

        The ray through the centre of the image does not change.
        """
        factor = height / self.height
        cx, cy = image_centre(width, height)
        old_cx, old_cy = image_centre(self.width, self.height)
        return replace(
            self,
            width=width,
            height=height,
            fx=self.fx * factor,
            fy=self.fy * factor,
            cx=cx + (self.cx - old_cx) * factor,
            cy=cy + (self.cy - old_cy) * factor,
            skew=self.skew * factor,
        )

    def with_margin(self, columns: int, rows: int) -> Intrinsics:
        """Return the pinhole with additional columns and rows of pixels on each side."""
        return replace(
            self,
            width=self.width + 2 * columns,
            height=self.height + 2 * rows,
            cx=self.cx + columns,
            cy=self.cy + rows,
        )

    def project(self, points: Array, *, includes_behind: bool = False) -> Array:
        """Return the image coordinates (n, 2) [px] of points in the camera frame (n, 3) [m].

        Points in or behind the plane z = 0 of the camera give NaN. With ``includes_behind``, points
        behind it are projected through the camera's centre, upside down.
        """
        pixels = [
            self.pixel(x, y, z, includes_behind=includes_behind) for x, y, z in points.tolist()
        ]
        return np.array(pixels).reshape(-1, 2)

    def pixel(
        self, x: float, y: float, z: float, *, includes_behind: bool = False
    ) -> tuple[float, float]:
        """Return the image coordinates u, v [px] of one point, as `project` does for arrays."""
        depth = -z if z < 0.0 or (includes_behind and z != 0.0) else math.nan
        if self.lens is not None:
            right, down = self.lens.distort(np.array([x / depth]), np.array([-y / depth]))
            x, y, depth = float(right[0]), -float(down[0]), 1.0
        return self.cx + (self.fx * x + self.skew * y) / depth, self.cy - self.fy * y / depth

    def rays(self) -> Array:
        """Return the ray through the centre of each pixel in the camera's frame, with z = -1.

        Its shape is (h, w, 3).
        """
        u = np.arange(self.width, dtype=np.float64)
        v = np.arange(self.height, dtype=np.float64)
        y = (self.cy - v) / self.fy
        x = (u[None, :] - self.cx - self.skew * y[:, None]) / self.fx
        y = np.broadcast_to(y[:, None], x.shape)
        if self.lens is not None:
            x, y = self.lens.undistort(x, -y)
            y = -y
        return np.stack([x, y, np.full(x.shape, -1.0)], axis=2)

    @cached_property
    def ray_lengths(self) -> Array:
        """The lengths of `rays`: distance along a ray divided by planar depth, (h, w); read-only.

        They are cached, because their computation takes longer than to render a small image.
        """
        rays = self.rays()
        lengths: Array = np.sqrt((rays * rays).sum(axis=2))
        lengths.flags.writeable = False
        return lengths
