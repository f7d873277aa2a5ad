r"""The model and perception of an object of any shape, which is grasped at a given point.

The object rests on the seabed, with the z axis of its frame up; the navigation frame has the axes
north, east and down. Its position and heading :math:`x = (north, east, \psi)` minimise

.. math:: \sum_k \frac{(h_k(x) - h_k)^2}{\sigma^2}

where :math:`h_k(x)` is the support (see `box_pose`) of the object's projected convex hull along
direction k, :math:`h_k` the support of the detected outline, and :math:`\sigma` its standard
deviation [px]. The method is Gauss-Newton with numerical derivatives J, from several initial
headings. The covariance of x is :math:`\sigma^2 (J^T J)^{-1}`. Not modelled: parts of the object
that the detector does not detect by their colour, and objects that have tipped over.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import inverse, product, rotate, transform_points
from .box import BoxPose, wrap_half_turn
from .box_pose import MIN_KNOWN_DIRECTIONS, TILT_DEVIATION, Sighting
from .camera import View
from .detector import DIRECTIONS, Detector, Outline, Pixels
from .target import TargetEstimate

N_HEADINGS = 6
"""The number of initial headings of the fit."""
N_ITERATIONS = 10
"""The number of iterations of the fit."""
STEPS: Array = np.array([1e-4, 1e-4, 1e-3])
"""The steps of the numerical derivatives, (3,) [m, m, rad]."""
OUTLINE_DEVIATION = 1.0
"""The standard deviation of the support of an outline [px]."""
MAX_RESIDUAL = 3.0
"""The largest residual of a fit that is accepted [px]."""
DEPTH_DEVIATION = 0.02
"""The standard deviation of the depth of the seabed, and therefore of the object [m]."""
ROUND_HEADING_DEVIATION = 0.5
"""The standard deviation of the heading of a round object, which is not observable [rad]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ConvexObject:
    """The model of an object that rests on the seabed; its frame has z up."""

    points: Array
    """The corners of the convex hull in the frame of the object, (n, 3) [m]."""
    grip_point: Array
    """The point that the jaw grasps, in the frame of the object, (3,) [m]."""
    closing_angle: float = 0.0
    """The angle about z from the x axis of the object to the axis along which the jaw closes
    [rad]."""
    is_round: bool = False
    """True if the object looks the same at all headings; the jaw then keeps its heading."""

    clearance: float = 0.0
    """The height of the lowest point over the seabed, as of a plate on a panel [m]."""

    @property
    def min_z(self) -> float:
        """The z coordinate of the lowest point [m]."""
        return float(self.points[:, 2].min())

    def grasp_point(self, pose: BoxPose) -> Array:
        """Return the point that the jaw grasps in the navigation frame, (3,) [m]."""
        position: Array = pose.position + rotate(pose.rotation, self.grip_point)
        return position

    def closing_heading(self, pose: BoxPose) -> float:
        """Return the heading of the axis along which the jaw closes, modulo half a turn [rad]."""
        return wrap_half_turn(pose.heading - self.closing_angle)


class ConvexPerception:
    """A perception that fits the pose of a `ConvexObject` in every image.

    Args:
        detector: the detector of outlines that may be the object.
        model: the model of the object.
    """

    def __init__(self, detector: Detector, model: ConvexObject) -> None:
        self._detector, self._model = detector, model

    def reset(self) -> None:
        """Do nothing, as there is no state between images."""

    def observe(
        self, image: Pixels, view: View, target: TargetEstimate, time: float
    ) -> Sighting | None:
        """Update the target from an image; see `uwsim.algorithms.grasp.ObjectPerception`."""
        sightings = [
            sighting
            for outline in self._detector.detect(image, view)
            if (sighting := fit_pose(outline, view, self._model)) is not None
        ]
        if not sightings:
            return None
        best_fit = min(sightings, key=lambda sighting: sighting.residual)
        return best_fit if target.update(best_fit, time) else None


def fit_pose(outline: Outline, view: View, model: ConvexObject) -> Sighting | None:
    """Fit the pose of an object to an outline; return None if no fit is good enough."""
    if outline.is_known.sum() < MIN_KNOWN_DIRECTIONS:
        return None
    depth = view.seabed_depth + model.min_z - model.clearance
    centre = view.intersect_plane(*outline.centre, depth)
    if centre is None:
        return None
    headings = [0.0] if model.is_round else np.arange(N_HEADINGS) * (2.0 * math.pi / N_HEADINGS)
    fits = [_fit_from(np.array([*centre[:2], h]), depth, outline, view, model) for h in headings]
    vector, covariance, residual = min(fits, key=lambda candidate: candidate[2])
    if not residual < MAX_RESIDUAL:
        return None
    tilt = TILT_DEVIATION**2
    full_covariance = np.diag([0.0, 0.0, DEPTH_DEVIATION**2, 0.0, tilt, tilt])
    rows = np.array([0, 1, 3])
    full_covariance[np.ix_(rows, rows)] = covariance
    pose = BoxPose(position=np.array([*vector[:2], depth]), heading=float(vector[2]))
    return Sighting(pose=pose, covariance=full_covariance, residual=residual)


def _fit_from(
    start: Array, depth: float, outline: Outline, view: View, model: ConvexObject
) -> tuple[Array, Array, float]:
    """Fit north, east and heading (3,) [m, rad], starting at ``start``.

    Returns:
        The fitted numbers, their covariance (3, 3), and the root mean square residual [px], which
        is infinite if there is no fit.
    """
    is_known = outline.is_known
    vector = start.astype(np.float64)
    n_free = 2 if model.is_round else 3
    damping = np.diag(1e-6 / STEPS[:n_free] ** 2)
    for _ in range(N_ITERATIONS):
        error = (outline.support - _support(vector, depth, view, model))[is_known]
        jacobian = _jacobian(vector, depth, view, model, n_free)[is_known]
        if not (np.isfinite(error).all() and np.isfinite(jacobian).all()):
            return vector, np.eye(3), math.inf
        normal = product(jacobian.T, jacobian) + damping
        step = product(inverse(normal), product(jacobian.T, error))
        vector[:n_free] += np.clip(step, -0.3, 0.3)
    error = (outline.support - _support(vector, depth, view, model))[is_known]
    covariance = np.diag([0.0, 0.0, ROUND_HEADING_DEVIATION**2])
    covariance[:n_free, :n_free] = OUTLINE_DEVIATION**2 * inverse(normal)
    return vector, covariance, math.sqrt(float(np.mean(error * error)))


def _jacobian(vector: Array, depth: float, view: View, model: ConvexObject, n_free: int) -> Array:
    """Return the derivatives of the support with respect to ``n_free`` unknowns, (n, n_free)."""
    support = _support(vector, depth, view, model)
    columns: Sequence[Array] = [
        (_support(vector + STEPS * (np.arange(3) == i), depth, view, model) - support) / STEPS[i]
        for i in range(n_free)
    ]
    return np.stack(columns, axis=1)


def _support(vector: Array, depth: float, view: View, model: ConvexObject) -> Array:
    """Return the support of the projected object along each direction, (n,) [px]."""
    pose = BoxPose(position=np.array([*vector[:2], depth]), heading=float(vector[2]))
    pixels = view.project(transform_points(model.points, pose.rotation, pose.position))
    support: Array = product(pixels, DIRECTIONS.T).max(axis=0)
    return support
