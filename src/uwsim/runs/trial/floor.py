r"""The error floor: the score of a perfect tracker, below which differences are meaningless.

A tracker of the target's top face that is never wrong follows the homography H which takes the
face's corners from where they were when it was started to where they are now. What it reports is
then :math:`H q_0`, with the quad :math:`q_0` that it was started on, and where the diagonals of
that cross. The truth of the original is the smallest rectangle round the projected bounding box,
and the projection of the body's origin: seen from another place they move otherwise than the face.
A face that is seen exactly and a quad on it would be followed without error; not modelled are
noise, the pixels' grid, and what of the quad is not on the face.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.linalg import LinAlgError

from ...base.geometry import Array
from ...base.numerics.linear import length, product, solve
from ...benchmark.ground_truth import CornersFromCameraSpec, FaceCorners, GroundTruth
from ...benchmark.measures import EuclideanNormSpec
from ...results.result import FLOOR
from ...results.stored.stored_row import StoredFact
from ...simulation import Simulation
from ..planning.plan import Plan
from .visibility import Fact

EVERY = 16
"""Steps from one look to the next."""


class Floor:
    """What a perfect tracker scores in each measure of pixels, level by level.

    Does nothing where no measure starts a tracker on a quad.
    """

    def __init__(self, simulation: Simulation, plan: Plan) -> None:
        specs = [spec for spec in plan.benchmark.measures if isinstance(spec, EuclideanNormSpec)]
        starting = next((spec for spec in specs if _corners_of(spec) is not None), None)
        self._truths: dict[str, GroundTruth] = {}
        self._means: dict[str, list[float]] = {}
        self._sums: dict[str, tuple[float, int]] = {}
        self._then: tuple[Array, Array] | None = None  # the quad given, and the face: (8,) each
        self._is_measured = False
        if starting is None:
            return
        chosen = _corners_of(starting)
        assert chosen is not None
        self._is_started_once = starting.auto_init == "once"
        world = simulation.world.measure_view
        self._given = chosen.bind(world, starting.truth)
        self._face = FaceCorners(world.camera(chosen.camera), world.body(chosen.target))
        self._truths = {
            spec.name: spec.ground_truth.bind(world, spec.truth)
            for spec in specs
            if spec.ground_truth.camera == chosen.camera
            and getattr(spec.ground_truth, "target", None) == chosen.target
        }
        self._steps = 0
        simulation.watch(self._look)

    def start(self) -> None:
        """Initialise the tracker with its quad, unless that happens only once."""
        if self._truths and (self._then is None or not self._is_started_once):
            quad, face = self._given.read(), self._face.read()
            self._then = None if quad is None or face is None else (quad, face)

    def begin(self) -> None:
        """A level is measured from now on, and the tracker is given its quad."""
        self.start()
        self._is_measured = True

    def end(self) -> None:
        """The level is over."""
        for name, (total, n) in self._sums.items():
            self._means.setdefault(name, []).append(total / n)
        self._sums, self._is_measured = {}, False

    @property
    def facts(self) -> dict[str, Fact]:
        """``floor_<measure>`` [px]: the mean error of the level in which that is largest."""
        return {
            f"{FLOOR}{name}": (round(max(means), 6), "px") for name, means in self._means.items()
        }

    def _look(self) -> None:
        self._steps += 1
        if self._steps % EVERY or not self._is_measured or self._then is None:
            return
        quad, face_then = self._then
        face = self._face.read()
        moved = None if face is None else homography(face_then, face)
        if moved is None:
            return
        followed = through(moved, quad.reshape(4, 2))
        estimates = {8: followed.reshape(8), 2: crossing(followed)}
        for name, truth in self._truths.items():
            found = truth.read()
            if found is not None and len(found) in estimates:
                total, n = self._sums.get(name, (0.0, 0))
                error = length(found - estimates[len(found)])
                self._sums[name] = total + error, n + 1


def _corners_of(spec: EuclideanNormSpec) -> CornersFromCameraSpec | None:
    """The quad with which this measure initialises a tracker; None where it does not."""
    truth = spec.ground_truth
    starts = isinstance(truth, CornersFromCameraSpec) and truth.publish_on is not None
    return truth if starts and isinstance(truth, CornersFromCameraSpec) else None


def largest(facts: Iterable[Mapping[str, StoredFact]]) -> dict[str, StoredFact]:
    """Put together the floors of several trials: the largest of each."""
    found: dict[str, StoredFact] = {}
    for each in facts:
        for name, fact in each.items():
            if name.startswith(FLOOR) and (name not in found or fact[0] > found[name][0]):
                found[name] = fact
    return found


def homography(before: Array, after: Array) -> Array | None:
    """Return the homography that takes four points to four others, (3, 3); None if there is none.

    Eight equations for eight unknowns, with the ninth number 1 (Hartley and Zisserman 2004,
    section 4.1).
    """
    rows: list[list[float]] = []
    for (x, y), (u, v) in zip(before.reshape(4, 2), after.reshape(4, 2), strict=True):
        rows.append([x, y, 1.0, 0.0, 0.0, 0.0, -u * x, -u * y])
        rows.append([0.0, 0.0, 0.0, x, y, 1.0, -v * x, -v * y])
    try:
        found = solve(np.array(rows), after.reshape(8))
    except LinAlgError:
        return None
    return np.append(found, 1.0).reshape(3, 3)


def through(homography: Array, points: Array) -> Array:
    """Take points (n, 2) through a homography, (n, 2)."""
    taken = product(np.column_stack([points, np.ones(len(points))]), homography.T)
    result: Array = taken[:, :2] / taken[:, 2:]
    return result


def crossing(quad: Array) -> Array:
    """Return where the diagonals of a quad (4, 2) cross, (2,)."""
    (x1, y1), (x2, y2), (x3, y3), (x4, y4) = quad.tolist()
    p, q, r = y1 - y3, x3 - x1, x1 * y3 - y1 * x3  # the line p x + q y + r = 0
    u, v, w = y2 - y4, x4 - x2, x2 * y4 - y2 * x4
    point: Array = np.array([q * w - r * v, r * u - p * w]) / (p * v - q * u)
    return point
