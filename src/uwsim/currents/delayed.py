"""A current that starts at a given time, from which its own time counts."""

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


class LateCurrent(Current):
    """Zero before ``began + delay``; then the current at ``offset`` plus the time since began.

    The time since ``began`` is rounded to nanoseconds, so that a level gives the same numbers
    whether it is run alone or late in a sweep.
    """

    def __init__(self, current: Flow, *, began: float, delay: float, offset: float = 0.0) -> None:
        self._current, self._began, self._delay = current, began, delay
        self._offset = offset

    @property
    def is_uniform(self) -> bool:
        """Whether the other one is."""
        return self._current.is_uniform

    @property
    def is_still(self) -> bool:
        """Whether the other one is."""
        return self._current.is_still

    def flow_function(self, vehicles: Sequence[str]) -> FlowFunction | None:
        """Return its function; None where the other one has none."""
        flow = flow_function_of(self._current, vehicles)
        if flow is None:
            return None
        row = np.zeros(1, LATE)
        row["flow"], row["began"] = flow.addresses, self._began
        row["delay"], row["offset"] = self._delay, self._offset

        def prepare(until: float) -> None:
            if (own := self._own_time(until)) is not None:
                flow.prepare(own)

        return FlowFunction(function=flow_late, parameters=row, prepare=prepare, kept=(flow,))

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s]."""
        own = self._own_time(time)
        if own is None:
            return np.zeros((len(points), 3))
        return self._current.velocity(points, own, vehicles)

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return its acceleration, in L, (n, 3) [m/s2]; the jump at its beginning is left out."""
        own = self._own_time(time)
        if own is None:
            return np.zeros((len(points), 3))
        return self._current.acceleration(points, own, vehicles)

    def motion(
        self, points: Array, time: float, vehicles: Sequence[str] = ()
    ) -> tuple[Array, Array]:
        """Return velocity and acceleration."""
        own = self._own_time(time)
        if own is None:
            return np.zeros((len(points), 3)), np.zeros((len(points), 3))
        return self._current.motion(points, own, vehicles)

    def _own_time(self, time: float) -> float | None:
        """The time of the other one at a simulation time [s]; None before it starts."""
        elapsed = rounded(time - self._began)
        return None if elapsed < self._delay else elapsed + self._offset


LATE = np.dtype(
    [("flow", FUNCTION), ("began", np.float64), ("delay", np.float64), ("offset", np.float64)]
)
"""A current that starts at a given time, for compiled code."""


def flow_late(parameters: int, values: int, time: float) -> None:
    """Answer a query about a delayed current; see `uwsim.currents.flow_function`."""
    current = carray(pointer(parameters), (1,), LATE)[0]
    elapsed = rounded(time - current.began)
    if elapsed < current.delay:
        write_everywhere(carray(pointer(values), (1,), QUERY)[0], np.zeros(3), np.zeros(3))
    else:
        call(current.flow.function, current.flow.parameters, values, elapsed + current.offset)


@njit
def rounded(time: float) -> float:
    """Round a time [s] to nanoseconds, bit for bit as Python's ``round(time, 9)``."""
    if abs(time) >= 2.0**23:  # floats are further apart
        return time
    scaled = time * 1e9
    whole = math.floor(scaled)
    rest = scaled - whole
    if rest == 0.5:  # the product may have been rounded to the middle: what it lost decides
        lost = rounding_error(time, 1e9, scaled)
        is_up = lost > 0.0 or (lost == 0.0 and whole % 2 == 1)
    else:
        is_up = rest > 0.5
    return (whole + 1 if is_up else whole) / 1e9


@njit
def rounding_error(a: float, b: float, product: float) -> float:
    """Return ``a * b`` less its rounded product, exactly (Dekker 1971)."""
    split = 134217729.0  # 2**27 + 1
    high_a, high_b = split * a, split * b
    high_a, high_b = high_a - (high_a - a), high_b - (high_b - b)
    low_a, low_b = a - high_a, b - high_b
    return ((high_a * high_b - product) + high_a * low_b + low_a * high_b) + low_a * low_b
