"""The physical parts of a running scene, on which sensors and devices are bound."""

from __future__ import annotations

import numpy as np

from ..base import rng
from ..bus import Bus
from ..model.scene_model import SceneModel
from ..physics.engine import Engine
from ..rendering.physical.moving_surface import MovingSurface
from .bodies import SceneBodies
from .collision.below_ground import BelowGround
from .collision.contacts import Contacts
from .collision.start_depths import lift_from_ground
from .scenery.renderer_pool import RendererPool
from .scenery.scene_particles import UPDATE_RATE, make_particles
from .scenery.scene_rays import SceneRays
from .scenery.scene_sediment import UPDATE_RATE as SEDIMENT_RATE
from .scenery.scenery import Scenery
from .schedule import Schedule
from .vehicles import SceneVehicles
from .water.water_motion import water_motion


class PhysicalScene:
    """The engine, bodies, water, scenery, contacts, clock and topics of a running scene.

    `LiveScene` adds sensors, devices and interfaces to these parts.

    Args:
        model: the compiled scene.
        stream_prefix: the prefix of the names of random streams.
        runs_code: True to run the Python code to which the scene refers; False: a current that
            requires such code is zero.
        pool: the pool of renderers; None: the scene has a renderer of its own.
    """

    def __init__(
        self,
        model: SceneModel,
        *,
        stream_prefix: str,
        runs_code: bool,
        pool: RendererPool | None,
    ) -> None:
        self.model = model
        """The compiled scene, which does not change while the scene runs."""
        self._prefix = stream_prefix
        self.bus = Bus()
        """The topics and services."""
        self.schedule = Schedule(self.bus, model.timestep)
        """The timers, and the commands of the next step."""
        self.engine = engine = Engine(model)
        """The engine, which stores the poses and moves the bodies."""
        if model.dynamics or model.scene.has_original_physics:
            lift_from_ground(model, engine)
        self.below_ground = BelowGround(model, engine)
        """The check for bodies that have passed through the ground."""
        self.vehicles = SceneVehicles(model, engine, self.bus)
        """The vehicles, by their number in the file or by name."""
        self.particles = make_particles(model, self.stream, lambda: self.time)
        """The particles in the water; None without any."""
        self.scenery = Scenery(model, engine, pool, self.particles)
        """The rendering of the scene."""
        self.rays = SceneRays(model, engine, self.scenery.heaps)
        """The ray casting against the scene."""
        self.bodies = SceneBodies(model, engine)
        """The vehicles, links and objects, by name."""
        self.contacts = Contacts(model, engine)
        """The contacts between bodies."""
        self.water = water_motion(model, self.stream, runs_code=runs_code)
        """The motion of the water."""
        optics = self.scenery.state.water.physical_water
        if optics is not None and (self.water.waves is not None or optics.ripples is not None):
            self.scenery.set_surface(self._find_surface)
        if self.particles is not None:
            self.schedule.create_timer(UPDATE_RATE, self._move_particles)
            if self.particles.sediment is not None:
                self.schedule.create_timer(SEDIMENT_RATE, self._stir_sediment)

    @property
    def time(self) -> float:
        """The simulation time [s]."""
        return self.bus.state.step * self.model.timestep

    def _move_particles(self) -> None:
        vehicles, water = self.model.scene.vehicles, self.water
        assert self.particles is not None
        if not vehicles or water.is_still:
            self.particles.measure_water(np.zeros(3))
            return
        position = self.engine.poses.vehicle(0).position
        velocity = water.velocity(position[None, :], self.time, vehicles[0].name)[0]
        self.particles.measure_water(velocity)

    def _stir_sediment(self) -> None:
        assert self.particles is not None
        assert self.particles.sediment is not None
        velocity = self.particles.state.velocity
        self.particles.sediment.stir(self.engine, self.rays, self.time, velocity)

    def _find_surface(self) -> MovingSurface:
        return MovingSurface(
            time=self.time,
            waves=self.water.waves,
            wave_scale=float(self.water.state.wave_scale[0]),
            seed=self.model.seed,
        )

    def stream(self, name: str) -> np.random.Generator:
        """Return the random generator of a stream's name."""
        return rng.stream(self.model.seed, self._prefix + name)
