r"""An object of any shape that is found by its outline and taken at a given point.

The object stands on the bottom. Its place and heading :math:`x = (north, east, \psi)` minimise

.. math:: \sum_k \frac{(h_k(x) - h_k)^2}{\sigma^2}

where :math:`h_k(x)` is how far the projected points of the object's convex hull reach along
direction k, and :math:`h_k` how far the outline does (Gauss-Newton, numerical derivatives, from
several headings). The covariance is :math:`\sigma^2 (J^T J)^{-1}`. Not modelled: parts of the
object that the detector does not find by their colour; objects that lie on a side.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import inverse, product, rotate, transform_points
from .box import BoxPose, half_turn
from .box_pose import LEAN, MIN_KNOWN, Sighting
from .camera import View
from .detector import DIRECTIONS, Detector, Outline, Pixels
from .target import Target

HEADINGS = 6
"""Number of headings from which the fit begins."""
ITERATIONS = 10
STEPS: Array = np.array([1e-4, 1e-4, 1e-3])
"""Steps of the numerical derivatives [m, m, rad]."""
DEVIATION = 1.0
"""Deviation of an outline [px]."""
MAX_RESIDUAL = 3.0
"""A fit with a larger residual is not the object [px]."""
DEPTH_DEVIATION = 0.02
"""Deviation of the object's depth: that of the bottom below it [m]."""
UNKNOWN_HEADING = 0.5
"""Deviation of the heading of a round object, which cannot be seen [rad]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ConvexObject:
    """The known model of an object that stands on the bottom; its frame has z up.

    Args:
        points: corners of its convex hull, (n, 3) [m].
        grip: the point that the jaw takes, (3,) [m].
        closing_angle: direction in which the jaw closes, about z from the x axis [rad].
        is_round: whether all headings look alike; the jaw then closes at its present heading.
    """

    points: Array
    grip_point: Array
    closing_angle: float = 0.0
    is_round: bool = False

    @property
    def lowest(self) -> float:
        """The z coordinate of the lowest point [m]."""
        return float(self.points[:, 2].min())

    def grip(self, pose: BoxPose) -> Array:
        """Return the point that the jaw takes in the navigation frame, (3,) [m]."""
        place: Array = pose.place + rotate(pose.rotation, self.grip_point)
        return place

    def closes(self, pose: BoxPose) -> float:
        """Return the heading of the axis along which the jaw closes, modulo half a turn [rad]."""
        return half_turn(pose.heading - self.closing_angle)


class ConvexPerception:
    """Finds a `ConvexObject` in every image.

    Args:
        detector: returns the outlines of what may be the object.
        model: of the object.
    """

    def __init__(self, detector: Detector, model: ConvexObject) -> None:
        self._detector, self._model = detector, model

    def forget(self) -> None:
        """Do nothing: no track is kept between images."""

    def look(self, image: Pixels, view: View, target: Target, time: float) -> Sighting | None:
        """Look at an image (h, w, 3) RGB; return the sighting that the target took."""
        found = [
            sighting
            for outline in self._detector.detect(image, view)
            if (sighting := fit(outline, view, self._model)) is not None
        ]
        if not found:
            return None
        best = min(found, key=lambda sighting: sighting.residual)
        return best if target.take(best, time) else None


def fit(outline: Outline, view: View, model: ConvexObject) -> Sighting | None:
    """Return the pose of an object that explains an outline best; None where none does."""
    if outline.is_known.sum() < MIN_KNOWN:
        return None
    depth = view.bottom + model.lowest
    middle = view.on_plane(*outline.middle, depth)
    if middle is None:
        return None
    headings = [0.0] if model.is_round else np.arange(HEADINGS) * (2.0 * math.pi / HEADINGS)
    fits = [_fit(np.array([*middle[:2], h]), depth, outline, view, model) for h in headings]
    numbers, covariance, residual = min(fits, key=lambda one: one[2])
    if not residual < MAX_RESIDUAL:
        return None
    full = np.diag([0.0, 0.0, DEPTH_DEVIATION**2, 0.0, LEAN**2, LEAN**2])
    rows = np.array([0, 1, 3])
    full[np.ix_(rows, rows)] = covariance
    pose = BoxPose(place=np.array([*numbers[:2], depth]), heading=float(numbers[2]))
    return Sighting(pose=pose, covariance=full, residual=residual)


def _fit(
    start: Array, depth: float, outline: Outline, view: View, model: ConvexObject
) -> tuple[Array, Array, float]:
    """Place and heading (3,), their covariance (3, 3) and the residual [px]; inf where none is."""
    known = outline.is_known
    numbers = start.astype(np.float64)
    free = 2 if model.is_round else 3
    damping = np.diag(1e-6 / STEPS[:free] ** 2)
    for _ in range(ITERATIONS):
        error = (outline.support - _support(numbers, depth, view, model))[known]
        jacobian = _jacobian(numbers, depth, view, model, free)[known]
        if not (np.isfinite(error).all() and np.isfinite(jacobian).all()):
            return numbers, np.eye(3), math.inf
        normal = product(jacobian.T, jacobian) + damping
        step = product(inverse(normal), product(jacobian.T, error))
        numbers[:free] += np.clip(step, -0.3, 0.3)
    error = (outline.support - _support(numbers, depth, view, model))[known]
    covariance = np.diag([0.0, 0.0, UNKNOWN_HEADING**2])
    covariance[:free, :free] = DEVIATION**2 * inverse(normal)
    return numbers, covariance, math.sqrt(float(np.mean(error * error)))


def _jacobian(numbers: Array, depth: float, view: View, model: ConvexObject, free: int) -> Array:
    """Derivatives of the support by the first ``free`` numbers, (directions, free)."""
    here = _support(numbers, depth, view, model)
    columns: Sequence[Array] = [
        (_support(numbers + STEPS * (np.arange(3) == i), depth, view, model) - here) / STEPS[i]
        for i in range(free)
    ]
    return np.stack(columns, axis=1)


def _support(numbers: Array, depth: float, view: View, model: ConvexObject) -> Array:
    """How far the projected object reaches along each direction, (directions,) [px]."""
    pose = BoxPose(place=np.array([*numbers[:2], depth]), heading=float(numbers[2]))
    pixels = view.project(transform_points(model.points, pose.rotation, pose.place))
    reach: Array = product(pixels, DIRECTIONS.T).max(axis=0)
    return reach
