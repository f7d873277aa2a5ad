r"""The commands of a log, applied to a vehicle of the simulation.

At the beginning of a window the rotors have the state that the commands before it leave. With the
lag :math:`T` of a thruster and commands :math:`u_i` that hold from :math:`t_i`, it is

.. math:: s(t_0) = s_1 + \sum_i (u_i - s_i)\,(1 - e^{-(t_{i+1} - t_i)/T}), \qquad s_1 = u_1

Fins begin at their last command, without the lag and the speed limit of their servo.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from ..base.geometry import Array
from ..errors import BadSetting, did_you_mean
from ..logs import CommandSeries, VehicleLog
from ..simulation import Simulation
from ..simulation.vehicles import SceneVehicle
from ..vehicle import Autopilot

WARM_UP_LAGS = 12.0
"""The time before a window whose commands are considered, in lags of the slowest thruster."""
PREFERENCE = ("thrusters", "wrench", "twist")
"""The kinds of commands of which one is used, preferred first."""
MAX_LISTED = 4


class VehicleCommands:
    """The commands of a log for a vehicle, in the order of its thrusters and fins.

    Args:
        log: the log.
        vehicle: the vehicle of the simulation.
        time_constants: the lag of each thruster, (n,) [s].

    Raises:
        BadSetting: the log has no commands, or their names do not fit the vehicle.
    """

    def __init__(self, log: VehicleLog, vehicle: SceneVehicle, time_constants: Sequence[float]):
        self._time_constants = time_constants
        series = {part.kind: part for part in log.commands if len(part.times)}
        main = next((series[kind] for kind in PREFERENCE if kind in series), None)
        fins = series.get("fins")
        if main is None and fins is None:
            raise BadSetting(
                f"{log.path} has no commands of a vehicle. Name their columns or topics in a "
                "mapping file ([commands.thrusters] or [topics])."
            )
        self.kinds = tuple(part.kind for part in (main, fins) if part is not None)
        """The kinds of commands that are applied."""
        names = {"thrusters": vehicle.thrusters, "fins": vehicle.fins}
        self._series = [
            (part, _sort_columns(part, names[part.kind]) if part.kind in names else part.values)
            for part in (main, fins)
            if part is not None
        ]
        self._times = np.unique(np.concatenate([part.times for part, _ in self._series]))

    @property
    def start(self) -> float:
        """The first time at which the commands before it determine the rotors [s]."""
        warm_up = WARM_UP_LAGS * max(self._time_constants, default=0.0)
        return max(float(part.times[0]) for part, _ in self._series) + warm_up

    @property
    def end(self) -> float:
        """The time of the last command [s]."""
        return max(float(part.times[-1]) for part, _ in self._series)

    def change_times(self, start: float, end: float) -> list[float]:
        """Return the times of commands in an interval, ascending [s]."""
        first_index, end_index = np.searchsorted(self._times, [start, end])
        return [time for time in self._times[first_index:end_index].tolist() if time > start]

    def apply(self, vehicle: SceneVehicle, time: float) -> None:
        """Apply the commands that are in effect at a time [s]."""
        for part, values in self._series:
            index = int(np.searchsorted(part.times, time + 1e-9, side="right")) - 1
            _APPLY[part.kind](vehicle, values[max(index, 0)])

    def set_actuators(self, simulation: Simulation, vehicle: SceneVehicle, time: float) -> None:
        """Set rotors and fins to the state that the commands before a time leave."""
        actuation = simulation.world.engine.actuation[vehicle.index]
        for part, values in self._series:
            if part.kind == "thrusters":
                actuation.set_rotors(self._rotor_speeds(part, values, time))

    def _rotor_speeds(self, series: CommandSeries, values: Array, time: float) -> Array:
        lag = max(self._time_constants, default=0.0)
        first, n_commands = np.searchsorted(series.times, [time - WARM_UP_LAGS * lag, time])
        first = max(int(first) - 1, 0)
        speeds = [min(max(speed, -1.0), 1.0) for speed in values[first].tolist()]
        for index in range(first, max(int(n_commands), first + 1)):
            is_last = index + 1 >= int(n_commands)
            end = time if is_last else float(series.times[index + 1])
            duration = max(0.0, end - float(series.times[index]))
            for thruster, constant in enumerate(self._time_constants):
                share = 1.0 - math.exp(-duration / constant) if constant > 0.0 else 1.0
                target = min(max(float(values[index, thruster]), -1.0), 1.0)
                speeds[thruster] += share * (target - speeds[thruster])
        return np.array(speeds)


def shift_commands(log: VehicleLog, shift: float) -> VehicleLog:
    """Return a log whose commands take effect later by a time, or earlier if it is negative [s]."""
    if shift == 0.0:
        return log
    commands = tuple(replace(part, times=part.times + shift) for part in log.commands)
    return replace(log, commands=commands)


def _apply_thrusters(vehicle: SceneVehicle, values: Array) -> None:
    _autopilot(vehicle).set_thrusters(values)


def _apply_wrench(vehicle: SceneVehicle, values: Array) -> None:
    _autopilot(vehicle).set_wrench(values[:3], values[3:])


def _apply_twist(vehicle: SceneVehicle, values: Array) -> None:
    _autopilot(vehicle).set_twist(values[:3].tolist(), values[3:].tolist())


def _apply_fins(vehicle: SceneVehicle, values: Array) -> None:
    vehicle.turn_fins(values)


_APPLY: dict[str, Callable[[SceneVehicle, Array], None]] = {
    "thrusters": _apply_thrusters,
    "wrench": _apply_wrench,
    "twist": _apply_twist,
    "fins": _apply_fins,
}


def _autopilot(vehicle: SceneVehicle) -> Autopilot:
    if vehicle.autopilot is None:
        raise BadSetting(f"The vehicle {vehicle.name!r} is kinematic; it has no commands.")
    return vehicle.autopilot


def _sort_columns(series: CommandSeries, names: tuple[str, ...]) -> Array:
    """Return the commands in the order of the vehicle's names."""
    series = series.name_in_order(names)
    if set(series.names) == set(names):
        return series.values[:, [series.names.index(name) for name in names]]
    n_log, n_vehicle = len(series.names), len(names)
    if n_log != n_vehicle:
        raise BadSetting(
            f"The log has commands for {n_log} {series.kind}"
            f"{f' ({series.source})' if series.source else ''}, the vehicle has {n_vehicle}: "
            f"{', '.join(names) or 'none'}. Name them in [commands.{series.kind}] of a mapping "
            "file."
        )
    unknown_names = [name for name in series.names if name not in names]
    names_text = ", ".join(map(repr, unknown_names[:MAX_LISTED]))
    raise BadSetting(
        f"The log has {series.kind} that the vehicle lacks: {names_text}."
        f"{did_you_mean(unknown_names[0], names)} Known: {', '.join(names)}"
    )
