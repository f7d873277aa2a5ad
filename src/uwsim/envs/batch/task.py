"""The task of rows of free vehicles: what they observe, what is rewarded, when an episode ends."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from ...base.geometry import Array
from ...errors import BadSetting, UnknownName
from ...physics.hydrodynamics.kernel.free_step import FreeVehicle
from . import columns as c
from .arrays import TaskNumbers

MAX_CHANNELS = 64
"""The greatest number of channels, and of terms."""


@dataclass(frozen=True, kw_only=True)
class Channel:
    """Some numbers of an observation."""

    name: str
    """A name of `columns.CHANNELS`."""
    frame: str = "base"
    """The axes of a vector: ``base`` or ``world``."""
    lead_time: float = 0.0
    """The time ahead of the goal [s]."""


@dataclass(frozen=True, kw_only=True)
class Term:
    """A term of the reward."""

    name: str
    """A name of `columns.TERMS`."""
    weight: float = 1.0
    """The factor of its value."""
    scale: float = 1.0
    """The divisor of its value [m, rad or m/s]."""


@dataclass(frozen=True, kw_only=True)
class Trajectory:
    """The goal as a function of time; see `trajectories`."""

    kind: str = "hold"
    """A name of `columns.TRAJECTORIES`."""
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The point to hold, or the centre, in W [m]."""
    heading: float = 0.0
    """The heading in W [rad]."""
    phase: float = 0.0
    """The phase at the beginning [rad]."""
    radius: float = 1.0
    """The radius [m]."""
    period: float = 30.0
    """The time of a round [s]."""
    climb: float = 0.0
    """The speed upwards of a helix [m/s]."""
    faces_along: bool = False
    """True if the goal's heading is that of its motion."""
    level: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)
    """The attitude in W of a level base with the heading 0, wxyz."""


@dataclass(frozen=True, kw_only=True)
class RowTask:
    """A task of rows."""

    channels: tuple[Channel, ...]
    """The channels of the observation, in order."""
    terms: tuple[Term, ...]
    """The terms of the reward."""
    trajectory: Trajectory = field(default_factory=Trajectory)
    """The goal."""
    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """The ranges of parameters of `columns.PARAMETERS`; others are nominal."""
    timestep: float = 0.01
    """The length of a physics step [s]."""
    substeps: int = 5
    """The number of physics steps in a step of the environment."""
    max_steps: int = 400
    """The number of steps after which an episode is truncated."""
    exit_distance: float = 5.0
    """The distance from the goal at which an episode ends [m]."""
    tolerance: float = 0.1
    """The distance from the goal within which a row is at the goal [m]."""
    hold_steps: int = 40
    """The number of successive steps at the goal after which a row succeeds."""
    ends_on_success: bool = False
    """True if an episode ends when its row succeeds."""

    def bind(self, vehicle: FreeVehicle, mixing: Array | None = None) -> TaskNumbers:
        """Return the numbers of the task for a vehicle.

        Args:
            vehicle: the numbers of the vehicle.
            mixing: the commands of the actuators per action, (k, a); None: an action for each
                actuator.

        Raises:
            UnknownName: there is no such channel, term, trajectory or parameter.
            BadSetting: a number is out of its range.
        """
        n_actuators = len(vehicle.actuators)
        commands = np.eye(n_actuators) if mixing is None else np.array(mixing, dtype=np.float64)
        if commands.ndim != 2 or len(commands) != n_actuators:
            raise BadSetting(
                f"The mixing matrix has the shape {commands.shape}; expected ({n_actuators}, a)."
            )
        self._check()
        return TaskNumbers(
            channels=self._bind_channels(commands.shape[1], n_actuators),
            terms=self._bind_terms(),
            trajectory=self._bind_trajectory(),
            origin=np.array(
                [*self.trajectory.centre, self.trajectory.heading, self.trajectory.phase]
            ),
            ranges=self._bind_ranges(),
            mixing=np.ascontiguousarray(commands),
            timestep=float(self.timestep),
            substeps=int(self.substeps),
            max_steps=int(self.max_steps),
            exit_distance=float(self.exit_distance),
            tolerance=float(self.tolerance),
            hold_steps=int(self.hold_steps),
            ends_on_success=bool(self.ends_on_success),
        )

    def n_observations(self, n_actions: int, n_actuators: int) -> int:
        """Return the number of numbers of an observation."""
        return sum(_width(channel.name, n_actions, n_actuators) for channel in self.channels)

    def _check(self) -> None:
        for name, value, minimum in (
            ("timestep", self.timestep, 1e-6),
            ("substeps", self.substeps, 1),
            ("max_steps", self.max_steps, 1),
            ("hold_steps", self.hold_steps, 1),
            ("exit_distance", self.exit_distance, 0.0),
            ("tolerance", self.tolerance, 0.0),
        ):
            if not value >= minimum:
                raise BadSetting(f"The task has {name} {value}; expected at least {minimum}.")
        for name, values in (("channels", self.channels), ("terms", self.terms)):
            if not 1 <= len(values) <= MAX_CHANNELS:
                raise BadSetting(
                    f"The task has {len(values)} {name}; expected 1 to {MAX_CHANNELS}."
                )

    def _bind_channels(self, n_actions: int, n_actuators: int) -> Array:
        rows, offset = [], 0
        for channel in self.channels:
            width = _width(channel.name, n_actions, n_actuators)
            if channel.frame not in ("base", "world"):
                raise UnknownName("frame of a channel", channel.frame, ("base", "world"))
            axes = c.BASE if channel.frame == "base" else c.WORLD
            rows.append([c.CHANNELS[channel.name][0], axes, channel.lead_time, float(offset)])
            offset += width
        return np.array(rows)

    def _bind_terms(self) -> Array:
        rows = []
        for term in self.terms:
            if term.name not in c.TERMS:
                raise UnknownName("term of a reward", term.name, c.TERMS)
            if not term.scale > 0.0:
                raise BadSetting(
                    f"The term {term.name!r} has the scale {term.scale}; expected a positive one."
                )
            rows.append([c.TERMS[term.name], term.weight, term.scale])
        return np.array(rows)

    def _bind_trajectory(self) -> Array:
        path = self.trajectory
        if path.kind not in c.TRAJECTORIES:
            raise UnknownName("trajectory", path.kind, c.TRAJECTORIES)
        if not path.period > 0.0:
            raise BadSetting(f"The trajectory has the period {path.period}; expected more than 0.")
        rate = 2.0 * np.pi / path.period
        kind, turns = c.TRAJECTORIES[path.kind], float(path.faces_along)
        return np.array([kind, path.radius, rate, path.climb, turns, *path.level])

    def _bind_ranges(self) -> Array:
        ranges = np.array([[value, value] for value in c.PARAMETERS.values()])
        for name, (low, high) in self.ranges.items():
            if not low <= high:
                raise BadSetting(f"The range of {name!r} is {low} to {high}; expected low to high.")
            ranges[parameter_index(name)] = low, high
        return ranges


def parameter_index(name: str) -> int:
    """Return the column of a parameter.

    Raises:
        UnknownName: there is no such parameter.
    """
    if name not in c.PARAMETERS:
        raise UnknownName("parameter of an episode", name, c.PARAMETERS)
    return list(c.PARAMETERS).index(name)


def _width(name: str, n_actions: int, n_actuators: int) -> int:
    if name not in c.CHANNELS:
        raise UnknownName("channel of an observation", name, c.CHANNELS)
    code, width = c.CHANNELS[name]
    if width > 0:
        return width
    return n_actions if code == c.LAST_ACTION else n_actuators
