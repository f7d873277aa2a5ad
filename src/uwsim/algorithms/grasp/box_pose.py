r"""Estimation of the pose of a box from its outline, or from the corners of its top face.

The pose vector :math:`x \in R^6` consists of the position of the box in the navigation frame
(north, east, down), its heading, and its tilts about the x and y axes of the box. It minimises, by
Gauss-Newton,

.. math:: \sum_k \frac{(h_k(x) - h_k)^2}{\sigma^2} + \sum_i \frac{(x_i - m_i)^2}{p_i^2}

The support of a shape along a direction is the largest coordinate of its points along that
direction. :math:`h_k` is the support of the detected outline along direction k, and :math:`\sigma`
its standard deviation [px]. :math:`h_k(x)` is :math:`h_k`, limited to an interval between two
supports of the projected visible painted faces (top, bottom and long sides, see `BoxSpec`): without
and with the long sides at a grazing angle, which a detector may miss (`_support_bounds`). The
second sum is the prior with the mean :math:`m` and the standard deviations :math:`p`: the box rests
on the seabed, with nearly the tilt of its slope. If the top face is tracked, the first sum is over
the image coordinates of its corners instead. The covariance of x is the inverse of the normal
matrix.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit
from ...base.numerics.linear import inverse
from .box import BoxPose, BoxSpec
from .camera import View
from .detector import DIRECTIONS, Outline
from .normal_equations import cholesky_solve

TILT_DEVIATION = 0.03
"""The standard deviation of the tilt in the prior [rad]."""
DEPTH_DEVIATION = 0.018
"""The standard deviation of the depth of the box in the prior, relative to the seabed [m]."""
GRAZING_TANGENT = 0.3
"""The tangent of the angle between the line of sight and a side of the box below which the detector
may miss the side."""
UNKNOWN_DEVIATION = 10.0
"""The standard deviation of unknown coordinates in the prior [m, rad]."""
MIN_KNOWN_DIRECTIONS = 12
"""The minimum number of directions with a known support for a fit."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Sighting:
    """A measurement of the pose of an object from one image."""

    pose: BoxPose
    """The pose of the object in the navigation frame."""
    covariance: Array
    """The covariance of the pose vector, (6, 6) [m, rad]."""
    residual: float
    """The root mean square residual of the fit [px]."""
    source: str = "outline"
    """The data from which the pose was computed: ``outline``, ``face`` or ``truth``."""


def pose_from_outline(
    outline: Outline, view: View, box: BoxSpec, *, deviation: float = 0.7
) -> Sighting | None:
    """Fit the pose of a box to an outline; return None if no pose fits.

    Args:
        outline: the outline of the box in the image.
        view: the camera at the time of the image.
        box: the model of the box.
        deviation: the standard deviation of the support of the outline [px].
    """
    if outline.is_known.sum() < MIN_KNOWN_DIRECTIONS:
        return None
    centre = view.intersect_plane(*outline.centre, view.seabed_depth - box.size[2] / 2.0)
    if centre is None:
        return None
    u, v = outline.centre
    axis_point = view.intersect_plane(
        u + 10.0 * math.cos(outline.angle), v + 10.0 * math.sin(outline.angle), centre[2]
    )
    if axis_point is None:
        return None
    axis_heading = math.atan2(float(axis_point[1] - centre[1]), float(axis_point[0] - centre[0]))
    best_fit: Sighting | None = None
    for half_turns in (0.5, 0.35, 0.65):  # the outline may be widest along a diagonal
        start = np.array([*centre.tolist(), axis_heading + half_turns * math.pi, 0.0, 0.0])
        sighting = _fit_outline(start, outline, view, box, deviation)
        if sighting is not None and (best_fit is None or sighting.residual < best_fit.residual):
            best_fit = sighting
    return best_fit


def pose_from_face(
    corners: Array, view: View, box: BoxSpec, initial_pose: BoxPose, *, deviation: float = 1.0
) -> Sighting | None:
    """Fit the pose of a box to the corners of its top face; return None if no pose fits.

    Args:
        corners: the corners in the image, in the order of `BoxSpec.top_face`, (4, 2) [px].
        view: the camera at the time of the image.
        box: the model of the box.
        initial_pose: the pose at which the fit starts.
        deviation: the standard deviation of the corners [px].
    """
    start = initial_pose.vector
    prior = _prior(start, view, box)
    vector, normal, residual = _fit_corners(
        start, prior, box.top_face, corners, _camera(view), 1.0 / deviation**2
    )
    return _sighting(vector, normal, residual, "face")


def _fit_outline(
    start: Array, outline: Outline, view: View, box: BoxSpec, deviation: float
) -> Sighting | None:
    prior = _prior(start, view, box)
    weights = outline.is_known.astype(np.float64) / deviation**2
    vector, normal, residual = _fit_support(
        start, prior, box.corners, DIRECTIONS, outline.support, weights, _camera(view)
    )
    return _sighting(vector, normal, residual, "outline")


