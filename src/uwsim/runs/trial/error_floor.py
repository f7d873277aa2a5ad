r"""The error floor: the error of a perfect tracker, below which differences are meaningless.

A perfect tracker of the target's top face applies the homography H that maps the corners of the
face at the tracker's start to the current corners. It reports :math:`H q_0`, where :math:`q_0` is
its initial quadrangle, and the intersection of the diagonals of :math:`H q_0`. The ground truth,
as the original UWSim defines it, is the smallest rectangle around the projected bounding box, and
the projection of the body's origin. When the camera moves, these move differently from the face, so
even a perfect tracker has an error. Not modelled are noise, the pixel grid, and the parts of the
quadrangle outside the face.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.linalg import LinAlgError

from ...base.geometry import Array
from ...base.numerics.linear import length, product, solve
from ...benchmark.ground_truth import CornersFromCameraSpec, FaceCorners, GroundTruth
from ...benchmark.measures import EuclideanNormSpec
from ...results.result import ERROR_FLOOR_PREFIX
from ...results.stored.stored_row import StoredFact
from ...simulation import Simulation
from ..planning.plan import Plan
from .visibility import Fact

SAMPLE_PERIOD = 16
"""The number of steps from one sample to the next."""


class ErrorFloor:
    """The mean error of a perfect tracker in each measure, for each level [px].

    There are no values if no measure initialises a tracker with a quadrangle.
    """

    def __init__(self, simulation: Simulation, plan: Plan) -> None:
        specs = [spec for spec in plan.benchmark.measures if isinstance(spec, EuclideanNormSpec)]
        tracker_spec = next((spec for spec in specs if _corners_of(spec) is not None), None)
        self._truths: dict[str, GroundTruth] = {}
        self._means: dict[str, list[float]] = {}
        self._sums: dict[str, tuple[float, int]] = {}
        # the quadrangle and the face when the tracker was initialised: (8,) each [px]
        self._reference: tuple[Array, Array] | None = None
        self._is_measured = False
        if tracker_spec is None:
            return
        quad_spec = _corners_of(tracker_spec)
        assert quad_spec is not None
        self._is_started_once = tracker_spec.auto_init == "once"
        world = simulation.world.measure_view
        self._quad = quad_spec.bind(world, tracker_spec.truth)
        self._face = FaceCorners(world.camera(quad_spec.camera), world.body(quad_spec.target))
        self._truths = {
            spec.name: spec.ground_truth.bind(world, spec.truth)
            for spec in specs
            if spec.ground_truth.camera == quad_spec.camera
            and getattr(spec.ground_truth, "target", None) == quad_spec.target
        }
        self._steps = 0
        simulation.watch(self._update)

    def start(self) -> None:
        """Initialise the tracker with its quadrangle, unless it is initialised only once."""
        if self._truths and (self._reference is None or not self._is_started_once):
            quad, face = self._quad.read(), self._face.read()
            self._reference = None if quad is None or face is None else (quad, face)

    def begin(self) -> None:
        """Begin the measurement of a level, and initialise the tracker as `start` does."""
        self.start()
        self._is_measured = True

    def end(self) -> None:
        """End the measurement of a level."""
        for name, (total, n) in self._sums.items():
            self._means.setdefault(name, []).append(total / n)
        self._sums, self._is_measured = {}, False

    @property
    def facts(self) -> dict[str, Fact]:
        """``floor_<measure>`` [px]: the largest mean error of the measure in any level."""
        return {
            f"{ERROR_FLOOR_PREFIX}{name}": (round(max(means), 6), "px")
            for name, means in self._means.items()
        }

    def _update(self) -> None:
        self._steps += 1
        if self._steps % SAMPLE_PERIOD or not self._is_measured or self._reference is None:
            return
        quad, old_face = self._reference
        face = self._face.read()
        motion = None if face is None else homography(old_face, face)
        if motion is None:
            return
        tracked_quad = transform_points(motion, quad.reshape(4, 2))
        estimates = {8: tracked_quad.reshape(8), 2: crossing(tracked_quad)}
        for name, truth in self._truths.items():
            numbers = truth.read()
            if numbers is not None and len(numbers) in estimates:
                total, n = self._sums.get(name, (0.0, 0))
                error = length(numbers - estimates[len(numbers)])
                self._sums[name] = total + error, n + 1


def _corners_of(spec: EuclideanNormSpec) -> CornersFromCameraSpec | None:
    """Return the quadrangle with which a measure initialises a tracker; None if it does not."""
    truth = spec.ground_truth
    is_published = isinstance(truth, CornersFromCameraSpec) and truth.publish_on is not None
    return truth if is_published and isinstance(truth, CornersFromCameraSpec) else None


def largest_error_floors(facts: Iterable[Mapping[str, StoredFact]]) -> dict[str, StoredFact]:
    """Return the largest error floor of each measure in several trials."""
    error_floors: dict[str, StoredFact] = {}
    for trial_facts in facts:
        for name, fact in trial_facts.items():
            is_larger = name not in error_floors or fact[0] > error_floors[name][0]
            if name.startswith(ERROR_FLOOR_PREFIX) and is_larger:
                error_floors[name] = fact
    return error_floors


def homography(source: Array, target: Array) -> Array | None:
    """Return the homography that maps four points to four others; None if there is none.

    Eight equations determine eight elements; the ninth is 1 (Hartley and Zisserman 2004, section
    4.1).

    Args:
        source: x, y of the four points, (8,).
        target: x, y of their images, (8,).

    Returns:
        The homography, (3, 3).
    """
    rows: list[list[float]] = []
    for (x, y), (u, v) in zip(source.reshape(4, 2), target.reshape(4, 2), strict=True):
        rows.append([x, y, 1.0, 0.0, 0.0, 0.0, -u * x, -u * y])
        rows.append([0.0, 0.0, 0.0, x, y, 1.0, -v * x, -v * y])
    try:
        numbers = solve(np.array(rows), target.reshape(8))
    except LinAlgError:
        return None
    return np.append(numbers, 1.0).reshape(3, 3)


def transform_points(homography: Array, points: Array) -> Array:
    """Apply a homography (3, 3) to points (n, 2); return the mapped points (n, 2)."""
    vectors = product(np.column_stack([points, np.ones(len(points))]), homography.T)
    result: Array = vectors[:, :2] / vectors[:, 2:]
    return result


def crossing(quad: Array) -> Array:
    """Return the intersection (2,) of the diagonals of a quadrangle (4, 2)."""
    (x1, y1), (x2, y2), (x3, y3), (x4, y4) = quad.tolist()
    p, q, r = y1 - y3, x3 - x1, x1 * y3 - y1 * x3  # the line p x + q y + r = 0
    u, v, w = y2 - y4, x4 - x2, x2 * y4 - y2 * x4
    point: Array = np.array([q * w - r * v, r * u - p * w]) / (p * v - q * u)
    return point
