"""A current that starts during a run, with a time of its own that begins at the start."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import FUNCTION, call
from ..base.numerics.jit import njit
from ..base.numerics.memory import carray, pointer
from ..world import Flow
from .current import Current, flow_function_of
from .flow_function import QUERY, FlowFunction, write_everywhere


class DelayedCurrent(Current):
    """Another current from the time ``start + delay`` on, and still water before it.

    The other current is evaluated at the time since ``start``, plus ``offset``. The time since
    ``start`` is rounded to nanoseconds, so that a level of a benchmark gives the same numbers alone
    and late in a sweep.

    Args:
        current: the other current.
        start: the simulation time from which the delay and the current's time count [s].
        delay: the time from ``start`` to the first motion of the water [s].
        offset: the time of the other current at ``start`` [s].
    """

    def __init__(self, current: Flow, *, start: float, delay: float, offset: float = 0.0) -> None:
        self._current, self._start_time, self._delay = current, start, delay
        self._offset = offset

    @property
    def is_uniform(self) -> bool:
        """True if the other current is uniform."""
        return self._current.is_uniform

    @property
    def is_still(self) -> bool:
        """True if the other current is still."""
        return self._current.is_still

    def flow_function(self, vehicles: Sequence[str]) -> FlowFunction | None:
        """Return the compiled function; None if the other current has none."""
        flow = flow_function_of(self._current, vehicles)
        if flow is None:
            return None
        row = np.zeros(1, DELAYED_CURRENT)
        row["flow"], row["start_time"] = flow.addresses, self._start_time
        row["delay"], row["offset"] = self._delay, self._offset

        def prepare(end_time: float) -> None:
            if (current_time := self._current_time(end_time)) is not None:
                flow.prepare(current_time)

        return FlowFunction(
            function=flow_delayed, parameters=row, prepare=prepare, memory_owners=(flow,)
        )

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s]."""
        current_time = self._current_time(time)
        if current_time is None:
            return np.zeros((len(points), 3))
        return self._current.velocity(points, current_time, vehicles)

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the acceleration, in L, (n, 3) [m/s2], without the jump at the start."""
        current_time = self._current_time(time)
        if current_time is None:
            return np.zeros((len(points), 3))
        return self._current.acceleration(points, current_time, vehicles)

    def motion(
        self, points: Array, time: float, vehicles: Sequence[str] = ()
    ) -> tuple[Array, Array]:
        """Return `velocity` and `acceleration` together."""
        current_time = self._current_time(time)
        if current_time is None:
            return np.zeros((len(points), 3)), np.zeros((len(points), 3))
        return self._current.motion(points, current_time, vehicles)

    def _current_time(self, time: float) -> float | None:
        """Return the time of the other current at a simulation time [s]; None before it starts."""
        elapsed_time = round_to_nanoseconds(time - self._start_time)
        return None if elapsed_time < self._delay else elapsed_time + self._offset


DELAYED_CURRENT = np.dtype(
    [("flow", FUNCTION), ("start_time", np.float64), ("delay", np.float64), ("offset", np.float64)]
)
"""The parameters of `flow_delayed`: the other current; the times are in seconds."""


def flow_delayed(parameters_address: int, query_address: int, time: float) -> None:
    """Evaluate a query of a delayed current; see `uwsim.currents.flow_function`."""
    current = carray(pointer(parameters_address), (1,), DELAYED_CURRENT)[0]
    elapsed_time = round_to_nanoseconds(time - current.start_time)
    if elapsed_time < current.delay:
        query = carray(pointer(query_address), (1,), QUERY)[0]
        write_everywhere(query, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    else:
        call(
            current.flow.function,
            current.flow.parameters,
            query_address,
            elapsed_time + current.offset,
        )


@njit
def round_to_nanoseconds(time: float) -> float:
    """Round a time [s] to nanoseconds; the result equals Python's ``round(time, 9)`` exactly."""
    if abs(time) >= 2.0**23:  # neighbouring floats differ by more than a nanosecond
        return time
    nanoseconds = time * 1e9
    floor = math.floor(nanoseconds)
    fraction = nanoseconds - floor
    if fraction == 0.5:  # the product may have been rounded to the half: its error decides
        error = rounding_error(time, 1e9, nanoseconds)
        is_up = error > 0.0 or (error == 0.0 and floor % 2 == 1)
    else:
        is_up = fraction > 0.5
    return (floor + 1 if is_up else floor) / 1e9


@njit
def rounding_error(a: float, b: float, product: float) -> float:
    """Return the exact ``a * b`` minus its rounded product (Dekker 1971)."""
    split = 134217729.0  # 2**27 + 1
    high_a, high_b = split * a, split * b
    high_a, high_b = high_a - (high_a - a), high_b - (high_b - b)
    low_a, low_b = a - high_a, b - high_b
    return ((high_a * high_b - product) + high_a * low_b + low_a * high_b) + low_a * low_b
