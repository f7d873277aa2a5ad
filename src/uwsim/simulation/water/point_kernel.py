"""The velocity of the water at points, in compiled code: `WaterMotion.velocity`.

W is the world frame and L the localized world, the frame of scene files.
"""

from __future__ import annotations

import numpy as np

from ...base.geometry import Pose
from ...base.numerics.calls import (
    FUNCTION,
    CompiledFunction,
    address_of,
    call,
    function_address,
    prepare_nothing,
)
from ...base.numerics.memory import carray, pointer, view_doubles
from ...currents.flow_function import QUERY, FlowFunction, query_of
from .water_kernel import globalize

POINTS = np.dtype(
    [
        ("flow", FUNCTION),  # 0: the water is still
        ("query", np.int64),  # the address of a record of `QUERY`
        ("rotation", np.float64, (3, 3)),  # of W in L
        ("position", np.float64, 3),  # of W in L [m]
    ],
    align=True,
)
"""The record of the water at some points, for compiled code."""


def point_function(
    flow: FlowFunction | None, localized_from_world: Pose, n: int
) -> CompiledFunction:
    """Return the function that computes the velocity of the water at points of one vehicle.

    Args:
        flow: the compiled function of the flow in L, for this vehicle only; None: still water.
        localized_from_world: the pose of W in L.
        n: the number of points.
    """
    query, *arrays = query_of(np.zeros(n, dtype=np.int64))
    query["acceleration"] = 0
    row = np.zeros(1, POINTS)
    row["query"] = address_of(query)
    row["rotation"] = localized_from_world.rotation
    row["position"] = localized_from_world.position
    if flow is not None:
        row["flow"] = flow.addresses
    return CompiledFunction(
        addresses=(function_address(write_velocities), address_of(row)),
        prepare=prepare_nothing if flow is None else flow.prepare,
        memory_owners=(row, flow, query, arrays),
    )


def write_velocities(parameters: int, values: int, time: float) -> None:
    """Write the velocities of the water behind the points; see `uwsim.world.mounts.read_water`.

    Args:
        parameters: the address of a `POINTS` record.
        values: the address of n points in W [m], then of n velocities in W [m/s], (2, n, 3).
        time: the time [s].
    """
    water = carray(pointer(parameters), (1,), POINTS)[0]
    query = carray(pointer(water.query), (1,), QUERY)[0]
    rows = view_doubles(values, 6 * query.n).reshape((2, query.n, 3))
    rows[1] = 0.0
    if water.flow.function == 0:
        return
    points, velocities = (
        view_doubles(query.points, 3 * query.n),
        view_doubles(query.velocity, 3 * query.n),
    )
    for i in range(query.n):
        for k in range(3):
            row = water.rotation[k]
            points[3 * i + k] = (
                row[0] * rows[0, i, 0]
                + row[1] * rows[0, i, 1]
                + row[2] * rows[0, i, 2]
                + water.position[k]
            )
    call(water.flow.function, water.flow.parameters, water.query, time)
    for i in range(query.n):
        globalize(water.rotation, velocities[3 * i : 3 * i + 3], rows[1, i])
