"""Pinhole cameras as OpenGL matrices, and what they can see."""

from __future__ import annotations

import numpy as np

from ..base.geometry import Array, Intrinsics


def clip_from_camera(intrinsics: Intrinsics) -> Array:
    r"""Projection matrix (4, 4) whose *first* row of pixels is the top of the image.

    With :math:`w_c = -Z`: :math:`x = (2u + 1)/w - 1`, :math:`y = (2v + 1)/h - 1` of
    `Intrinsics.project`, where the corner of the image is (-0.5, -0.5). Upside down for OpenGL,
    so that reading back needs no flip; the winding of triangles turns round.
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
    """The six planes (6, 4) of the visible volume: ``n . p + d >= 0`` inside, n of unit length."""
    rows = clip_from_camera
    planes = np.concatenate([rows[3] + rows[:3], rows[3] - rows[:3]])
    unit: Array = planes / np.linalg.norm(planes[:, :3], axis=1, keepdims=True)
    return unit
