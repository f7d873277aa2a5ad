"""Balls that cover a set of triangles: a single ball, or a row of balls along a slender set."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array

MIN_SLENDERNESS = 3.0
"""The ratio of length to radius above which a set of triangles has a row of balls."""
MAX_BALLS_IN_ROW = 64
"""The largest number of balls along one set of triangles."""


class Balls(NamedTuple):
    """The balls around the surfaces of a scene at their present poses."""

    centre: Array
    """The centres in W, (n, 3) [m]."""
    radius: Array
    """The radii, (n,) [m]."""
    surface: npt.NDArray[np.int32]
    """The index of the surface that each ball covers, (n,)."""


def covering_balls(corners: Array) -> Array:
    """Return the centres and radii of balls that together cover triangles, (n, 4) [m].

    The axis joins the corner farthest from the middle of the bounding box to the corner farthest
    from that corner. A set longer than `MIN_SLENDERNESS` times its radius about the axis has a row
    of balls along the axis.

    Args:
        corners: the corners of the triangles, (m, 3, 3) or (m, 3) [m].
    """
    points = corners.reshape(-1, 3)
    if not len(points):
        return np.zeros((0, 4))
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    radius = math.sqrt(float(((points - middle) ** 2).sum(axis=1).max()))
    begin = points[int(((points - middle) ** 2).sum(axis=1).argmax())]
    end = points[int(((points - begin) ** 2).sum(axis=1).argmax())]
    length = math.sqrt(float(((end - begin) ** 2).sum()))
    if length > 0.0:
        axis = (end - begin) / length
        axial_positions = ((points - begin) * axis).sum(axis=1)
        off_axis = points - begin - axial_positions[:, None] * axis
        axis_radius = math.sqrt(float((off_axis**2).sum(axis=1).max()))
        if length > MIN_SLENDERNESS * axis_radius:
            n = math.ceil(length / max(2.0 * axis_radius, length / MAX_BALLS_IN_ROW))
            centre_positions = (np.arange(n) + 0.5) * (length / n)  # along the axis
            balls = np.empty((n, 4))
            balls[:, :3] = begin + centre_positions[:, None] * axis
            balls[:, 3] = math.hypot(axis_radius, 0.5 * length / n) * (1.0 + 1e-9)
            return balls
    return np.array([[*middle, radius * (1.0 + 1e-9)]])
