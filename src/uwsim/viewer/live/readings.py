"""The state of a vehicle in numbers that its pose does not tell: joints, forces, battery, pace."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

from ...devices.battery import BatterySpec
from ...devices.force_sensor import ForceSensorSpec
from ...errors import UnknownName
from ...messages import BatteryState, WrenchStamped
from ...simulation import Simulation

WINDOW = 2.0
"""Wall time over which the real-time factor is taken [s]."""
Reading = tuple[str, str, float | None]
"""Name, unit, and value; None: there is none now."""


class Readings:
    """What a page shows of a vehicle besides its motion; nothing in the simulation changes by it.

    Args:
        simulation: the one.
        vehicle: number of the vehicle in the scene.
    """

    def __init__(self, simulation: Simulation, vehicle: int) -> None:
        world = simulation.world
        self._simulation, self._vehicle = simulation, None
        self._past: deque[tuple[float, float]] = deque()  # wall time and simulation time [s]
        self._sensors: list[tuple[str, Any]] = []
        if not world.vehicles:
            return
        self._vehicle = world.vehicles.find(world.vehicles.names[vehicle])
        self._is_simulated = world.engine.is_simulated(self._vehicle.index)
        for element, part in world.model.scene.vehicles[vehicle].all_parts():
            if isinstance(part, ForceSensorSpec | BatterySpec):
                with suppress(UnknownName):  # one on a link that is not there is left out
                    self._sensors.append((part.name, world.sensors.sensor(part.name, (element,))))
        self._turns = tuple(j.kind != "prismatic" for j in world.model.robots[vehicle].movable)

    def take(self, wall: float, *, is_paused: bool = False) -> list[Reading]:
        """Return all of them at a wall time [s]."""
        readings = list(self._of_vehicle())
        readings.append(("real-time factor", "1", self._pace(wall, is_paused=is_paused)))
        return readings

    def _of_vehicle(self) -> Iterator[Reading]:
        vehicle, world = self._vehicle, self._simulation.world
        if vehicle is None:
            return
        joints = zip(vehicle.joint_names, vehicle.joints.tolist(), self._turns, strict=True)
        for name, value, turns in joints:
            yield f"joint/{name}", "deg" if turns else "m", math.degrees(value) if turns else value
        if self._is_simulated:
            forces = world.contacts.forces(vehicle.name).values()
            yield "contact force", "N", math.fsum(math.hypot(*f.tolist()) for f in forces)
        for name, sensor in self._sensors:
            message = sensor.sample(world.time)
            if isinstance(message, WrenchStamped):
                force = message.wrench.force
                yield f"force/{name}", "N", math.hypot(force.x, force.y, force.z)
            elif isinstance(message, BatteryState):
                yield f"battery/{name}", "%", 100.0 * message.percentage

    def _pace(self, wall: float, *, is_paused: bool) -> float | None:
        """Simulation time to wall time of the last seconds; None while it is paused."""
        past, now = self._past, self._simulation.time
        if is_paused:
            past.clear()
            return None
        past.append((wall, now))
        while len(past) > 2 and past[1][0] <= wall - WINDOW:
            past.popleft()
        began, then = past[0]
        return (now - then) / (wall - began) if wall - began > 0.25 else None
