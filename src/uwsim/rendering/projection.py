"""OpenGL projection matrices of pinhole cameras, and the planes of their frustums."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ..base.geometry import Array, Intrinsics
from ..base.numerics.linear import solve


@dataclass(frozen=True, eq=False)
class Projection:
    """The matrix, frustum and corner rays of a pinhole; the arrays are shared and read-only."""

    clip_from_camera: Array
    """The projection matrix, (4, 4)."""
    planes: Array
    """The planes of the frustum in the camera's frame, (6, 4); see `frustum`."""
    corner_rays: Array
    """The points at the image's corners at a depth of 1 m in the camera's frame, (4, 3) [m]."""


@lru_cache(maxsize=64)
def projection(intrinsics: Intrinsics) -> Projection:
    """Return the projection of a pinhole; the last 64 are cached."""
    clip = clip_from_camera(intrinsics)
    return Projection(clip, frustum(clip), _corner_rays(clip))


def clip_from_camera(intrinsics: Intrinsics) -> Array:
    r"""Return the projection matrix, (4, 4), whose *first* row of pixels is the top of the image.

    A point with image coordinates :math:`u, v` (`Intrinsics.project`) has the normalised device
    coordinates :math:`x = (2u + 1)/w - 1`, :math:`y = (2v + 1)/h - 1`. The image is upside down for
    OpenGL, so that reading it back needs no flip; the winding of triangles is reversed.
    """
    i = intrinsics
    span = i.far - i.near
    return np.array(
        [
            [2.0 * i.fx / i.width, 2.0 * i.skew / i.width, 1.0 - (2.0 * i.cx + 1.0) / i.width, 0.0],
            [0.0, -2.0 * i.fy / i.height, 1.0 - (2.0 * i.cy + 1.0) / i.height, 0.0],
            [0.0, 0.0, -(i.far + i.near) / span, -2.0 * i.far * i.near / span],
            [0.0, 0.0, -1.0, 0.0],
        ]
    )


def frustum(clip_from_camera: Array) -> Array:
    """Return the six planes (n, d), (6, 4), of a frustum: ``n . p + d >= 0`` inside, |n| = 1."""
    rows = clip_from_camera
    planes = np.concatenate([rows[3] + rows[:3], rows[3] - rows[:3]])
    unit: Array = planes / np.linalg.norm(planes[:, :3], axis=1, keepdims=True)
    return unit


def _corner_rays(clip_from_camera: Array) -> Array:
    """Return the points at the corners of the image at a depth of 1 m, camera frame, (4, 3) [m]."""
    corners = np.array([[x, y, 1.0] for x in (-1.0, 1.0) for y in (-1.0, 1.0)])
    # With z = -1: x_clip = P00 x + P01 y - P02, y_clip = P11 y - P12, w = 1.
    matrix = clip_from_camera[:2, :3]
    xy = solve(matrix[:, :2], (corners[:, :2] + matrix[:, 2]).T).T
    return np.column_stack([xy, -corners[:, 2]])