def _sighting(vector: Array, normal: Array, residual: float, source: str) -> Sighting | None:
    if not np.isfinite(vector).all() or not math.isfinite(residual):
        return None
    return Sighting(
        pose=BoxPose.from_vector(vector),
        covariance=inverse(normal),  # with the prior, the normal matrix is not singular
        residual=residual,
        source=source,
    )


def _prior(start: Array, view: View, box: BoxSpec) -> Array:
    """Return the mean pose vector of the prior and the inverse variances, (2, 6)."""
    expected = start.copy()
    expected[2] = view.seabed_depth - box.size[2] / 2.0
    expected[4:] = tilt_on_slope(view.slopes, float(start[3]))
    sigma, tilt_sigma = UNKNOWN_DEVIATION, TILT_DEVIATION
    deviations = np.array([sigma, sigma, DEPTH_DEVIATION, sigma, tilt_sigma, tilt_sigma])
    return np.stack([expected, 1.0 / deviations**2])


def tilt_on_slope(slopes: tuple[float, float], heading: float) -> tuple[float, float]:
    """Return the tilt of a box that lies on a sloping seabed [rad].

    Args:
        slopes: the slopes of the seabed's depth to the north and to the east [1].
        heading: the heading of the box [rad].
    """
    north, east = slopes
    c, s = math.cos(heading), math.sin(heading)
    size = math.sqrt(1.0 + north * north + east * east)
    x, y, z = (c * north + s * east) / size, (s * north - c * east) / size, 1.0 / size
    return math.atan2(-y, z), math.asin(x)


def _camera(view: View) -> Array:
    """Return the position, the rotation by rows, fx, fy, cx, cy of a camera, (16,)."""
    pose = view.navigation_from_camera
    return np.concatenate([pose.position, pose.rotation.reshape(9), view.pinhole.intrinsics])


@njit
def _project(vector: Array, points: Array, camera: Array) -> Array:
    """Project points of a box (n, 3) [m] to the image, (n, 2) [px].

    ``vector`` is the pose vector of the box; ``camera`` is the output of `_camera`.
    """
    ch, sh = math.cos(vector[3]), math.sin(vector[3])
    cx, sx = math.cos(vector[4]), math.sin(vector[4])
    cy, sy = math.cos(vector[5]), math.sin(vector[5])
    pixels = np.empty((len(points), 2))
    for k in range(len(points)):
        x, y, z = points[k]
        x, z = cy * x + sy * z, -sy * x + cy * z  # tilt about y, then about x
        y, z = cx * y - sx * z, sx * y + cx * z
        y, z = -y, -z  # from z up to z down
        north = vector[0] + ch * x - sh * y - camera[0]
        east = vector[1] + sh * x + ch * y - camera[1]
        down = vector[2] + z - camera[2]
        camera_x = camera[3] * north + camera[6] * east + camera[9] * down
        camera_y = camera[4] * north + camera[7] * east + camera[10] * down
        depth = camera[5] * north + camera[8] * east + camera[11] * down
        depth = max(depth, 0.05)
        pixels[k, 0] = camera[14] + camera[12] * camera_x / depth
        pixels[k, 1] = camera[15] + camera[13] * camera_y / depth
    return pixels


@njit
def _camera_in_box(vector: Array, camera: Array) -> Array:
    """Return the position of a camera in the frame of a box with a pose vector, (3,) [m]."""
    ch, sh = math.cos(vector[3]), math.sin(vector[3])
    cx, sx = math.cos(vector[4]), math.sin(vector[4])
    cy, sy = math.cos(vector[5]), math.sin(vector[5])
    north, east, down = camera[0] - vector[0], camera[1] - vector[1], camera[2] - vector[2]
    x, y, z = ch * north + sh * east, sh * north - ch * east, -down
    y, z = cx * y + sx * z, -sx * y + cx * z
    return np.array([cy * x - sy * z, y, sy * x + cy * z])


@njit
def _support_bounds(vector: Array, points: Array, directions: Array, camera: Array) -> Array:
    """Return two bounds of the support of the visible painted faces, (2, n) [px].

    The first row excludes, the second row includes a long side that is seen at a grazing angle,
    which a detector may miss. The top face is always visible; the short sides are not painted.
    """
    pixels = _project(vector, points, camera)
    camera_position = _camera_in_box(vector, camera)
    bounds = np.full((2, len(directions)), -1e9)
    for i in range(len(pixels)):
        x, _, z = points[i]
        is_lower = z < 0.0
        # Distance of the camera from the plane of the point's long side, positive outside [m].
        side_distance = camera_position[0] * x / abs(x) - abs(x)
        if is_lower and side_distance <= 0.0:
            continue
        is_grazing = is_lower and side_distance < GRAZING_TANGENT * (camera_position[2] - abs(z))
        for k in range(len(directions)):
            support = directions[k, 0] * pixels[i, 0] + directions[k, 1] * pixels[i, 1]
            bounds[1, k] = max(bounds[1, k], support)
            if not is_grazing:
                bounds[0, k] = max(bounds[0, k], support)
    return bounds


