"""The readings of a live view: a vehicle's joints, forces and battery; the real-time factor."""

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

AVERAGING_TIME = 2.0
"""The wall time over which the real-time factor is computed [s]."""
Reading = tuple[str, str, float | None]
"""A reading: its name, unit, and value; None: there is no value."""


class Readings:
    """The readings of a vehicle; reading them does not change the simulation.

    Args:
        simulation: the simulation.
        vehicle: the index of the vehicle in the scene.
    """

    def __init__(self, simulation: Simulation, vehicle: int) -> None:
        world = simulation.world
        self._simulation, self._vehicle = simulation, None
        self._history: deque[tuple[float, float]] = deque()  # wall time and simulation time [s]
        self._sensors: list[tuple[str, Any]] = []
        if not world.vehicles:
            return
        self._vehicle = world.vehicles[vehicle]
        self._has_dynamics = world.engine.has_dynamics(self._vehicle.index)
        for element, part in world.model.scene.vehicles[vehicle].all_parts():
            if isinstance(part, ForceSensorSpec | BatterySpec):
                with suppress(UnknownName):  # the link of the sensor does not exist
                    self._sensors.append((part.name, world.sensors.sensor(part.name, (element,))))
        self._are_revolute = tuple(
            j.kind != "prismatic" for j in world.model.robots[vehicle].movable_joints
        )

    def read(self, wall: float, *, is_paused: bool = False) -> list[Reading]:
        """Return all readings at a wall time [s]."""
        factor = self._real_time_factor(wall, is_paused=is_paused)
        return [*self._vehicle_readings(), ("real-time factor", "1", factor)]

    def _vehicle_readings(self) -> Iterator[Reading]:
        vehicle, world = self._vehicle, self._simulation.world
        if vehicle is None:
            return
        positions = vehicle.joints.tolist()
        joints = zip(vehicle.joint_names, positions, self._are_revolute, strict=True)
        for name, position, is_revolute in joints:
            value = math.degrees(position) if is_revolute else position
            yield f"joint/{name}", "deg" if is_revolute else "m", value
        if self._has_dynamics:
            forces = world.contacts.forces(vehicle.name).values()
            yield "contact force", "N", math.fsum(math.hypot(*f.tolist()) for f in forces)
        for name, sensor in self._sensors:
            message = sensor.sample(world.time)
            if isinstance(message, WrenchStamped):
                force = message.wrench.force
                yield f"force/{name}", "N", math.hypot(force.x, force.y, force.z)
            elif isinstance(message, BatteryState):
                yield f"battery/{name}", "%", 100.0 * message.percentage

    def _real_time_factor(self, wall: float, *, is_paused: bool) -> float | None:
        """Return simulation time per wall time in `AVERAGING_TIME` [1]; None while paused."""
        history, now = self._history, self._simulation.time
        if is_paused:
            history.clear()
            return None
        history.append((wall, now))
        while len(history) > 2 and history[1][0] <= wall - AVERAGING_TIME:
            history.popleft()
        start_wall, start = history[0]
        return (now - start) / (wall - start_wall) if wall - start_wall > 0.25 else None
