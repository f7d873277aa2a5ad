r"""The pose of a box from its outline, or from the corners of its top face.

Gauss-Newton on place, heading and lean :math:`x \in R^6` of

.. math:: \sum_k \frac{(h_k(x) - h_k)^2}{\sigma^2} + \sum_i \frac{(x_i - m_i)^2}{p_i^2}

where :math:`h_k(x)` is how far the projected corners reach along direction k (the support function
of the painted faces that are seen), :math:`h_k` how far the outline does, and the second sum the
prior: the box stands on the bottom and leans little. With the corners of a tracked face, the first
sum is over their image coordinates. The covariance of x is the inverse of the normal matrix.
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

LEAN = 0.03
"""Deviation of the lean that is expected [rad]."""
BOTTOM = 0.018
"""Deviation of the depth of the box from that of the bottom [m]."""
GRAZING = 0.3
"""Tangent of the angle below which a side is seen too obliquely to count on it."""
ANYWHERE = 10.0
"""Deviation of what is not known beforehand [m, rad]."""
MIN_KNOWN = 12
"""So many directions of an outline have to be known."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Sighting:
    """A pose that was found in one image."""

    pose: BoxPose
    """Where the box is."""
    covariance: Array
    """Of place, heading and lean, (6, 6) [m, rad]."""
    residual: float
    """Of the fit, root of the mean square [px]."""
    source: str = "outline"
    """What it was found from: ``outline`` or ``face``."""


def pose_from_outline(
    outline: Outline, view: View, box: BoxSpec, *, deviation: float = 0.7
) -> Sighting | None:
    """Return the pose that explains an outline best; None where nothing does.

    Args:
        outline: of the box in the image.
        view: the camera when it took the image.
        box: the model.
        deviation: of the outline [px].
    """
    if outline.is_known.sum() < MIN_KNOWN:
        return None
    middle = view.on_plane(*outline.middle, view.bottom - box.size[2] / 2.0)
    if middle is None:
        return None
    u, v = outline.middle
    ahead = view.on_plane(
        u + 10.0 * math.cos(outline.angle), v + 10.0 * math.sin(outline.angle), middle[2]
    )
    if ahead is None:
        return None
    along = math.atan2(float(ahead[1] - middle[1]), float(ahead[0] - middle[0]))
    best: Sighting | None = None
    for turn in (0.5, 0.35, 0.65):  # the longest direction is a diagonal at times
        start = np.array([*middle.tolist(), along + turn * math.pi, 0.0, 0.0])
        found = _fit(start, outline, view, box, deviation)
        if found is not None and (best is None or found.residual < best.residual):
            best = found
    return best


def pose_from_face(
    corners: Array, view: View, box: BoxSpec, near: BoxPose, *, deviation: float = 1.0
) -> Sighting | None:
    """Return the pose that explains the corners of the top face (4, 2) [px], in their order.

    The search begins at the pose ``near``.
    """
    start = near.numbers
    prior = _prior(start, view, box)
    numbers, normal, residual = _fit_corners(
        start, prior, box.face, corners, _camera(view), 1.0 / deviation**2
    )
    return _sighting(numbers, normal, residual, "face")


def _fit(
    start: Array, outline: Outline, view: View, box: BoxSpec, deviation: float
) -> Sighting | None:
    prior = _prior(start, view, box)
    weights = outline.is_known.astype(np.float64) / deviation**2
    numbers, normal, residual = _fit_support(
        start, prior, box.corners, DIRECTIONS, outline.support, weights, _camera(view)
    )
    return _sighting(numbers, normal, residual, "outline")


def _sighting(numbers: Array, normal: Array, residual: float, source: str) -> Sighting | None:
    if not np.isfinite(numbers).all() or not math.isfinite(residual):
        return None
    return Sighting(
        pose=BoxPose.from_numbers(numbers),
        covariance=inverse(normal),  # the prior keeps it regular
        residual=residual,
        source=source,
    )


