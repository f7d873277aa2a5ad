"""The last image of each camera in a level, which the report shows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ....base.files.image_record import ImageRecord
from ....benchmark.ground_truth import CornersFromCameraSpec
from ....benchmark.measures import EuclideanNorm, EuclideanNormSpec, Measure, MeasureSpec
from ....simulation import Simulation
from ....simulation.scenery.image_origin import describe_image


@dataclass(frozen=True, eq=False, kw_only=True)
class Snapshot:
    """A camera's last image, with the true and the estimated corners of the target."""

    camera: str
    """The name of the camera."""
    pixels: npt.NDArray[np.uint8]
    """The image, (h, w, 3) RGB."""
    truth: tuple[float, ...] | None
    """x, y of the target's four corners [px]; None if no measure compares corners."""
    estimate: tuple[float, ...] | None
    """x, y of the four corners in the algorithm's last estimate [px]; None without an estimate."""
    record: ImageRecord
    """The record of the image, in its file; its time is that of the end of the level or phase."""


def capture(
    simulation: Simulation,
    measures: Sequence[tuple[MeasureSpec, Measure]],
    *,
    is_tracking: bool,
) -> tuple[Snapshot, ...]:
    """Return the last image of every camera that published one.

    An estimate is included only if ``is_tracking`` is True, as an older estimate is not valid.
    """
    snapshots: dict[str, Snapshot] = {}
    for images in simulation.world.images.values():
        name = images.camera.name
        if images.last_pixels is not None and name not in snapshots:
            truth, estimate = _corners(name, measures)
            snapshots[name] = Snapshot(
                camera=name,
                pixels=images.last_pixels,
                truth=truth,
                estimate=estimate if is_tracking else None,
                record=describe_image(
                    simulation, name, is_linear=images.camera.pixel_type is np.uint16
                ),
            )
    return tuple(snapshots.values())


def _corners(
    camera: str, measures: Sequence[tuple[MeasureSpec, Measure]]
) -> tuple[tuple[float, ...] | None, tuple[float, ...] | None]:
    """Return the true and estimated corners from the first measure that compares them."""
    for spec, measure in measures:
        if not isinstance(spec, EuclideanNormSpec) or not isinstance(measure, EuclideanNorm):
            continue
        truth = spec.ground_truth
        if isinstance(truth, CornersFromCameraSpec) and truth.camera == camera:
            return _quad_numbers(measure.ground_truth), _quad_numbers(measure.estimate)
    return None, None


def _quad_numbers(values: npt.NDArray[np.float64] | None) -> tuple[float, ...] | None:
    if values is None or values.shape != (8,) or not np.isfinite(values).all():
        return None
    return tuple(values.tolist())
