"""One simulated vehicle that runs windows of a log."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array, Pose
from ..errors import BadSetting, SimulationFailed, UnknownName, choices
from ..logs import VehicleLog
from ..model.scene_model import SceneModel
from ..simulation import Simulation
from .log_motion import LogMotion
from .vehicle_commands import VehicleCommands

MAX_GROUND_DEPTH = 0.3
"""The depth below a ground up to which a log counts as above it: its navigation drifts [m]."""
FORMATS_WITHOUT_NAMES = ("csv", "bin", "tlog")
"""The formats of logs without the name of a vehicle."""


@dataclass(frozen=True, kw_only=True, eq=False)
class SimulatedMotion:
    """The simulated motion of a window."""

    positions: Array
    """The positions in L, (n, 3) [m]."""
    quaternions: Array
    """The orientations ``localized_from_base``, wxyz, (n, 4)."""
    twists: Array
    """The twists over ground in base axes, (n, 6) [m/s, rad/s]."""


class VehicleRun:
    """A simulation whose vehicle starts at states of a log, with the log's commands.

    Each window starts from the beginning of the simulation, at its time 0: a wave or a current that
    changes with time does not have the phase that it had during the log.

    Args:
        simulation: the simulation.
        vehicle: the name of the vehicle.
        motion: the motion of the log.
        commands: the commands of the log.
    """

    def __init__(
        self, simulation: Simulation, vehicle: str, motion: LogMotion, commands: VehicleCommands
    ) -> None:
        self.simulation, self.motion, self.commands = simulation, motion, commands
        """The simulation, and the motion and the commands of the log."""
        self.vehicle = simulation.world.vehicles.find(vehicle)
        """The vehicle."""
        self._world_from_localized = simulation.world.model.scene.world_from_localized
        self._localized_from_world = self._world_from_localized.inverse()
        self._is_planar = motion.is_planar
        simulation.advance(0.0)
        self._initial_state = simulation.state.copy()

    def begin(self, start: float) -> None:
        """Set the vehicle to the log's pose, twist, commands and actuators at a time [s]."""
        simulation, time = self.simulation, np.array([start])
        simulation.restore(self._initial_state)
        pose = Pose.from_quaternion(
            self.motion.positions(time)[0], self.motion.quaternions(time)[0]
        )
        simulation.world.engine.place_vehicle(
            self.vehicle.index, self._world_from_localized @ pose, self.motion.twists(time)[0]
        )
        self.commands.apply(self.vehicle, start)
        self.commands.set_actuators(simulation, self.vehicle, start)

    def run(self, start: float, offsets: Sequence[float]) -> SimulatedMotion:
        """Simulate a window; return the motion at some times after its beginning, ascending [s].

        A command takes effect at the first step at or after its time.

        Raises:
            SimulationFailed: the vehicle meets the ground, or its motion is impossible.
        """
        try:
            return self._simulate(start, offsets)
        except SimulationFailed as error:
            raise SimulationFailed(
                f"The window at {start:.2f} s of the log failed. {error}\nIf the log has another "
                "origin than the scene, set origin in [frames] of a mapping file. --open-water "
                "leaves out floor and walls."
            ) from None

    def _simulate(self, start: float, offsets: Sequence[float]) -> SimulatedMotion:
        self.begin(start)
        simulation, timestep = self.simulation, self.simulation.timestep
        changes = self.commands.change_times(start, start + offsets[-1])
        events = [(math.ceil((t - start) / timestep - 1e-6), 0, t) for t in changes]
        events += [(round(offset / timestep), 1, start + offset) for offset in offsets]
        first_step = simulation.step
        rows: list[Array] = []
        for step, kind, time in sorted(events):
            n_steps = first_step + int(step) - simulation.step
            if n_steps > 0:
                self._advance(n_steps, start)
            if kind == 0:
                self.commands.apply(self.vehicle, time)
            else:
                rows.append(self._read_state())
        table = np.array(rows)
        return SimulatedMotion(
            positions=table[:, :3], quaternions=table[:, 3:7], twists=table[:, 7:]
        )

    def _advance(self, n_steps: int, start: float) -> None:
        """Simulate steps; a planar motion keeps the depth of the log, and no roll or pitch."""
        timestep = self.simulation.timestep
        if not self._is_planar:
            self.simulation.advance(n_steps * timestep)
            return
        depth = float(self.motion.positions(np.array([start]))[0, 2])
        for _ in range(n_steps):
            self.simulation.advance(timestep)
            state = self._read_state()
            norm = math.hypot(state[3], state[6]) or 1.0
            heading = np.array([state[3] / norm, 0.0, 0.0, state[6] / norm])
            pose = Pose.from_quaternion(np.array([state[0], state[1], depth]), heading)
            twist = state[7:] * np.array([1.0, 1.0, 0.0, 0.0, 0.0, 1.0])
            self.simulation.world.engine.place_vehicle(
                self.vehicle.index, self._world_from_localized @ pose, twist, stops_actuators=False
            )

    def _read_state(self) -> Array:
        pose = self._localized_from_world @ self.vehicle.world_from_base
        return np.concatenate([pose.position, pose.quaternion, self.vehicle.velocity])


