r"""Reconstruction: the distance of measured points from the surface of a box.

Everything is in the frame of the box, whose axes are parallel to the faces, z up. For a box with
the lower corner l and the upper corner u, a point p has the distances

.. math::
    d_{out} = \lVert \max(l - p,\ p - u,\ 0) \rVert \qquad
    d_{plane} = \min_i \min(|p_i - l_i|, |p_i - u_i|) \qquad
    d = \max(d_{out}, d_{plane})

from the box (0 inside), from the nearest plane of a face, and from the surface of the box. With the
distance :math:`g = |p_z - l_z|` from the plane of the lower face, the point is *ground* if g < d
and g <= 0.1 m, else an *outlier* if d >= 0.15 m, else an *inlier*. These are the rules of the
original UWSim.
"""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import product
from ...world import Box
from .coverage import Coverage

MAX_GROUND_DISTANCE = 0.10
"""The greatest distance of ground points from the plane of the lower face [m]."""
MIN_OUTLIER_DISTANCE = 0.15
"""The smallest distance of outliers from the surface of the box [m]."""
MAX_COORDINATE = 1e9
"""The greatest absolute value of a coordinate of a valid point [m]."""
BLOCK_SIZE = 1 << 15
"""The number of points in a block, which fits into a processor's cache."""


class Reconstruction:
    """The statistics of points that were measured on a box."""

    def __init__(self, box: Box, coverage: Coverage) -> None:
        self._lower, self._upper = (np.array(side)[:, None] for side in (box.lower, box.upper))
        self._coverage = coverage
        self.n_inliers = 0
        self.n_outliers = 0
        self.n_ground = 0
        self.n_skipped = 0
        """The number of points with a coordinate that is NaN or beyond `MAX_COORDINATE`."""
        self._mean = 0.0  # of d over the inliers [m]
        self._squares = 0.0  # sum of the squared deviations of d from the mean [m^2]

    def add(self, points: Array, rotation: Array, offset: Array) -> None:
        """Add points, which are transformed to the frame of the box.

        Args:
            points: the points in any frame, (n, 3) [m].
            rotation: the rotation from that frame to the frame of the box, (3, 3).
            offset: the origin of that frame in the frame of the box, (3,) [m].
        """
        for begin in range(0, len(points), BLOCK_SIZE):
            block = points[begin : begin + BLOCK_SIZE]
            is_valid = (np.abs(block) <= MAX_COORDINATE).all(axis=1)  # NaN is not
            if not is_valid.all():
                self.n_skipped += len(block) - int(is_valid.sum())
                block = block[is_valid]
            box_points = product(rotation, block.T) + offset[:, None]  # (3, n) [m]
            self._classify(box_points)
            self._coverage.mark(box_points)

    @property
    def mean(self) -> float | None:
        """The mean distance of the inliers from the surface [m]; None without inliers."""
        return self._mean if self.n_inliers else None

    @property
    def squared_deviations(self) -> float:
        """The sum of the squared deviations of the inliers' distances from the mean [m^2]."""
        return self._squares

    @property
    def variance(self) -> float | None:
        """The variance of the inliers' distances [m^2]; None with fewer than two inliers.

        The sum of squared deviations is divided by n - 1.
        """
        return self._squares / (self.n_inliers - 1) if self.n_inliers > 1 else None

    @property
    def outlier_share(self) -> float | None:
        """The fraction of outliers among inliers and outliers [1]; None when there is neither."""
        n = self.n_inliers + self.n_outliers
        return self.n_outliers / n if n else None

    @property
    def coverage(self) -> float | None:
        """The fraction of the nodes on five faces with points near them [1]; see `Coverage`."""
        return self._coverage.share

    def _classify(self, points: Array) -> None:
        """Count ground, outliers and inliers among points (3, n) [m], in the frame of the box."""
        lower_excess, upper_excess = self._lower - points, points - self._upper
        excess = np.maximum(np.maximum(lower_excess, upper_excess), 0.0)
        d_out = np.sqrt(np.einsum("ij,ij->j", excess, excess))
        d_plane = np.minimum(np.abs(lower_excess), np.abs(upper_excess)).min(axis=0)
        d = np.maximum(d_out, d_plane)
        g = np.abs(lower_excess[2])
        is_ground = (g < d) & (g <= MAX_GROUND_DISTANCE)
        is_outlier = ~is_ground & (d >= MIN_OUTLIER_DISTANCE)
        self.n_ground += int(is_ground.sum())
        self.n_outliers += int(is_outlier.sum())
        self._add_inliers(d[~(is_ground | is_outlier)])

    def _add_inliers(self, d: Array) -> None:
        """Update the mean and the squared deviations with distances d (Chan, Golub, LeVeque)."""
        if not d.size:
            return
        mean = float(d.mean())
        squares = float(np.square(d - mean).sum())
        n_before, self.n_inliers = self.n_inliers, self.n_inliers + d.size
        deviation = mean - self._mean
        self._squares += squares + deviation * deviation * n_before * d.size / self.n_inliers
        self._mean += deviation * d.size / self.n_inliers


def upright_rotation(rotation: Array) -> Array:
    """Return the rotation of quarter turns that brings a body's axes nearest to those of W, (3, 3).

    W is the world frame, z up, and ``rotation`` is world_from_body, (3, 3). Each row selects an
    axis of the body, possibly reversed: the last row the axis that points most upwards, the first
    row the one of the other two that is nearest to the x axis of W. If ``rotation`` consists of
    quarter turns, the result equals ``rotation``.
    """
    box_from_body = np.zeros((3, 3))
    axes = [2, 1, 0]
    for row in (2, 0, 1):
        components = rotation[row]  # of each of the body's axes
        axis = max(axes, key=lambda i: (round(abs(float(components[i])), 9), i == row, i))
        box_from_body[row, axis] = 1.0 if components[axis] >= 0.0 else -1.0
        axes.remove(axis)
    return box_from_body


def rotate_box(box: Box, rotation: Array) -> Box:
    """Rotate the lower and the upper corner of a box, and return the box between these points.

    The result encloses the rotated box only if ``rotation`` (3, 3) consists of quarter turns.
    """
    corners = product([box.lower, box.upper], rotation.T)
    lower, upper = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
    return Box(tuple(lower), tuple(upper))
