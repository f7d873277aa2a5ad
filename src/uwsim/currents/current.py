"""The interface of currents: the velocity of the water at a point and a time.

L is the localized world frame of the scene, W the world frame (z up).
"""

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
"""The largest speed that a file may contain or a function may return [m/s]. Turbidity currents and
tsunamis reach about 30 m/s; a greater speed is most probably an error of units."""
HALF_SPAN = 1e-3
"""The half of the time span of the central difference that approximates the acceleration [s]."""


@dataclass(frozen=True, kw_only=True)
class SceneContext:
    """The properties of a scene that a current may need."""

    stream: Callable[[str], np.random.Generator]
    """The function that returns the random generator of a named stream."""
    find: Callable[[str], Path] = Path
    """The function that returns the path of a file from its name in the scene."""
    world_from_localized: Pose = field(default_factory=Pose.identity)
    """The pose of L in W."""
    runs_code: bool = True
    """True if Python functions named in the scene may run; if False, their currents are zero."""
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
    def bind(self, context: SceneContext) -> Current:
        """Create the current; raise UwsimError if an input is missing."""

    @property
    def code(self) -> str:
        """The user's Python function that the current calls, ``module:function``, or empty."""
        return ""

    def files(self, context: SceneContext) -> Mapping[str, Path]:
        """Return the files that the current reads or runs, by their names in the scene file."""
        return {}


class Current(abc.ABC):
    """A current, which implements `uwsim.world.Flow`.

    The velocity is a function of position, time and vehicle only, so the order of evaluations has
    no effect.
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
        """Return the compiled function of the current; None if only Python can evaluate it.

        Args:
            vehicles: the names of the vehicles, in the order of their indices in a query.
        """
        return None

    @abc.abstractmethod
    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L.

        Args:
            points: the points in L, (n, 3) [m].
            time: the simulation time [s].
            vehicles: the name of the vehicle at each point, ``""`` for none; or an empty sequence
                if there is no vehicle at any point.

        Returns:
            The velocities, (n, 3) [m/s]; a new array.
        """

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the partial derivative of the velocity with respect to time, in L, (n, 3) [m/s2].

        The default implementation is a central difference over 2 ms.
        """
        start_time = max(0.0, time - HALF_SPAN)
        end_velocity = self.velocity(points, time + HALF_SPAN, vehicles)
        start_velocity = self.velocity(points, start_time, vehicles)
        change: Array = (end_velocity - start_velocity) / (time + HALF_SPAN - start_time)
        return change

    def motion(
        self, points: Array, time: float, vehicles: Sequence[str] = ()
    ) -> tuple[Array, Array]:
        """Return `velocity` and `acceleration` together."""
        return self.velocity(points, time, vehicles), self.acceleration(points, time, vehicles)


def flow_function_of(flow: Flow, vehicles: Sequence[str]) -> FlowFunction | None:
    """Return `Current.flow_function` of a flow; None if the flow is not a `Current`."""
    return flow.flow_function(vehicles) if isinstance(flow, Current) else None


def is_steady(flow: Flow) -> bool:
    """Return whether a flow is known to be constant in time; False if it is not a `Current`."""
    return isinstance(flow, Current) and flow.is_steady
