"""The sum of several currents."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import FUNCTION, address_of, call
from ..base.numerics.memory import carray, pointer, view_doubles
from ..world import Flow
from .current import Current, CurrentSpec, SceneContext, flow_function_of, is_steady
from .flow_function import QUERY, FlowFunction


class TotalCurrent(Current):
    """The sum of several currents; still water without any."""

    def __init__(self, currents: Sequence[Flow]) -> None:
        self._currents = tuple(current for current in currents if not current.is_still)

    @property
    def is_uniform(self) -> bool:
        """True if all currents are uniform."""
        return all(current.is_uniform for current in self._currents)

    @property
    def is_steady(self) -> bool:
        """True if all currents are constant in time."""
        return all(is_steady(current) for current in self._currents)

    @property
    def is_still(self) -> bool:
        """True if all currents are still."""
        return not self._currents

    def flow_function(self, vehicles: Sequence[str]) -> FlowFunction | None:
        """Return the compiled function; None if one of the currents has none."""
        functions = [flow_function_of(current, vehicles) for current in self._currents]
        flows = [flow for flow in functions if flow is not None]
        if len(flows) < len(functions):
            return None
        if len(flows) == 1:
            return flows[0]
        parts, row = np.zeros(len(flows), FUNCTION), np.zeros(1, TOTAL)
        for part, flow in zip(parts, flows, strict=True):
            part["function"], part["parameters"] = flow.addresses
        row["parts"], row["n"] = address_of(parts), len(parts)

        def prepare(end_time: float) -> None:
            for flow in flows:
                flow.prepare(end_time)

        return FlowFunction(
            function=flow_total,
            parameters=row,
            prepare=prepare,
            memory_owners=(parts, flows),
        )

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s]."""
        parts = [current.velocity(points, time, vehicles) for current in self._currents]
        return _sum(parts, len(points))

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the acceleration of the water, in L, (n, 3) [m/s2]."""
        parts = [current.acceleration(points, time, vehicles) for current in self._currents]
        return _sum(parts, len(points))


def _sum(parts: list[Array], n: int) -> Array:
    """Return the sum of arrays of n vectors, (n, 3); overwrites the first array."""
    if not parts:
        return np.zeros((n, 3))
    for part in parts[1:]:
        parts[0] += part
    return parts[0]


TOTAL = np.dtype([("parts", np.int64), ("n", np.int64)])
"""The parameters of `flow_total`: the address of records of `calls.FUNCTION`, and their number."""


def flow_total(parameters_address: int, query_address: int, time: float) -> None:
    """Evaluate a query of a sum of currents; see `uwsim.currents.flow_function`."""
    current = carray(pointer(parameters_address), (1,), TOTAL)[0]
    parts = carray(pointer(current.parts), (current.n,), FUNCTION)
    query = carray(pointer(query_address), (1,), QUERY)[0]
    addresses = query.velocity, query.acceleration
    size = 3 * query.n
    part_vectors = np.empty(2 * size)  # the velocities and accelerations of one current
    for i in range(current.n):
        if i > 0:
            query.velocity = part_vectors.ctypes.data
            query.acceleration = part_vectors.ctypes.data + 8 * size if addresses[1] != 0 else 0
        call(parts[i].function, parts[i].parameters, query_address, time)
        for k in range(2 if i > 0 else 0):
            if addresses[k] != 0:
                total = view_doubles(addresses[k], size)
                for j in range(size):
                    total[j] += part_vectors[k * size + j]
    query.velocity, query.acceleration = addresses


def bind_currents(specs: Sequence[CurrentSpec], context: SceneContext) -> TotalCurrent:
    """Bind the currents of a scene; current i has its own random streams, ``scene/i/...``."""
    return TotalCurrent([spec.bind(_numbered_context(context, i)) for i, spec in enumerate(specs)])


def _numbered_context(context: SceneContext, i: int) -> SceneContext:
    return replace(context, stream=lambda name: context.stream(f"scene/{i}/{name}"))
