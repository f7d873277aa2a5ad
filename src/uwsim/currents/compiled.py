"""Currents that are compiled: Python asks the same function as compiled code."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import call
from ..base.numerics.jit import njit
from .current import Current
from .flow_function import QUERY, FlowFunction, Record


class CompiledCurrent(Current):
    """A current that is compiled; its subclass sets its function."""

    _flow: FlowFunction

    def flow_function(self, vehicles: Sequence[str]) -> FlowFunction | None:
        """Return its function; None of a subclass that answers in Python instead."""
        kind, own = type(self), CompiledCurrent
        is_own = kind.velocity is own.velocity and kind.acceleration is own.acceleration
        return self._flow if is_own and kind.motion is own.motion else None

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s]."""
        return self._answer(points, time)[0]

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return how fast that velocity changes at a fixed point, in L, (n, 3) [m/s2]."""
        return self._answer(points, time)[1]

    def _answer(self, points: Array, time: float) -> tuple[Array, Array]:
        self._flow.prepare(time)
        places = np.ascontiguousarray(points, dtype=np.float64)
        velocity, acceleration, _ = _ask(*self._flow.addresses, places, time)
        return velocity, acceleration


@njit
def _ask(function: int, parameters: int, points: Array, time: float) -> tuple[Array, Array, Record]:
    """Ask a current that is the same for all vehicles: its velocity and acceleration, (n, 3)."""
    velocity, acceleration = np.empty(points.shape), np.empty(points.shape)
    queries = np.zeros(1, QUERY)
    query = queries[0]
    query.n, query.points = len(points), points.ctypes.data
    query.velocity, query.acceleration = velocity.ctypes.data, acceleration.ctypes.data
    call(function, parameters, queries.ctypes.data, time)
    return velocity, acceleration, queries  # all of it lives until here