@njit
def _support(
    vector: Array, points: Array, directions: Array, camera: Array, h_measured: Array
) -> Array:
    """Return the measured support, limited to the bounds of `_support_bounds`, (n,) [px]."""
    bounds = _support_bounds(vector, points, directions, camera)
    support = np.empty(len(h_measured))
    for k in range(len(h_measured)):
        support[k] = min(max(h_measured[k], bounds[0, k]), bounds[1, k])
    return support


@njit
def _step(
    vector: Array, prior: Array, h: Array, h_shifted: Array, h_measured: Array, weights: Array
) -> tuple[Array, Array]:
    """Return the normal matrix (6, 6) and the step (6,) of Gauss-Newton.

    Args:
        vector: the pose vector, (6,).
        prior: the mean pose vector and the inverse variances, (2, 6).
        h: the values for the pose vector, (n,) [px].
        h_shifted: the values with each coordinate of the pose vector increased by `_DELTA`, (6, n).
        h_measured: the measured values, (n,) [px].
        weights: the inverse variances of the measured values, (n,); 0 for unknown values.
    """
    normal, right = np.zeros((6, 6)), np.zeros(6)
    for i in range(6):
        normal[i, i] = prior[1, i]
        right[i] = prior[1, i] * (prior[0, i] - vector[i])
    for k in range(len(h)):
        if weights[k] == 0.0:
            continue
        error = h_measured[k] - h[k]
        for i in range(6):
            slope = (h_shifted[i, k] - h[k]) / _DELTA
            right[i] += weights[k] * slope * error
            for j in range(6):
                normal[i, j] += weights[k] * slope * (h_shifted[j, k] - h[k]) / _DELTA
    return normal, cholesky_solve(normal, right)


_DELTA = 1e-4
"""The step of the numerical derivatives [m, rad]."""
_N_ITERATIONS = 12
"""The number of iterations of a fit."""


@njit
def _fit_support(
    start: Array,
    prior: Array,
    points: Array,
    directions: Array,
    h_measured: Array,
    weights: Array,
    camera: Array,
) -> tuple[Array, Array, float]:
    """Return the pose vector (6,), normal matrix (6, 6) and residual [px] for an outline."""
    vector = start.copy()
    normal = np.zeros((6, 6))
    h_shifted = np.empty((6, len(directions)))
    for _ in range(_N_ITERATIONS):
        h = _support(vector, points, directions, camera, h_measured)
        for i in range(6):
            shifted_vector = vector.copy()
            shifted_vector[i] += _DELTA
            h_shifted[i] = _support(shifted_vector, points, directions, camera, h_measured)
        normal, step = _step(vector, prior, h, h_shifted, h_measured, weights)
        vector = vector + np.minimum(np.maximum(step, -0.3), 0.3)
    h = _support(vector, points, directions, camera, h_measured)
    return vector, normal, _root_mean_square(h, h_measured, weights)


@njit
def _fit_corners(
    start: Array,
    prior: Array,
    points: Array,
    corners: Array,
    camera: Array,
    weight: float,
) -> tuple[Array, Array, float]:
    """Return the pose vector (6,), normal matrix (6, 6) and residual [px] for corners (n, 2)."""
    vector = start.copy()
    normal = np.zeros((6, 6))
    h_measured = corners.copy().reshape(-1)
    weights = np.full(len(h_measured), weight)
    h_shifted = np.empty((6, len(h_measured)))
    for _ in range(_N_ITERATIONS):
        h = _project(vector, points, camera).reshape(-1)
        for i in range(6):
            shifted_vector = vector.copy()
            shifted_vector[i] += _DELTA
            h_shifted[i] = _project(shifted_vector, points, camera).reshape(-1)
        normal, step = _step(vector, prior, h, h_shifted, h_measured, weights)
        vector = vector + np.minimum(np.maximum(step, -0.3), 0.3)
    h = _project(vector, points, camera).reshape(-1)
    return vector, normal, _root_mean_square(h, h_measured, weights)


@njit
def _root_mean_square(h: Array, h_measured: Array, weights: Array) -> float:
    total, n = 0.0, 0
    for k in range(len(h)):
        if weights[k] > 0.0:
            total += (h[k] - h_measured[k]) ** 2
            n += 1
    return math.sqrt(total / max(n, 1))