def _prior(start: Array, view: View, box: BoxSpec) -> Array:
    """Expected numbers and their weights, (2, 6)."""
    expected = start.copy()
    expected[2] = view.bottom - box.size[2] / 2.0
    expected[4:] = lean_on(view.slopes, float(start[3]))
    deviations = np.array([ANYWHERE, ANYWHERE, BOTTOM, ANYWHERE, LEAN, LEAN])
    return np.stack([expected, 1.0 / deviations**2])


def lean_on(slopes: tuple[float, float], heading: float) -> tuple[float, float]:
    """Lean [rad] of a box that lies with a heading [rad] on a bottom with two slopes [1]."""
    north, east = slopes
    c, s = math.cos(heading), math.sin(heading)
    size = math.sqrt(1.0 + north * north + east * east)
    x, y, z = (c * north + s * east) / size, (s * north - c * east) / size, 1.0 / size
    return math.atan2(-y, z), math.asin(x)


def _camera(view: View) -> Array:
    """Position, rotation by rows, fx, fy, cx, cy, (16,)."""
    pose = view.navigation_from_camera
    return np.concatenate([pose.position, pose.rotation.reshape(9), view.pinhole.numbers])


@njit
def _projected(numbers: Array, points: Array, camera: Array) -> Array:
    """Image coordinates (n, 2) of points of a box (n, 3) whose pose is given."""
    ch, sh = math.cos(numbers[3]), math.sin(numbers[3])
    cx, sx = math.cos(numbers[4]), math.sin(numbers[4])
    cy, sy = math.cos(numbers[5]), math.sin(numbers[5])
    found = np.empty((len(points), 2))
    for k in range(len(points)):
        x, y, z = points[k]
        x, z = cy * x + sy * z, -sy * x + cy * z  # lean about y, then about x
        y, z = cx * y - sx * z, sx * y + cx * z
        y, z = -y, -z  # from z up to z down
        north = numbers[0] + ch * x - sh * y - camera[0]
        east = numbers[1] + sh * x + ch * y - camera[1]
        down = numbers[2] + z - camera[2]
        right = camera[3] * north + camera[6] * east + camera[9] * down
        below = camera[4] * north + camera[7] * east + camera[10] * down
        ahead = camera[5] * north + camera[8] * east + camera[11] * down
        ahead = max(ahead, 0.05)
        found[k, 0] = camera[14] + camera[12] * right / ahead
        found[k, 1] = camera[15] + camera[13] * below / ahead
    return found


@njit
def _camera_in_box(numbers: Array, camera: Array) -> Array:
    """Position of the camera in the frame of the box, (3,) [m]."""
    ch, sh = math.cos(numbers[3]), math.sin(numbers[3])
    cx, sx = math.cos(numbers[4]), math.sin(numbers[4])
    cy, sy = math.cos(numbers[5]), math.sin(numbers[5])
    north, east, down = camera[0] - numbers[0], camera[1] - numbers[1], camera[2] - numbers[2]
    x, y, z = ch * north + sh * east, sh * north - ch * east, -down
    y, z = cx * y + sx * z, -sx * y + cx * z
    return np.array([cy * x - sy * z, y, sy * x + cy * z])


@njit
def _reach(numbers: Array, points: Array, directions: Array, camera: Array) -> Array:
    """How far the painted faces that are seen reach along each direction, (2, n).

    The first row is without, the second with a long side that is seen at a grazing angle: it may
    be found in an image or not. The top face is always seen; the ends are bare.
    """
    seen = _projected(numbers, points, camera)
    place = _camera_in_box(numbers, camera)
    found = np.full((2, len(directions)), -1e9)
    for i in range(len(seen)):
        x, _, z = points[i]
        is_lower = z < 0.0
        beyond = place[0] * x / abs(x) - abs(x)  # how far the camera is out from that side
        if is_lower and beyond <= 0.0:
            continue
        is_grazing = is_lower and beyond < GRAZING * (place[2] - abs(z))
        for k in range(len(directions)):
            reach = directions[k, 0] * seen[i, 0] + directions[k, 1] * seen[i, 1]
            found[1, k] = max(found[1, k], reach)
            if not is_grazing:
                found[0, k] = max(found[0, k], reach)
    return found


