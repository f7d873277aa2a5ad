"""The interface of currents: a velocity of the water at a point and a time."""

from __future__ import annotations

import abc
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..base.geometry import Array, Pose
from ..base.numerics.linear import product
from ..schema import Spec
from ..world import Flow
from .flow_function import FlowFunction

MAX_SPEED = 100.0
"""The largest speed in a file or of a function [m/s]. Turbidity currents and tsunamis reach some
30 m/s; a greater speed is most probably an error of units."""
HALF_SPAN = 1e-3
"""The half span of the central difference that gives the acceleration [s]."""


@dataclass(frozen=True, kw_only=True)
class Place:
    """The properties of a scene that a current may need."""

    stream: Callable[[str], np.random.Generator]
    """The random generator of a name."""
    find: Callable[[str], Path] = Path
    """The function that finds a file which the scene names."""
    world_from_localized: Pose = field(default_factory=Pose.identity)
    """W from L."""
    runs_code: bool = True
    """True if Python code that the scene names may run; without it, that water is still."""
    surface_height: float = 0.0
    """The height of the still water in W [m]."""

    def depths(self, points: Array) -> Array:
        """Return the depths of points of L below the still surface, (n,) [m]; negative above it."""
        pose = self.world_from_localized
        depths: Array = self.surface_height - (product(points, pose.rotation[2]) + pose.position[2])
        return depths


@dataclass(frozen=True, kw_only=True)
class CurrentSpec(Spec, abc.ABC):
    """The spec of a current."""

    @abc.abstractmethod
    def bind(self, place: Place) -> Current:
        """Make the current; raise UwsimError if an input is missing."""

    @property
    def code(self) -> str:
        """The user's Python code that it runs, ``module:function``; empty if none."""
        return ""

    def files(self, place: Place) -> Mapping[str, Path]:
        """Return the files that it reads or runs, by their names in the scene file."""
        return {}


class Current(abc.ABC):
    """A current: a `uwsim.world.Flow`.

    It is a function of position and time alone, so the order of evaluations has no effect.
    """

    @property
    def is_uniform(self) -> bool:
        """True if the velocity is the same at every point."""
        return False

    @property
    def is_still(self) -> bool:
        """True if the water never moves."""
        return False

    @property
    def is_steady(self) -> bool:
        """True if the velocity is constant in time."""
        return self.is_still

    def flow_function(self, vehicles: Sequence[str]) -> FlowFunction | None:
        """Return its function for compiled code; None if Python must evaluate it in every step.

        Args:
            vehicles: the names of the vehicles, by their numbers in queries.
        """
        return None

    @abc.abstractmethod
    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L.

        Args:
            points: the points in L, (n, 3) [m].
            time: the simulation time [s].
            vehicles: the vehicle at each point, n names, ``""`` for none; or empty.

        Returns:
            The velocities, (n, 3) [m/s]; a new array.
        """

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the local rate of change of the velocity, in L, (n, 3) [m/s2].

        By default it is a central difference over 2 ms.
        """
        start_time = max(0.0, time - HALF_SPAN)
        end_velocity = self.velocity(points, time + HALF_SPAN, vehicles)
        start_velocity = self.velocity(points, start_time, vehicles)
        change: Array = (end_velocity - start_velocity) / (time + HALF_SPAN - start_time)
        return change

    def motion(
        self, points: Array, time: float, vehicles: Sequence[str] = ()
    ) -> tuple[Array, Array]:
        """Return velocity and acceleration, which physics needs at every step."""
        return self.velocity(points, time, vehicles), self.acceleration(points, time, vehicles)


def flow_function_of(flow: Flow, vehicles: Sequence[str]) -> FlowFunction | None:
    """Return `Current.flow_function` of a flow; None of one that is no `Current`."""
    return flow.flow_function(vehicles) if isinstance(flow, Current) else None


def is_steady(flow: Flow) -> bool:
    """Return whether a flow is constant in time; False for one that is no `Current`."""
    return isinstance(flow, Current) and flow.is_steady
