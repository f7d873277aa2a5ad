"""What of a scene may change, as one row of numbers: poses of bodies, water, thrusters, lamps."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..base.geometry import Array
from ..devices.lamp import MountedLamp
from ..results.motion import Signal
from .live_scene import LiveScene
from .tracked_bodies import TrackedBodies, vehicle_labels

LAMP = "lamp/"
"""How the name of a lamp's signal begins, its brightness [0..1]."""
BRIGHTNESS = 0.01
"""Its resolution."""


class TrackedState:
    """The rows of a motion track, and of a live view.

    Args:
        world: the scene.
    """

    def __init__(self, world: LiveScene) -> None:
        self._world = world
        self._bodies = TrackedBodies(world)
        self._lamps = [one for one in world.devices if isinstance(one, MountedLamp)]
        self._before: Array | None = None  # quaternions of the last row
        self.bodies = self._bodies.names
        """Names of the bodies."""
        self.signals = tuple(self._signals())
        """What follows the seven numbers of each body."""

    def row(self) -> Array:
        """Return the present row, (7 bodies + signals,); quaternions keep their sign."""
        rows = self._bodies.rows()
        if self._before is not None:  # of the two quaternions of a rotation the nearer one
            rows[(rows[:, 3:] * self._before).sum(axis=1) < 0.0, 3:] *= -1.0
        self._before = rows[:, 3:].copy()
        scenery, engine = self._world.scenery, self._world.engine
        signals = [scenery.state.water.fog, scenery.state.light.rate]
        for index, vehicle in enumerate(self._world.vehicles.names):
            signals += self._water_at(engine.poses.vehicle(index).position, vehicle).tolist()
            if index in engine.actuation:
                signals += engine.actuation[index].commands().tolist()
        signals += [lamp.state.brightness for lamp in self._lamps]
        return np.concatenate([rows.reshape(-1), signals])

    def _water_at(self, place: Array, vehicle: str) -> Array:
        """Velocity of the water at a vehicle in W, (3,) [m/s]."""
        if self._world.water.is_still:
            return np.zeros(3)
        velocity: Array = self._world.water.velocity(place[None], self._world.time, vehicle)[0]
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
            yield Signal(name=f"{LAMP}{lamp.spec.name}", step=BRIGHTNESS)
