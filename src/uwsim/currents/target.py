"""A current that acts on one vehicle alone, as in the original's benchmarks."""

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
    """A current for its target; still water for all other bodies."""

    def __init__(self, current: Flow, target: str) -> None:
        self._current, self._target = current, target

    @property
    def is_uniform(self) -> bool:
        """True if the other current is uniform."""
        return self._current.is_uniform

    @property
    def is_steady(self) -> bool:
        """True if the other current is constant in time."""
        return is_steady(self._current)

    @property
    def is_still(self) -> bool:
        """True if the other current is still."""
        return self._current.is_still

    def flow_function(self, vehicles: Sequence[str]) -> FlowFunction | None:
        """Return its function; None if the other current has none."""
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
        """Return velocity and acceleration."""
        velocity, acceleration = self._current.motion(points, time, vehicles)
        return self._clear_others(velocity, vehicles), self._clear_others(acceleration, vehicles)

    def _clear_others(self, vectors: Array, vehicles: Sequence[str]) -> Array:
        """Set the vectors (n, 3) of other vehicles to 0."""
        if not vehicles:
            return np.zeros_like(vectors)
        is_other = [name != self._target for name in vehicles]
        if any(is_other):
            vectors[is_other] = 0.0
        return vectors


TARGET = np.dtype([("flow", FUNCTION), ("target", np.int64)])
"""A current, and the number of the only vehicle that it acts on, for compiled code."""


def flow_target(parameters: int, values: int, time: float) -> None:
    """Evaluate a query of the current of a target; see `uwsim.currents.flow_function`."""
    current = carray(pointer(parameters), (1,), TARGET)[0]
    query = carray(pointer(values), (1,), QUERY)[0]
    call(current.flow.function, current.flow.parameters, values, time)
    clear_others(query, query.velocity, current.target)
    if query.acceleration != 0:
        clear_others(query, query.acceleration, current.target)


@njit
def clear_others(query: Record, address: int, target: int) -> None:
    """Set to 0 the vectors (n, 3) at an address that are not the target's."""
    vectors = view_doubles(address, 3 * query.n)
    for i in range(query.n):
        if query.vehicles == 0 or view_int64s(query.vehicles, query.n)[i] != target:
            for k in range(3):
                vectors[3 * i + k] = 0.0
