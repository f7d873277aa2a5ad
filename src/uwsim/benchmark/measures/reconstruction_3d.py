"""Reconstruction 3D: the error of point clouds against a body's box.

.. code-block:: xml

    <reconstruction3D detailedResultsToGlobals="true">
      <name>reconstruction</name> <target>blackbox</target>
      <topic>/LaserReconstructionPointCloud</topic> <from>kinematic_base</from>
      <levelOfDetail>0.01</levelOfDetail>
    </reconstruction3D>
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from ...base.geometry import Array, Pose
from ...base.numerics.linear import product
from ...errors import BadSetting
from ...messages import PointCloud2, points
from ...schema import REQUIRED_BY_DTD, element
from ...world import Body, Box, World
from ..metrics.coverage import Coverage
from ..metrics.reconstruction import Reconstruction, turned_box, upright
from .measure import Measure, MeasureSpec

ORIGINAL_FIELDS = {
    "mean error": "mean_error",
    "error variance": "error_variance",
    "coverage %": "coverage",
    "outliers %": "outlier_share",
}
"""The original's name of a detail -> ours."""
MAX_NOTES = 5
"""Greatest number of kinds of unreadable clouds that are reported."""


@dataclass(frozen=True, kw_only=True)
class Reconstruction3DSpec(MeasureSpec):
    """A ``<reconstruction3D>`` element of a benchmark file."""

    target: str = element(refers_to="body")
    """Route of the body that is rebuilt."""
    topic: str
    """Topic of the clouds (sensor_msgs/PointCloud2)."""
    from_: str | None = element("from", default=None, original=REQUIRED_BY_DTD, refers_to="body")
    """Route of the body in whose frame the clouds are given; without one they are in W, not L."""
    level_of_detail: float = element(default=0.003, above=0.0)
    """Cell size of the coverage [m]."""
    detailed_results_to_globals: bool = element(default=False, attribute=True)
    """Whether result.dat has the details instead of the value."""

    @property
    def original_fields(self) -> Mapping[str, str]:
        """The value, or the details in its place."""
        if not self.detailed_results_to_globals:
            return {self.name: self.name}
        return {name: f"{self.name}.{detail}" for name, detail in ORIGINAL_FIELDS.items()}

    @property
    def start_value(self) -> float:
        """The original's start value."""
        return 0.0

    def bind(self, world: World) -> Reconstruction3D:
        """Find target and frame.

        Raises:
            UnknownName: one of them is not there.
            BadSetting: the target has no shape, or the level of detail makes too many cells.
        """
        target = world.body(self.target)
        frame = None if self.from_ is None else world.body(self.from_)
        if target.box is None:
            raise BadSetting(
                f"{self.target!r} has no shape that could be rebuilt; expected an object, or the "
                "shape of a link as link@visual.",
                name=self.target,
            )
        try:
            return Reconstruction3D(self, world, target, target.box, frame)
        except BadSetting as error:
            error.name = self.name
            raise


