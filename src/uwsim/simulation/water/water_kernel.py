r"""The motion of the water at bodies, in compiled code.

The flow gives the velocity :math:`u` and its change :math:`\partial u/\partial t` in L, the frame
of scene files. From these the functions compute, in the world frame W, the acceleration of the
water that passes a point, and the angular velocity of the water,

.. math:: \frac{Du}{Dt} = \frac{\partial u}{\partial t} + (u \cdot \nabla) u, \qquad
    \tfrac12 \nabla \times u

with central differences over `SHEAR_DISTANCE`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Pose
from ...base.numerics.calls import FUNCTION, address_of, call, function_address
from ...base.numerics.jit import njit
from ...base.numerics.memory import carray, pointer, view_doubles
from ...currents.flow_function import QUERY, FlowFunction, query_of
from ...physics.hydrodynamics.water_function import (
    ACCELERATION,
    ANGULAR_VELOCITY,
    POINT,
    SURFACE,
    VELOCITY,
    WATER_ROW_LENGTH,
    WaterFunction,
)

SHEAR_DISTANCE = 0.05
"""The offset of the points for central differences [m]."""
N_AROUND = 6
"""The number of points around a body for differences: on both sides along x, y and z of L."""

WATER = np.dtype(
    [
        ("flow", FUNCTION),
        ("n", np.int64),  # the number of bodies
        ("is_uniform", np.int64),
        ("rotation", np.float64, (3, 3)),  # of W in L
        ("position", np.float64, 3),  # of W in L [m]
        ("at_bodies", np.int64),  # the address of a `QUERY` record with one point a body
        (
            "around_bodies",
            np.int64,
        ),  # the address of a `QUERY` record with `N_AROUND` points a body
    ],
    align=True,
)
"""The record of the water of a scene, for compiled code."""
ROWS = np.dtype([("rows", np.int64), ("n_left", np.int64), ("n", np.int64)])
"""The record of precomputed rows: their address, the number of steps left, the number of bodies."""

Record = Any


def flow_function(
    flow: FlowFunction,
    localized_from_world: Pose,
    vehicles: npt.NDArray[np.int64],
    *,
    is_uniform: bool,
    is_steady: bool,
) -> WaterFunction:
    """Return the function that computes the motion of the water from a compiled flow.

    Args:
        flow: the compiled function of the flow, in L.
        localized_from_world: the pose of W in L.
        vehicles: the index in ``flow`` of the vehicle of each body, (n,).
        is_uniform: True if the flow is the same everywhere.
        is_steady: True if the flow is uniform and the same at all times.
    """
    at_bodies, *body_arrays = query_of(vehicles)
    around_bodies, *neighbour_arrays = query_of(np.repeat(vehicles, N_AROUND))
    row = np.zeros(1, WATER)
    row["flow"], row["n"], row["is_uniform"] = flow.addresses, len(vehicles), is_uniform
    row["rotation"] = localized_from_world.rotation
    row["position"] = localized_from_world.position
    row["at_bodies"], row["around_bodies"] = address_of(at_bodies), address_of(around_bodies)
    return WaterFunction(
        function=function_address(write_water),
        parameters=row,
        needs_points=not is_uniform,
        is_steady=is_steady,
        memory_owners=(flow, at_bodies, around_bodies, body_arrays, neighbour_arrays),
    )


def row_function(rows: Array) -> WaterFunction:
    """Return the function that reads the motion of the water from precomputed rows.

    Args:
        rows: for each step and body, the velocity [m/s], acceleration [m/s2] and angular velocity
            [rad/s] of the water in W, (n steps, n bodies, 9). One step applies to all.
    """
    parameters = np.zeros(1, ROWS)
    parameters["rows"], parameters["n_left"], parameters["n"] = (
        address_of(rows),
        len(rows),
        rows.shape[1],
    )
    return WaterFunction(
        function=function_address(write_next_rows),
        parameters=parameters,
        is_steady=len(rows) == 1,
        memory_owners=(rows,),
    )


def write_next_rows(parameters: int, values: int, time: float) -> None:
    """Write the precomputed rows of the next step; see `WaterFunction`."""
    table = carray(pointer(parameters), (1,), ROWS)[0]
    if table.n_left == 0:
        return
    size = SURFACE - VELOCITY
    source, rows = (
        view_doubles(table.rows, size * table.n),
        view_doubles(values, WATER_ROW_LENGTH * table.n),
    )
    for i in range(table.n):
        for k in range(size):
            rows[WATER_ROW_LENGTH * i + VELOCITY + k] = source[size * i + k]
    table.rows += 8 * size * table.n
    table.n_left -= 1


def write_water(parameters: int, values: int, time: float) -> None:
    """Write the motion of the water at each body; see `WaterFunction`.

    Args:
        parameters: the address of a `WATER` record.
        values: the address of the rows, (n, `WATER_ROW_LENGTH`).
        time: the time in the middle of the step [s].
    """
    water = carray(pointer(parameters), (1,), WATER)[0]
    query = carray(pointer(water.at_bodies), (1,), QUERY)[0]
    rows = view_doubles(values, WATER_ROW_LENGTH * water.n).reshape((water.n, WATER_ROW_LENGTH))
    points = view_doubles(query.points, 3 * water.n)
    if water.is_uniform == 0:
        localize(water, rows, points)
    call(water.flow.function, water.flow.parameters, water.at_bodies, time)
    velocities = view_doubles(query.velocity, 3 * water.n)
    accelerations = view_doubles(query.acceleration, 3 * water.n)
    if water.is_uniform == 0:
        add_shear(water, rows, points, velocities, accelerations, time)
    for i in range(water.n):
        globalize(water.rotation, velocities[3 * i : 3 * i + 3], rows[i, VELOCITY:ACCELERATION])
        globalize(
            water.rotation, accelerations[3 * i : 3 * i + 3], rows[i, ACCELERATION:ANGULAR_VELOCITY]
        )


@njit
def localize(water: Record, rows: Array, points: Array) -> None:
    """Transform the points of rows from W to L, into ``points``, (3 n,) [m]."""
    for i in range(water.n):
        x, y, z = rows[i, POINT], rows[i, POINT + 1], rows[i, POINT + 2]
        for k in range(3):
            row = water.rotation[k]
            points[3 * i + k] = row[0] * x + row[1] * y + row[2] * z + water.position[k]


@njit
def add_shear(
    water: Record, rows: Array, points: Array, velocities: Array, accelerations: Array, time: float
) -> None:
    """Add the convective acceleration in L, and write the angular velocities in W to the rows."""
    query = carray(pointer(water.around_bodies), (1,), QUERY)[0]
    neighbours = view_doubles(query.points, 3 * N_AROUND * water.n).reshape((water.n, 3, 2, 3))
    for i in range(water.n):
        for j in range(3):
            for side in range(2):
                for k in range(3):
                    neighbours[i, j, side, k] = points[3 * i + k]
                neighbours[i, j, side, j] += SHEAR_DISTANCE if side == 0 else -SHEAR_DISTANCE
    query.acceleration = 0
    call(water.flow.function, water.flow.parameters, water.around_bodies, time)
    flows = view_doubles(query.velocity, 3 * N_AROUND * water.n).reshape((water.n, 3, 2, 3))
    gradient, rotation = np.empty((3, 3)), np.empty(3)  # gradient[k, j]: change of u_k along j
    for i in range(water.n):
        for k in range(3):
            convection = 0.0
            for j in range(3):
                gradient[k, j] = (flows[i, j, 0, k] - flows[i, j, 1, k]) / (2.0 * SHEAR_DISTANCE)
                convection += gradient[k, j] * velocities[3 * i + j]
            accelerations[3 * i + k] += convection
        for k in range(3):
            axis_1, axis_2 = (k + 1) % 3, (k + 2) % 3
            rotation[k] = 0.5 * (gradient[axis_2, axis_1] - gradient[axis_1, axis_2])
        globalize(water.rotation, rotation, rows[i, ANGULAR_VELOCITY:SURFACE])


@njit
def globalize(rotation: Array, vector: Array, world_vector: Array) -> None:
    """Rotate a vector from L to W, by the rotation of W in L, into ``world_vector``, (3,)."""
    for k in range(3):
        world_vector[k] = (
            0.0
            + vector[0] * rotation[0, k]
            + vector[1] * rotation[1, k]
            + vector[2] * rotation[2, k]
        )