@njit
def _support(
    numbers: Array, points: Array, directions: Array, camera: Array, measured: Array
) -> Array:
    """The reach that is nearest to the measured one between both of `_reach`, (n,)."""
    reach = _reach(numbers, points, directions, camera)
    found = np.empty(len(measured))
    for k in range(len(measured)):
        found[k] = min(max(measured[k], reach[0, k]), reach[1, k])
    return found


@njit
def _step(
    numbers: Array, prior: Array, found: Array, moved: Array, measured: Array, weights: Array
) -> tuple[Array, Array]:
    """Normal matrix (6, 6) and step (6,) of Gauss-Newton.

    ``moved`` (6, n) are the values with each number moved by `_DELTA`.
    """
    normal, right = np.zeros((6, 6)), np.zeros(6)
    for i in range(6):
        normal[i, i] = prior[1, i]
        right[i] = prior[1, i] * (prior[0, i] - numbers[i])
    for k in range(len(found)):
        if weights[k] == 0.0:
            continue
        error = measured[k] - found[k]
        for i in range(6):
            slope = (moved[i, k] - found[k]) / _DELTA
            right[i] += weights[k] * slope * error
            for j in range(6):
                normal[i, j] += weights[k] * slope * (moved[j, k] - found[k]) / _DELTA
    return normal, cholesky_solve(normal, right)


_DELTA = 1e-4
_ITERATIONS = 12


@njit
def _fit_support(
    start: Array,
    prior: Array,
    points: Array,
    directions: Array,
    measured: Array,
    weights: Array,
    camera: Array,
) -> tuple[Array, Array, float]:
    """Numbers (6,), normal matrix (6, 6) and residual [px] of the fit to an outline."""
    numbers = start.copy()
    normal = np.zeros((6, 6))
    moved = np.empty((6, len(directions)))
    for _ in range(_ITERATIONS):
        found = _support(numbers, points, directions, camera, measured)
        for i in range(6):
            other = numbers.copy()
            other[i] += _DELTA
            moved[i] = _support(other, points, directions, camera, measured)
        normal, by = _step(numbers, prior, found, moved, measured, weights)
        numbers = numbers + np.minimum(np.maximum(by, -0.3), 0.3)
    found = _support(numbers, points, directions, camera, measured)
    return numbers, normal, _root_mean_square(found, measured, weights)


@njit
def _fit_corners(
    start: Array,
    prior: Array,
    points: Array,
    corners: Array,
    camera: Array,
    weight: float,
) -> tuple[Array, Array, float]:
    """Numbers (6,), normal matrix (6, 6) and residual [px] of the fit to corners (n, 2)."""
    numbers = start.copy()
    normal = np.zeros((6, 6))
    measured = corners.copy().reshape(-1)
    weights = np.full(len(measured), weight)
    moved = np.empty((6, len(measured)))
    for _ in range(_ITERATIONS):
        found = _projected(numbers, points, camera).reshape(-1)
        for i in range(6):
            other = numbers.copy()
            other[i] += _DELTA
            moved[i] = _projected(other, points, camera).reshape(-1)
        normal, by = _step(numbers, prior, found, moved, measured, weights)
        numbers = numbers + np.minimum(np.maximum(by, -0.3), 0.3)
    found = _projected(numbers, points, camera).reshape(-1)
    return numbers, normal, _root_mean_square(found, measured, weights)


@njit
def _root_mean_square(found: Array, measured: Array, weights: Array) -> float:
    total, n = 0.0, 0
    for k in range(len(found)):
        if weights[k] > 0.0:
            total += (found[k] - measured[k]) ** 2
            n += 1
    return math.sqrt(total / max(n, 1))
