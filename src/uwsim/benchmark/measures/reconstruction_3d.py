"""Reconstruction 3D: the distance of measured points from the surface of a body's bounding box.

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
from ..metrics.reconstruction import Reconstruction, rotate_box, upright_rotation
from .measure import Measure, MeasureSpec

ORIGINAL_FIELDS = {
    "mean error": "mean_error",
    "error variance": "error_variance",
    "coverage %": "coverage",
    "outliers %": "outlier_share",
}
"""The details by their names in the original UWSim."""
MAX_NOTES = 5
"""The greatest number of different errors of clouds that are reported."""


@dataclass(frozen=True, kw_only=True)
class Reconstruction3DSpec(MeasureSpec):
    """A ``<reconstruction3D>`` element of a benchmark file."""

    target: str = element(refers_to="body")
    """The route of the reconstructed body."""
    topic: str
    """The topic of the clouds (sensor_msgs/PointCloud2)."""
    from_: str | None = element("from", default=None, original=REQUIRED_BY_DTD, refers_to="body")
    """The route of the body in whose frame the points are given; None: the world frame W (not the
    localized world L)."""
    level_of_detail: float = element(default=0.003, exclusive_minimum=0.0)
    """The distance between the grid nodes of the coverage [m]."""
    detailed_results_to_globals: bool = element(default=False, attribute=True)
    """True if ``result.dat`` has the details instead of the value."""

    @property
    def original_fields(self) -> Mapping[str, str]:
        """The value, or the details in place of the value."""
        if not self.detailed_results_to_globals:
            return {self.name: self.name}
        return {name: f"{self.name}.{detail}" for name, detail in ORIGINAL_FIELDS.items()}

    @property
    def start_value(self) -> float:
        """The value that the original UWSim reports before the first cloud [m]."""
        return 0.0

    def bind(self, world: World) -> Reconstruction3D:
        """Resolve target and frame.

        Raises:
            UnknownName: target or frame is unknown.
            BadSetting: the target has no shape, or the level of detail gives too many nodes.
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
    """The mean distance of measured points from the surface of a body's local bounding box.

    The mean is over all clouds of the level. Each cloud is transformed from the frame ``from`` to
    the frame of the body, with the poses of both frames at the step at which the cloud arrives. The
    message's frame_id is not used, and points with a coordinate that is NaN, infinite or beyond
    1e9 m are skipped. `uwsim.benchmark.metrics.reconstruction` classifies points as ground,
    outliers and inliers; only inliers count in the mean. The box may have any attitude; its top is
    the side that points most upwards when the level begins.

    There is no value without a cloud, or without an inlier. A time without clouds is no failure.

    Details: ``mean_error`` (the value) [m]; ``error_variance``, divided by n - 1, None with one
    inlier [m^2]; ``coverage``, the fraction of the grid nodes on the five faces above the ground
    that have a point near them [1] (`uwsim.benchmark.metrics.coverage`); ``outlier_share``, the
    fraction of outliers among outliers and inliers [1]; and the numbers of points of each kind and
    of clouds. Only a body with the shape of a *box* can have an error of 0: for any other body the
    distance of its surface from its bounding box counts as error. Measuring one accurate point many
    times makes the mean small: compare the coverage.

    Compatibility ``reconstruction-transform``: clouds are transformed with the poses that both
    frames had when the level began. ``reconstruction-box``: two corners of the box are rotated to
    W and sorted, which is right only for quarter turns. ``reconstruction-coverage``: the number of
    nodes is that of the original UWSim. ``reconstruction-empty``: without inliers the error is 0
    and its variance -0.
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
        self, spec: Reconstruction3DSpec, world: World, target: Body, box: Box, frame: Body | None
    ) -> None:
        quirks = world.compatibility
        self._target, self._frame, self._topic = target, frame, spec.topic
        self._inbox = world.bus.inbox(spec.topic, PointCloud2)
        rotation = target.world_from_body.rotation
        self._box_from_target = (
            rotation if "reconstruction-box" in quirks else upright_rotation(rotation)
        )
        rotated_box = rotate_box(box, self._box_from_target)
        self._points = Reconstruction(
            rotated_box,
            Coverage(
                rotated_box, spec.level_of_detail, is_original="reconstruction-coverage" in quirks
            ),
        )
        self._fixed_pose = (
            self._target_from_frame() if "reconstruction-transform" in quirks else None
        )
        self._is_never_empty = "reconstruction-empty" in quirks
        self._was_active = False
        self._n_clouds = 0
        self._errors: dict[str, None] = {}  # the errors of clouds

    def start(self) -> None:
        """Discard the clouds received before."""
        self._was_active = True
        self._inbox.clear()

    def update(self) -> None:
        """Add the clouds that arrived."""
        for cloud in self._inbox.take():
            try:
                cloud_points = points(cloud)
            except BadSetting as error:
                if len(self._errors) < MAX_NOTES:
                    self._errors[f"a cloud on {self._topic!r} was not used: {error}"] = None
                continue
            self._n_clouds += 1
            self._add(cloud_points)

    @property
    def value(self) -> float | None:
        """The mean distance of the inliers from the surface [m]."""
        if self._is_never_empty and self._was_active:
            return self._points.mean or 0.0
        return self._points.mean

    @property
    def missing_reason(self) -> str | None:
        """The reason why there is no value."""
        if self.value is not None:
            return None
        if not self._was_active:
            return "it was never on"
        if not self._n_clouds:
            return next(iter(self._errors), f"no cloud on {self._topic!r}")
        points = self._points
        return (
            f"none of the points on {self._topic!r} belongs to the target: {points.n_ground} are "
            f"ground, {points.n_outliers} outliers, {points.n_skipped} no places"
        )

    @property
    def details(self) -> dict[str, float | None]:
        """The four details of the original UWSim, and the numbers of points and clouds."""
        points = self._points
        variance = points.variance
        if self._is_never_empty and not points.n_inliers:
            variance = points.squared_deviations / (points.n_inliers - 1)
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
        """The reasons why there is no variance, or no outlier share, although there is a value."""
        points = self._points
        if points.n_inliers == 1:
            return {"error_variance": "there was one inlier only"}
        if self._is_never_empty and not points.n_inliers + points.n_outliers:
            return {"outlier_share": "there was no inlier and no outlier: 0/0"}
        return {}

    @property
    def log_header(self) -> tuple[str, ...]:
        """The four details of the original UWSim."""
        return tuple(ORIGINAL_FIELDS.values())

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The present values."""
        details = self.details
        return tuple(details[name] for name in self.log_header)

    @property
    def notes(self) -> tuple[str, ...]:
        """The errors of invalid clouds."""
        return tuple(self._errors)

    def close(self) -> None:
        """Unsubscribe."""
        self._inbox.close()

    def _target_from_frame(self) -> Pose:
        target_from_world = self._target.world_from_body.inverse()
        if self._frame is None:
            return target_from_world
        return target_from_world @ self._frame.world_from_body

    def _add(self, cloud_points: Array) -> None:
        """Add a cloud (n, 3) [m], given in the frame ``from``."""
        target_from_frame = self._fixed_pose or self._target_from_frame()
        box_from_target = self._box_from_target
        self._points.add(
            cloud_points,
            product(box_from_target, target_from_frame.rotation),
            product(box_from_target, target_from_frame.position),
        )