class Reconstruction3D(Measure):
    """Mean distance of the points of all clouds so far from the surface of a body's box.

    Each cloud is brought from the frame ``from`` to the body's as both stand at the step at which
    it arrives; the message's frame_id is not looked at, and points of which a coordinate is NaN,
    infinite or beyond 1e9 m are skipped. `uwsim.benchmark.metrics.reconstruction` says which points
    are ground, outliers and inliers: only inliers have an error. The box is the body's own bounding
    box, however it lies; its top is the side that looks most upwards when the level begins.

    There is no value when no cloud came, or none of its points was an inlier. Clouds add up until
    the level ends, so none of them gets too old: that the topic is silent is no failure.

    Details: ``mean_error`` (the value) [m]; ``error_variance`` over n - 1, None with one inlier
    [m^2]; ``coverage``, the share of the nodes on the five faces above ground that a point lies
    near [1] (`uwsim.benchmark.metrics.coverage`); ``outlier_share``, outliers among outliers and
    inliers [1]; and how many points and clouds there were of each kind. An error of 0 needs a
    perfect *box*: what of the body's shape lies within its bounding box counts as error. Repeating
    one good point makes the mean small: compare the coverage.

    Compatibility ``reconstruction-transform``: clouds are brought to the body's frame as both
    stood when the level began. ``reconstruction-box``: two corners of the box are turned into W
    and sorted, which is right only for quarter turns. ``reconstruction-coverage``: the original's
    number of nodes. ``reconstruction-empty``: without inliers the error is 0 and its variance -0.
    """

    unit = "m"
    detail_units: ClassVar[Mapping[str, str]] = {
        "mean_error": "m",
        "error_variance": "m^2",
        **dict.fromkeys(("coverage", "outlier_share", "n_inliers", "n_outliers"), "1"),
        **dict.fromkeys(("n_ground", "n_skipped", "n_clouds"), "1"),
    }
    fed_by_algorithm = True

    def __init__(
        self,
        spec: Reconstruction3DSpec,
        world: World,
        target: Body,
        box: Box,
        frame: Body | None,
    ) -> None:
        quirks = world.compatibility
        self._target, self._frame, self._topic = target, frame, spec.topic
        self._inbox = world.bus.inbox(spec.topic, PointCloud2)
        rotation = target.world_from_body.rotation
        self._box_from_target = rotation if "reconstruction-box" in quirks else upright(rotation)
        turned = turned_box(box, self._box_from_target)
        self._points = Reconstruction(
            turned,
            Coverage(turned, spec.level_of_detail, is_original="reconstruction-coverage" in quirks),
        )
        self._fixed = self._target_from_frame() if "reconstruction-transform" in quirks else None
        self._is_never_empty = "reconstruction-empty" in quirks
        self._was_on = False
        self._n_clouds = 0
        self._refused: dict[str, None] = {}  # what was wrong with clouds

    def start(self) -> None:
        """Forget the clouds that came before."""
        self._was_on = True
        self._inbox.clear()

    def update(self) -> None:
        """Add the clouds that arrived."""
        for cloud in self._inbox.take():
            try:
                found = points(cloud)
            except BadSetting as error:
                if len(self._refused) < MAX_NOTES:
                    self._refused[f"a cloud on {self._topic!r} was not used: {error}"] = None
                continue
            self._n_clouds += 1
            self._add(found)

    @property
    def value(self) -> float | None:
        """Mean distance of the inliers from the surface [m]."""
        if self._is_never_empty and self._was_on:
            return self._points.mean or 0.0
        return self._points.mean

    @property
    def why(self) -> str | None:
        """Why there is no value."""
        if self.value is not None:
            return None
        if not self._was_on:
            return "it was never on"
        if not self._n_clouds:
            return next(iter(self._refused), f"no cloud on {self._topic!r}")
        points = self._points
        return (
            f"none of the points on {self._topic!r} belongs to the target: {points.n_ground} are "
            f"ground, {points.n_outliers} outliers, {points.n_skipped} no places"
        )

    @property
    def details(self) -> dict[str, float | None]:
        """The original's four, and how many points and clouds there were."""
        points = self._points
        variance = points.variance
        if self._is_never_empty and not points.n_inliers:
            variance = points.squares / (points.n_inliers - 1)
        return {
            "mean_error": self.value,
            "error_variance": variance,
            "coverage": points.coverage if self._n_clouds or self._is_never_empty else None,
            "outlier_share": points.outlier_share,
            "n_inliers": float(points.n_inliers),
            "n_outliers": float(points.n_outliers),
            "n_ground": float(points.n_ground),
            "n_skipped": float(points.n_skipped),
            "n_clouds": float(self._n_clouds),
        }

    @property
    def reasons(self) -> dict[str, str]:
        """Why there is no variance, or no share, where there is a value."""
        points = self._points
        if points.n_inliers == 1:
            return {"error_variance": "there was one inlier only"}
        if self._is_never_empty and not points.n_inliers + points.n_outliers:
            return {"outlier_share": "there was no inlier and no outlier: 0/0"}
        return {}

    @property
    def log_header(self) -> tuple[str, ...]:
        """The original's four details."""
        return tuple(ORIGINAL_FIELDS.values())

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """As of now."""
        details = self.details
        return tuple(details[name] for name in self.log_header)

    @property
    def notes(self) -> tuple[str, ...]:
        """What was wrong with clouds that could not be used."""
        return tuple(self._refused)

    def close(self) -> None:
        """Unsubscribe."""
        self._inbox.close()

    def _target_from_frame(self) -> Pose:
        target_from_world = self._target.world_from_body.inverse()
        if self._frame is None:
            return target_from_world
        return target_from_world @ self._frame.world_from_body

    def _add(self, found: Array) -> None:
        """Add a cloud (n, 3) [m], given in the frame ``from``."""
        target_from_frame = self._fixed or self._target_from_frame()
        turn = self._box_from_target
        self._points.add(
            found,
            product(turn, target_from_frame.rotation),
            product(turn, target_from_frame.position),
        )
