"""The recorded values of a scene as one row of numbers: poses, water, thrusters, lamps."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..base.geometry import Array
from ..devices.lamp import MountedLamp
from ..results.motion import Signal
from .live_scene import LiveScene
from .scenery.recorded_water import measure_water
from .tracked_bodies import TrackedBodies, vehicle_labels

LAMP_PREFIX = "lamp/"
"""The prefix of the name of a lamp's signal, which is its brightness [0..1]."""
BRIGHTNESS_RESOLUTION = 0.01
"""The resolution at which a brightness is recorded [1]."""

BEAM_ATTENUATION, EXPOSURE_LEVEL = "beam_attenuation", "exposure_level"
"""The names of the signals of physical water: the beam attenuation of green, and the exposure as a
binary logarithm."""
DRIFT_SIGNALS = {"particles": "m", "particle_velocity": "m/s"}
"""The names and units of the signals of the water's displacement that carries particles, in W."""
WAVE_SCALE = "wave_scale"
"""The name of the signal of the factor on the amplitudes of waves, where images show them [1]."""
WAVE_RESOLUTION = 1e-4
"""The resolution at which that factor is recorded [1]."""
EXPOSURE_RESOLUTION = 1e-3
"""The resolution at which an exposure is recorded [stops]."""


class TrackedState:
    """The source of the rows of a motion track and of a live view."""

    def __init__(self, world: LiveScene) -> None:
        self._world = world
        self._bodies = TrackedBodies(world)
        self._lamps = [device for device in world.devices if isinstance(device, MountedLamp)]
        self._last_quaternions: Array | None = None  # quaternions of the last row
        self.bodies = self._bodies.names
        """The names of the bodies."""
        self.signals = tuple(self._signals())
        """The signals, whose values follow the poses of the bodies in a row."""

    def row(self) -> Array:
        """Return the present row, (7 n bodies + m signals,).

        The sign of a quaternion does not jump from row to row.
        """
        rows = self._bodies.rows()
        if (
            self._last_quaternions is not None
        ):  # the nearer one of the two quaternions of a rotation
            rows[(rows[:, 3:] * self._last_quaternions).sum(axis=1) < 0.0, 3:] *= -1.0
        self._last_quaternions = rows[:, 3:].copy()
        scenery, engine = self._world.scenery, self._world.engine
        signals = [scenery.state.water.fog, scenery.state.light.rate]
        for index, vehicle in enumerate(self._world.vehicles.names):
            signals += self._water_velocity(engine.poses.vehicle(index).position, vehicle).tolist()
            if index in engine.actuation:
                signals += engine.actuation[index].commands().tolist()
        signals += [lamp.state.brightness for lamp in self._lamps]
        signals += measure_water(scenery.state.water)
        if self._world.scenery.particles is not None:
            drift = self._world.scenery.particles.find_drift()
            signals += [*drift.displacement, *drift.velocity]
        if self._shows_waves:
            signals.append(float(self._world.water.state.wave_scale[0]))
        return np.concatenate([rows.reshape(-1), signals])

    @property
    def _shows_waves(self) -> bool:
        water = self._world.scenery.state.water.physical_water
        return water is not None and self._world.water.waves is not None

    def _water_velocity(self, position: Array, vehicle: str) -> Array:
        """Return the velocity of the water at the position of a vehicle, in W, (3,) [m/s]."""
        if self._world.water.is_still:
            return np.zeros(3)
        velocity: Array = self._world.water.velocity(position[None], self._world.time, vehicle)[0]
        return velocity

    def _signals(self) -> Iterator[Signal]:
        yield Signal(name="fog", unit="1/m")
        yield Signal(name="light_rate")
        for index, vehicle in enumerate(vehicle_labels(self._world)):
            for axis in "xyz":
                yield Signal(name=f"water/{vehicle}/{axis}", unit="m/s", step=1e-3)
            if index in self._world.engine.actuation:
                for thruster in self._world.engine.actuation[index].thrusters:
                    yield Signal(name=f"thrust/{vehicle}/{thruster}", step=0.01)
        for lamp in self._lamps:
            yield Signal(name=f"{LAMP_PREFIX}{lamp.spec.name}", step=BRIGHTNESS_RESOLUTION)
        if self._world.scenery.state.water.physical_water is not None:
            yield Signal(name=BEAM_ATTENUATION, unit="1/m")
            yield Signal(name=EXPOSURE_LEVEL, step=EXPOSURE_RESOLUTION)
        if self._world.scenery.particles is not None:
            for name, unit in DRIFT_SIGNALS.items():
                yield from (Signal(name=f"{name}/{axis}", unit=unit) for axis in "xyz")
        if self._shows_waves:
            yield Signal(name=WAVE_SCALE, step=WAVE_RESOLUTION)
