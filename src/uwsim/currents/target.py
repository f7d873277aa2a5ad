"""A current that acts on a single vehicle, as the currents of UWSim's benchmarks do."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import FUNCTION, call
from ..base.numerics.jit import njit
from ..base.numerics.memory import carray, pointer, view_doubles, view_int64s
from ..world import Flow
from .current import Current, flow_function_of, is_steady
from .flow_function import QUERY, FlowFunction, Record


class TargetCurrent(Current):
    """A current that acts on one vehicle; the water is still for all other bodies.

    Args:
        current: the current.
        target: the name of the vehicle.
    """

    def __init__(self, current: Flow, target: str) -> None:
        self._current, self._target = current, target

    @property
    def is_uniform(self) -> bool:
        """True if the current is uniform."""
        return self._current.is_uniform

    @property
    def is_steady(self) -> bool:
        """True if the current is constant in time."""
        return is_steady(self._current)

    @property
    def is_still(self) -> bool:
        """True if the current is always zero."""
        return self._current.is_still

    def flow_function(self, vehicles: Sequence[str]) -> FlowFunction | None:
        """Return the compiled function; None if the current has none."""
        flow = flow_function_of(self._current, vehicles)
        if flow is None:
            return None
        row, names = np.zeros(1, TARGET), list(vehicles)
        row["flow"] = flow.addresses
        row["target"] = names.index(self._target) if self._target in names else -1
        return FlowFunction(
            function=flow_target,
            parameters=row,
            prepare=flow.prepare,
            memory_owners=(flow,),
        )

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s]."""
        return self._clear_others(self._current.velocity(points, time, vehicles), vehicles)

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the acceleration of the water, in L, (n, 3) [m/s2]."""
        return self._clear_others(self._current.acceleration(points, time, vehicles), vehicles)

    def motion(
        self, points: Array, time: float, vehicles: Sequence[str] = ()
    ) -> tuple[Array, Array]:
        """Return `velocity` and `acceleration` together."""
        velocity, acceleration = self._current.motion(points, time, vehicles)
        return self._clear_others(velocity, vehicles), self._clear_others(acceleration, vehicles)

    def _clear_others(self, vectors: Array, vehicles: Sequence[str]) -> Array:
        """Set the vectors (n, 3) at points of other vehicles to 0, in place."""
        if not vehicles:
            return np.zeros_like(vectors)
        is_other = [name != self._target for name in vehicles]
        if any(is_other):
            vectors[is_other] = 0.0
        return vectors


TARGET = np.dtype([("flow", FUNCTION), ("target", np.int64)])
"""The parameters of `flow_target`: a current, and the index of the vehicle that it acts on."""


def flow_target(parameters_address: int, query_address: int, time: float) -> None:
    """Evaluate a query of a target's current; see `uwsim.currents.flow_function`."""
    current = carray(pointer(parameters_address), (1,), TARGET)[0]
    query = carray(pointer(query_address), (1,), QUERY)[0]
    call(current.flow.function, current.flow.parameters, query_address, time)
    clear_others(query, query.velocity, current.target)
    if query.acceleration != 0:
        clear_others(query, query.acceleration, current.target)


@njit
def clear_others(query: Record, address: int, target: int) -> None:
    """Set the vectors (n, 3) at an address to 0 at points of other vehicles than the target."""
    vectors = view_doubles(address, 3 * query.n)
    for i in range(query.n):
        if query.vehicles == 0 or view_int64s(query.vehicles, query.n)[i] != target:
            for k in range(3):
                vectors[3 * i + k] = 0.0
