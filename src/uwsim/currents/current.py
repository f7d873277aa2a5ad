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
"""No current of a file or a function is faster: turbidity currents and tsunamis reach
some 30 m/s. What is faster is taken for a mistake, mostly of units [m/s]."""
DIFFERENCE = 1e-3
"""Half the span of the central difference that gives the acceleration [s]."""


@dataclass(frozen=True, kw_only=True)
class Place:
    """The properties of a scene that a current may need."""

    stream: Callable[[str], np.random.Generator]
    """The random generator of a name."""
    find: Callable[[str], Path] = Path
    """Where a file that the scene names is."""
    world_from_localized: Pose = field(default_factory=Pose.identity)
    """W from L."""
    runs_code: bool = True
    """Whether code that the scene names may run; what it would say is else as good as nothing."""
    surface_height: float = 0.0
    """Of the still water, in W [m]."""

    def depths(self, points: Array) -> Array:
        """Return how far below the still surface points of L lie, (n,) [m]; above it negative."""
        pose = self.world_from_localized
        below: Array = self.surface_height - (product(points, pose.rotation[2]) + pose.position[2])
        return below


@dataclass(frozen=True, kw_only=True)
class CurrentSpec(Spec, abc.ABC):
    """The spec of a current."""

    @abc.abstractmethod
    def bind(self, place: Place) -> Current:
        """Make the current; raises UwsimError if something it needs is missing."""

    @property
    def code(self) -> str:
        """User-supplied Python code that it runs, ``module:function``; empty if none."""
        return ""

    def files(self, place: Place) -> Mapping[str, Path]:
        """Return the files that it reads or runs, by their names in the scene file."""
        return {}


class Current(abc.ABC):
    """Moving water: a `uwsim.world.Flow`.

    It is a function of place and time alone: asked twice, or out of order, it answers the same.
    """

    @property
    def is_uniform(self) -> bool:
        """Whether it is the same at every point."""
        return False

    @property
    def is_still(self) -> bool:
        """Whether it never moves at all."""
        return False

    @property
    def is_steady(self) -> bool:
        """Whether it is the same at all times."""
        return self.is_still

    def flow_function(self, vehicles: Sequence[str]) -> FlowFunction | None:
        """Return its function for compiled code; None where Python has to be asked in every step.

        Args:
            vehicles: their names, by the numbers that queries have for them.
        """
        return None

    @abc.abstractmethod
    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L.

        Args:
            points: where, in L, (n, 3) [m].
            time: simulation time [s].
            vehicles: what floats at each point, n names, ``""`` for none; or empty.

        Returns:
            (n, 3) [m/s]; the caller's own array.
        """

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return how fast that velocity changes at a fixed point, in L, (n, 3) [m/s2].

        A central difference over 2 ms by default.
        """
        before = max(0.0, time - DIFFERENCE)
        later = self.velocity(points, time + DIFFERENCE, vehicles)
        earlier = self.velocity(points, before, vehicles)
        change: Array = (later - earlier) / (time + DIFFERENCE - before)
        return change

    def motion(
        self, points: Array, time: float, vehicles: Sequence[str] = ()
    ) -> tuple[Array, Array]:
        """Return velocity and acceleration, which physics asks for at every step."""
        return self.velocity(points, time, vehicles), self.acceleration(points, time, vehicles)


def flow_function_of(flow: Flow, vehicles: Sequence[str]) -> FlowFunction | None:
    """Return `Current.flow_function` of a flow; None of one that is no `Current`."""
    return flow.flow_function(vehicles) if isinstance(flow, Current) else None


def is_steady(flow: Flow) -> bool:
    """Whether a flow says that it is the same at all times; one that is no `Current` does not."""
    return isinstance(flow, Current) and flow.is_steady
