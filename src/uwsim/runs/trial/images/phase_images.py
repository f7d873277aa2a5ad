"""Images of the phases of a task, for the report: an external view, with a camera's image inset.

An image is rendered when its phase ends. No random number is drawn and nothing is published, so a
trial is the same with and without these images.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ....base.files.image_record import ImageRecord
from ....base.geometry import Array, Intrinsics, Pose
from ....base.numerics.linear import length
from ....benchmark.measures import Measure
from ....scene.mounts import camera_axes
from ....simulation import Simulation
from ....simulation.scenery.image_origin import describe_image
from ....world import Body
from ..triggered_measure import TriggeredMeasure
from .snapshots import Snapshot, capture

SIZE = (640, 400)
"""The size of an image [px]."""
FIELD_OF_VIEW = np.radians(45.0)
"""The vertical field of view [rad]."""
DISTANCE = 2.6
"""The distance of the viewpoint from the target [m]."""
VIEW_DIRECTION = (-0.45, 0.75, 0.35)
"""The direction from the target to the viewpoint: its components ahead of the vehicle, to
starboard, and up. The length of the vector has no effect."""
INSET_HEIGHT = 0.45
"""The height of the camera's image, relative to the height of the whole image."""
MAX_IMAGES = 24
"""The greatest number of images of one level."""
PREFIX = "phase"
"""The prefix of the name of a phase image, which is stored in place of a camera's name."""


class PhaseImages:
    """The images at the end of each phase that a measure names."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._phase: str | None = None
        self._images: dict[str, tuple[npt.NDArray[np.uint8], ImageRecord]] = {}
        self._n_images = 0

    @property
    def snapshots(self) -> tuple[Snapshot, ...]:
        """The images, one for each phase, in the order in which the phases first ended."""
        return tuple(
            Snapshot(
                camera=f"{PREFIX} {i} {name}",
                pixels=pixels,
                truth=None,
                estimate=None,
                record=record,
            )
            for i, (name, (pixels, record)) in enumerate(self._images.items(), 1)
        )

    def update(self, measures: Sequence[TriggeredMeasure]) -> None:
        """Render an image if a phase has ended."""
        for measure in measures:
            name = measure.measure.current_phase
            if name is None:
                continue
            if name != self._phase:
                self._render(measure.measure)
                self._phase = name
            return

    def end(self, measures: Sequence[TriggeredMeasure]) -> None:
        """Render an image of the last phase."""
        for measure in measures:
            if measure.measure.current_phase is not None:
                self._render(measure.measure)
                return

    def _render(self, measure: Measure) -> None:
        bodies = measure.viewed_bodies
        if self._phase is None or bodies is None or self._n_images >= MAX_IMAGES:
            return
        self._n_images += 1
        record = describe_image(self._simulation, f"view at the end of {self._phase}")
        self._images[self._phase] = self._draw(*bodies), record

    def _draw(self, vehicle: Body, target: Body) -> npt.NDArray[np.uint8]:
        """Return an external view with a camera's last image in a corner, (h, w, 3) RGB."""
        pose = observer_pose(vehicle.world_from_body, target.world_from_body.position)
        intrinsics = Intrinsics.from_fovy(*SIZE, float(FIELD_OF_VIEW))
        scenery = self._simulation.world.scenery
        view = scenery.render_view(pose, intrinsics, targets=frozenset({"colour"}))
        assert view.colour is not None
        pixels = np.ascontiguousarray(view.colour.view(np.uint8)[..., :3])
        for images in self._simulation.world.images.values():
            if images.last_pixels is not None:
                return with_inset(pixels, images.last_pixels)
        return pixels


def all_snapshots(
    simulation: Simulation,
    measures: Sequence[TriggeredMeasure],
    phase_images: PhaseImages | None,
    *,
    is_tracking: bool,
) -> tuple[Snapshot, ...]:
    """Return the cameras' last images, and the phase images if there are any."""
    pairs = [(measure.spec, measure.measure) for measure in measures]
    snapshots = capture(simulation, pairs, is_tracking=is_tracking)
    return snapshots if phase_images is None else (*snapshots, *phase_images.snapshots)


def observer_pose(world_from_vehicle: Pose, target: Array) -> Pose:
    """Return the pose in the world frame of a viewpoint that faces a target; OpenGL camera axes.

    Args:
        world_from_vehicle: the pose of the vehicle, whose heading determines the viewpoint.
        target: the position of the target in the world frame, (3,) [m].
    """
    forward = world_from_vehicle.rotation[:, 0] * [1.0, 1.0, 0.0]
    if length(forward) < 1e-3:
        forward = np.array([1.0, 0.0, 0.0])
    forward = forward / length(forward)
    up = np.array([0.0, 0.0, 1.0])
    starboard = np.cross(forward, up)
    direction = VIEW_DIRECTION[0] * forward + VIEW_DIRECTION[1] * starboard + VIEW_DIRECTION[2] * up
    direction = direction / length(direction)
    return Pose(target + DISTANCE * direction, camera_axes(-direction, up))


def with_inset(
    pixels: npt.NDArray[np.uint8], image: npt.NDArray[np.uint8]
) -> npt.NDArray[np.uint8]:
    """Draw an image into the upper left corner of another, with a white line around it."""
    colour = np.repeat(image[..., None], 3, axis=2) if image.ndim == 2 else image[..., :3]
    height = round(INSET_HEIGHT * pixels.shape[0])
    width = round(height * colour.shape[1] / colour.shape[0])
    rows = np.arange(height) * colour.shape[0] // height
    columns = np.arange(width) * colour.shape[1] // width
    inset = colour[rows[:, None], columns[None, :]]
    composite = pixels.copy()
    composite[4 : 8 + height, 4 : 8 + width] = 255
    composite[6 : 6 + height, 6 : 6 + width] = inset
    return composite