def check_ground(model: SceneModel, motion: LogMotion, starts: Array) -> None:
    """Raise BadSetting if the log begins a window below a ground of the scene.

    Args:
        model: the scene.
        motion: the motion of the log.
        starts: the times at which windows begin, (n,) [s].
    """
    positions = motion.positions(starts)
    points = model.scene.world_from_localized.transform(positions)
    for ground in model.grounds:
        depths = [ground.depth(point[None]) for point in points]
        is_below = [depth > MAX_GROUND_DEPTH for depth in depths]
        if any(is_below):
            index = is_below.index(True)
            raise BadSetting(
                f"The log is below {ground.name!r} of the scene: at {starts[index]:.2f} s, at "
                f"z = {positions[index, 2]:.3g} m of L, by {depths[index]:.3g} m "
                f"({sum(is_below)} of {len(starts)} windows). The log has another origin or place "
                "than the scene. Set origin in [frames] of a mapping file, or use --open-water, "
                "which leaves out floor and walls."
            )


def choose_vehicle(model: SceneModel, log: VehicleLog, name: str | None) -> int:
    """Return the index of the vehicle: that of a name, of the mapping file, or the only one.

    A recording has the names of its topics; the mapping of another log names the scene's vehicle.

    Raises:
        UnknownName: there is no such vehicle.
        BadSetting: it has no dynamics, or several have.
    """
    names = [vehicle.name for vehicle in model.scene.vehicles]
    is_named = bool(log.vehicle_place) and log.format in FORMATS_WITHOUT_NAMES
    if name is None and is_named:
        if log.vehicle not in names:
            raise BadSetting(
                f"{log.vehicle_place}: the scene has no vehicle {log.vehicle!r}."
                f"{choices(log.vehicle, names)}"
            )
        name = log.vehicle
    return find_vehicle(model, name)


def find_vehicle(model: SceneModel, name: str | None) -> int:
    """Return the index of the vehicle to simulate, which has dynamics.

    Args:
        model: the scene.
        name: the name of the vehicle; None: the only one with dynamics.

    Raises:
        UnknownName: there is no such vehicle.
        BadSetting: it has no dynamics, or several have.
    """
    names = [vehicle.name for vehicle in model.scene.vehicles]
    if name is not None:
        if name not in names:
            raise UnknownName("vehicle", name, names)
        index = names.index(name)
        if index not in model.dynamics:
            raise BadSetting(f"The vehicle {name!r} is kinematic; expected one with <u:dynamics>.")
        return index
    if len(model.dynamics) != 1:
        dynamic_names = [names[index] for index in model.dynamics]
        raise BadSetting(
            f"The scene has {len(dynamic_names)} vehicles with <u:dynamics>"
            f"{': ' if dynamic_names else ''}{', '.join(dynamic_names)}; choose by --vehicle."
        )
    return next(iter(model.dynamics))
