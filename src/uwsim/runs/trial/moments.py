"""Images of the phases of a task, for the report: what an observer sees, with the camera's image.

Each is taken when its phase ends. They are rendered from the scene as it is; no random number is
drawn and nothing is published, so a trial is the same with and without them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Intrinsics, Pose
from ...base.numerics.linear import length
from ...benchmark.measures import Measure
from ...scene.mounts import camera_axes
from ...simulation import Simulation
from ...world import Body
from .snapshots import Snapshot, capture
from .triggered_measure import TriggeredMeasure

SIZE = (640, 400)
"""[px]"""
FIELD = np.radians(45.0)
"""Vertical."""
DISTANCE = 2.6
"""From the watched body [m]."""
FROM = (-0.45, 0.75, 0.35)
"""Where the observer is: ahead of the vehicle, to its starboard, above; relative."""
INSET = 0.45
"""Height of the camera's image, relative to the whole."""
MAX_IMAGES = 24
"""Of one level."""
PREFIX = "phase"
"""How the name of such an image begins, in the place of a camera's name."""


class Moments:
    """Takes an image at the end of each phase that a measure names."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._now: str | None = None
        self._taken: dict[str, npt.NDArray[np.uint8]] = {}
        self._n_taken = 0

    @property
    def snapshots(self) -> tuple[Snapshot, ...]:
        """One a phase, in the order in which they were first reached."""
        return tuple(
            Snapshot(camera=f"{PREFIX} {i} {name}", pixels=pixels, truth=None, estimate=None)
            for i, (name, pixels) in enumerate(self._taken.items(), 1)
        )

    def look(self, measures: Sequence[TriggeredMeasure]) -> None:
        """Take an image if a phase has ended."""
        for triggered in measures:
            name = triggered.measure.moment
            if name is None:
                continue
            if name != self._now:
                self._take(triggered.measure)
                self._now = name
            return

    def end(self, measures: Sequence[TriggeredMeasure]) -> None:
        """Take an image of the last phase."""
        for triggered in measures:
            if triggered.measure.moment is not None:
                self._take(triggered.measure)
                return

    def _take(self, measure: Measure) -> None:
        watched = measure.watched
        if self._now is None or watched is None or self._n_taken >= MAX_IMAGES:
            return
        self._n_taken += 1
        self._taken[self._now] = self._image(*watched)

    def _image(self, vehicle: Body, watched: Body) -> npt.NDArray[np.uint8]:
        """What an observer sees, the camera's last image in a corner, (h, w, 3)."""
        pose = observer(vehicle.world_from_body, watched.world_from_body.position)
        lens = Intrinsics.from_fovy(*SIZE, float(FIELD))
        scenery = self._simulation.world.scenery
        rendered = scenery.render_view(pose, lens, targets=frozenset({"colour"}))
        assert rendered.colour is not None
        pixels = np.ascontiguousarray(rendered.colour.view(np.uint8)[..., :3])
        for images in self._simulation.world.images.values():
            if images.last_pixels is not None:
                return with_inset(pixels, images.last_pixels)
        return pixels


def all_snapshots(
    simulation: Simulation,
    measures: Sequence[TriggeredMeasure],
    moments: Moments | None,
    *,
    is_tracking: bool,
) -> tuple[Snapshot, ...]:
    """The cameras' last images, and those of the phases if any were taken."""
    pairs = [(triggered.spec, triggered.measure) for triggered in measures]
    last = capture(simulation, pairs, is_tracking=is_tracking)
    return last if moments is None else (*last, *moments.snapshots)


def observer(world_from_vehicle: Pose, at: Array) -> Pose:
    """Where the observer of a vehicle is who looks at a point in W, (3,) [m]; OpenGL axes."""
    ahead = world_from_vehicle.rotation[:, 0] * [1.0, 1.0, 0.0]
    if length(ahead) < 1e-3:
        ahead = np.array([1.0, 0.0, 0.0])
    ahead = ahead / length(ahead)
    up = np.array([0.0, 0.0, 1.0])
    starboard = np.cross(ahead, up)
    away = FROM[0] * ahead + FROM[1] * starboard + FROM[2] * up
    away = away / length(away)
    return Pose(at + DISTANCE * away, camera_axes(-away, up))


def with_inset(
    pixels: npt.NDArray[np.uint8], image: npt.NDArray[np.uint8]
) -> npt.NDArray[np.uint8]:
    """Put an image into the upper left corner of another, with a white line around it."""
    colour = np.repeat(image[..., None], 3, axis=2) if image.ndim == 2 else image[..., :3]
    height = round(INSET * pixels.shape[0])
    width = round(height * colour.shape[1] / colour.shape[0])
    rows = np.arange(height) * colour.shape[0] // height
    columns = np.arange(width) * colour.shape[1] // width
    small = colour[rows[:, None], columns[None, :]]
    found = pixels.copy()
    found[4 : 8 + height, 4 : 8 + width] = 255
    found[6 : 6 + height, 6 : 6 + width] = small
    return found
