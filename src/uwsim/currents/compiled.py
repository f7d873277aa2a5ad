"""The base class of currents whose compiled function is also evaluated from Python."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import call
from ..base.numerics.jit import njit
from .current import Current
from .flow_function import QUERY, FlowFunction, Record


class CompiledCurrent(Current):
    """A current with a compiled function, ``_flow``, which each subclass sets."""

    _flow: FlowFunction

    def flow_function(self, vehicles: Sequence[str]) -> FlowFunction | None:
        """Return the compiled function; None if a subclass overrides a method in Python."""
        kind, base = type(self), CompiledCurrent
        is_own = kind.velocity is base.velocity and kind.acceleration is base.acceleration
        return self._flow if is_own and kind.motion is base.motion else None

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s]."""
        return self._evaluate(points, time)[0]

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the partial time derivative of the velocity, in L, (n, 3) [m/s2]."""
        return self._evaluate(points, time)[1]

    def _evaluate(self, points: Array, time: float) -> tuple[Array, Array]:
        self._flow.prepare(time)
        contiguous_points = np.ascontiguousarray(points, dtype=np.float64)
        velocity, acceleration, _ = _evaluate(*self._flow.addresses, contiguous_points, time)
        return velocity, acceleration


@njit
def _evaluate(
    function_address: int, parameters_address: int, points: Array, time: float
) -> tuple[Array, Array, Record]:
    """Return velocity and acceleration at points without a vehicle, (n, 3) each, and the query."""
    velocity, acceleration = np.empty(points.shape), np.empty(points.shape)
    queries = np.zeros(1, QUERY)
    query = queries[0]
    query.n, query.points = len(points), points.ctypes.data
    query.velocity, query.acceleration = velocity.ctypes.data, acceleration.ctypes.data
    call(function_address, parameters_address, queries.ctypes.data, time)
    return velocity, acceleration, queries  # returned so that numba does not free it before `call`
