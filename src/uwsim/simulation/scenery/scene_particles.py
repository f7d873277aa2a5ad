"""The particles of a running scene: their displacement, and what a camera sees of them.

The water carries them with the velocity of currents and waves at the first vehicle, everywhere
alike: the displacement is one vector in the state. It is integrated with the velocity that is
measured `UPDATE_RATE` times a second of simulation time.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ...base.geometry import Array, Intrinsics, Pose
from ...base.record import Record
from ...cameras.exposure import Displacement
from ...model.scene_model import SceneModel
from ...particles import (
    PARTICLE,
    Drift,
    ParticlesSpec,
    SizeClass,
    View,
    find_particles,
    find_plume,
)
from ...particles.puffs import PuffsState
from ...rendering.physical.visible_particles import VisibleParticles
from .scene_sediment import SceneSediment

UPDATE_RATE = 20.0
"""The rate at which the velocity of the water is measured [Hz]."""


@dataclass(slots=True)
class ParticlesState(Record):
    """The state of the particles of a scene."""

    displacement: Array
    """The displacement of the water in W up to the last measurement, (3,) [m]."""
    velocity: Array
    """The velocity of the water at the last measurement in W, (3,) [m/s]."""
    time: float = 0.0
    """The time of the last measurement [s]."""
    sediment: PuffsState | None = None
    """The clouds of sediment; None in scenes without any."""


class SceneParticles:
    """The particles of a scene, if it has physical water with particles.

    Args:
        model: the compiled scene.
        spec: the ``<u:particles>`` element.
        stream: returns the random generator of a stream's name.
        clock: returns the simulation time [s].
    """

    def __init__(
        self,
        model: SceneModel,
        spec: ParticlesSpec,
        stream: Callable[[str], np.random.Generator],
        clock: Callable[[], float],
    ) -> None:
        self.spec = spec
        """The element of the scene file."""
        self._clock = clock
        self._surface_height = model.scene.ocean_state.ocean_surface_height
        self.classes: list[SizeClass] = []
        """The classes of particles that are everywhere."""
        self.plume_classes: list[SizeClass] = []
        """The classes of bubbles that rise from the source."""
        self.source: Array | None = None
        """The place of the source in W, (3,) [m]; None without one."""
        if spec.marine_snow is not None:
            self.classes += spec.marine_snow.divide(_draw_keys(stream("scene/marine_snow")))
        if spec.bubbles is not None:
            classes = spec.bubbles.divide(_draw_keys(stream("scene/bubbles")))
            if spec.bubbles.source is None:
                self.classes += classes
            else:
                self.plume_classes += classes
                place = np.array([spec.bubbles.source])
                self.source = model.scene.world_from_localized.transform(place)[0]
        self.sediment: SceneSediment | None = None
        """The clouds of sediment; None in scenes without any."""
        if spec.sediment is not None:
            key = _draw_keys(stream("scene/sediment"))()
            self.sediment = SceneSediment(model, spec.sediment, key)
        self.state = ParticlesState(
            np.zeros(3),
            np.zeros(3),
            sediment=None if self.sediment is None else self.sediment.puffs.state,
        )
        """The state: the displacement of the water, and the clouds of sediment."""

    def set_clock(self, clock: Callable[[], float]) -> None:
        """Set the function that returns the time [s], as that of a recording."""
        self._clock = clock

    def measure_water(self, velocity: Array) -> None:
        """Take the velocity of the water in W, (3,) [m/s], from now on."""
        state = self.state
        time = self._clock()
        state.displacement += state.velocity * (time - state.time)
        state.velocity[:] = velocity
        state.time = time

    def find_drift(self, delay: float = 0.0) -> Drift:
        """Return the displacement of the water after a delay from the present time [s]."""
        state, time = self.state, self._clock() + delay
        displacement = state.displacement + state.velocity * (time - state.time)
        return Drift(
            displacement=_make_triple(displacement),
            velocity=_make_triple(state.velocity),
            time=time,
        )

    def find_visible(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        displacement: Displacement | None = None,
    ) -> VisibleParticles | None:
        """Return the particles and clouds in the view of a camera; None without any.

        Args:
            world_from_camera: the pose of the camera; OpenGL axes.
            intrinsics: the pinhole of the camera.
            displacement: the motion to this pose in an exposure of several images. Particles then
                streak from one image to the next; else over the exposure time of the element.
        """
        spec, state, time = self.spec, self.state, self._clock()
        clouds = None
        if self.sediment is not None:
            clouds = self.sediment.find_visible(world_from_camera, time, state.velocity)
        if clouds is None and not (self.classes or self.plume_classes):
            return None
        drift = self.find_drift(0.0 if displacement is None else displacement.time)
        view = View(
            world_from_camera=world_from_camera,
            intrinsics=intrinsics,
            surface_height=self._surface_height,
            max_range=spec.range,
            exposure_time=spec.exposure_time,
        )
        if displacement is not None:
            view = replace(
                view,
                exposure_time=displacement.duration,
                velocity=_make_triple(displacement.velocity),
                angular_velocity=_make_triple(displacement.angular_velocity),
            )
        parts = [find_particles(size_class, view, drift) for size_class in self.classes]
        if self.source is not None:
            parts += [find_plume(c, self.source, view, drift) for c in self.plume_classes]
        return VisibleParticles(
            records=np.concatenate([np.zeros(0, PARTICLE), *parts]),
            aperture=spec.aperture,
            focus_distance=spec.focus_distance,
            clouds=clouds,
        )


def make_particles(
    model: SceneModel, stream: Callable[[str], np.random.Generator], clock: Callable[[], float]
) -> SceneParticles | None:
    """Return the particles of a scene; None if it has none."""
    water = model.scene.ocean_state.water
    if water is None or water.particles is None:
        return None
    return SceneParticles(model, water.particles, stream, clock)


def _draw_keys(rng: np.random.Generator) -> Callable[[], int]:
    return lambda: int(rng.integers(2**63))


def _make_triple(vector: Array) -> tuple[float, float, float]:
    x, y, z = vector.tolist()
    return x, y, z
