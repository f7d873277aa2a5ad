r"""Reconstruction: the error of measured points against a box.

Everything is in the frame of the box: its faces are parallel to the axes, z' is up. With the box
from l to u, a point p has the distances

.. math::
    d_{out} = \lVert \max(l - p,\ p - u,\ 0) \rVert \qquad
    d_{plane} = \min_i \min(|p_i - l_i|, |p_i - u_i|) \qquad
    d = \max(d_{out}, d_{plane})

from the box, from the planes of its faces, and from its surface. With :math:`g = |p_z - l_z|`, the
distance from the plane the box stands on, it is *ground* if g < d and g <= 0.1 m, else an *outlier*
if d >= 0.15 m, else an *inlier*. These are the original's rules.
"""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import product
from ...world import Box
from .coverage import Coverage

GROUND = 0.10
"""What is as near to the plane below the box, and nearer than to the box, is ground [m]."""
OUTLIER = 0.15
"""What is as far from the surface of the box is no part of it [m]."""
MAX_COORDINATE = 1e9
"""Coordinates beyond this are no measurements [m]."""
BLOCK = 1 << 15
"""How many points are worked on at once: as many as stay in a processor's cache."""


class Reconstruction:
    """A box and running statistics of the points measured of it."""

    def __init__(self, box: Box, coverage: Coverage) -> None:
        self._lower, self._upper = (np.array(side)[:, None] for side in (box.lower, box.upper))
        self._coverage = coverage
        self.n_inliers = 0
        self.n_outliers = 0
        self.n_ground = 0
        self.n_skipped = 0
        """Points of which a coordinate was no number, or beyond `MAX_COORDINATE`."""
        self._mean = 0.0  # of d over the inliers [m]
        self._squares = 0.0  # sum of squared deviations from it [m^2]

    def add(self, points: Array, rotation: Array, offset: Array) -> None:
        """Take points (n, 3) [m] that ``rotation`` (3, 3) and ``offset`` (3,) bring to the box."""
        for begin in range(0, len(points), BLOCK):
            block = points[begin : begin + BLOCK]
            is_place = (np.abs(block) <= MAX_COORDINATE).all(axis=1)  # NaN is not
            if not is_place.all():
                self.n_skipped += len(block) - int(is_place.sum())
                block = block[is_place]
            moved = product(rotation, block.T) + offset[:, None]  # (3, n) [m]
            self._classify(moved)
            self._coverage.mark(moved)

    @property
    def mean(self) -> float | None:
        """Mean distance of the inliers from the surface [m]; None without inliers."""
        return self._mean if self.n_inliers else None

    @property
    def squares(self) -> float:
        """Sum of the squared deviations from the mean [m^2]."""
        return self._squares

    @property
    def variance(self) -> float | None:
        """Variance of that distance, over n - 1 [m^2]; None with fewer than two inliers."""
        return self._squares / (self.n_inliers - 1) if self.n_inliers > 1 else None

    @property
    def outlier_share(self) -> float | None:
        """Outliers among inliers and outliers [1]; None when there is neither."""
        n = self.n_inliers + self.n_outliers
        return self.n_outliers / n if n else None

    @property
    def coverage(self) -> float | None:
        """Share of the five faces with points near them [1]."""
        return self._coverage.share

    def _classify(self, points: Array) -> None:
        """Sort points (3, n) into ground, outliers and inliers."""
        below, above = self._lower - points, points - self._upper
        outside = np.maximum(np.maximum(below, above), 0.0)
        d_out = np.sqrt(np.einsum("ij,ij->j", outside, outside))
        d_plane = np.minimum(np.abs(below), np.abs(above)).min(axis=0)
        d = np.maximum(d_out, d_plane)
        g = np.abs(below[2])
        is_ground = (g < d) & (g <= GROUND)
        is_outlier = ~is_ground & (d >= OUTLIER)
        self.n_ground += int(is_ground.sum())
        self.n_outliers += int(is_outlier.sum())
        self._add_inliers(d[~(is_ground | is_outlier)])

    def _add_inliers(self, d: Array) -> None:
        """Merge mean and squares of another group into those so far (Chan, Golub, LeVeque)."""
        if not d.size:
            return
        mean = float(d.mean())
        squares = float(np.square(d - mean).sum())
        before, self.n_inliers = self.n_inliers, self.n_inliers + d.size
        off = mean - self._mean
        self._squares += squares + off * off * before * d.size / self.n_inliers
        self._mean += off * d.size / self.n_inliers


def upright(rotation: Array) -> Array:
    """Permute a body's axes by quarter turns so that they are nearest to those of W, (3, 3).

    The rows are axes of the body, some of them reversed: the last is the one that points most
    upwards in ``rotation`` (world_from_body), the first of the other two the one nearest to W's x.
    For a body turned by quarter turns only, this *is* ``rotation``.
    """
    turned = np.zeros((3, 3))
    left = [2, 1, 0]
    for row in (2, 0, 1):
        towards = rotation[row]  # of each of the body's axes
        axis = max(left, key=lambda i: (round(abs(float(towards[i])), 9), i == row, i))
        turned[row, axis] = 1.0 if towards[axis] >= 0.0 else -1.0
        left.remove(axis)
    return turned


def turned_box(box: Box, rotation: Array) -> Box:
    """Turn the lowest and the highest corner of a box, and sort each coordinate of the two.

    A box round the turned one only where ``rotation`` (3, 3) is made of quarter turns.
    """
    ends = product([box.lower, box.upper], rotation.T)
    lower, upper = ends.min(axis=0).tolist(), ends.max(axis=0).tolist()
    return Box(tuple(lower), tuple(upper))
