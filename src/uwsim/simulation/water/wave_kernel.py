r"""The motion of the water in currents and waves, in compiled code, in the world frame W.

At each body the orbital velocity :math:`u_w` of the waves is added to the velocity :math:`u_c` of
the currents. The acceleration is the material derivative, of the water that passes the body,

.. math:: \frac{Du}{Dt} = \frac{Du_c}{Dt} + \frac{\partial u_w}{\partial t}
    + ((u_c + u_w) \cdot \nabla) u_w

with the exact gradient of the waves. The orbital motion has no rotation. Not modelled: the shear of
a current in the orbital motion, :math:`(u_w \cdot \nabla) u_c`, and the Doppler shift of waves in a
current.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ...base.geometry import Array
from ...base.numerics.calls import FUNCTION, CompiledFunction, address_of, call, function_address
from ...base.numerics.jit import njit
from ...base.numerics.memory import carray, pointer, view_doubles
from ...physics.hydrodynamics.water_function import (
    ACCELERATION,
    POINT,
    SURFACE,
    VELOCITY,
    WATER_ROW_LENGTH,
    DriftFunction,
    WaterFunction,
)
from ...waves import Waves
from ...waves import kernel as k
from ...waves.kernel import WAVES, compute_wave_motion

WAVY_WATER = np.dtype(
    [
        ("currents", FUNCTION),  # 0: no currents
        ("waves", np.int64),  # the address of a record of `WAVES`
        ("n", np.int64),  # the number of bodies
        ("rows", np.int64),  # the address of rows for the currents alone, (n, WATER_ROW_LENGTH)
    ]
)
"""The record of the water of a scene with waves, for compiled code."""
DRIFT_IN_WAVES = np.dtype(
    [
        ("currents", FUNCTION),  # 0: no currents
        ("waves", np.int64),  # the address of a record of `WAVES`
        ("n", np.int64),  # the number of vehicles
        ("timestep", np.float64),  # [s]
    ]
)
"""The record of kinematic vehicles that drift in currents and waves, for compiled code."""
POINTS_IN_WAVES = np.dtype([("currents", FUNCTION), ("waves", np.int64), ("n", np.int64)])
"""The record of n points of one vehicle in a scene with waves, for compiled code."""

Record = Any


def add_waves(currents: WaterFunction | None, waves: Waves, n: int) -> WaterFunction:
    """Return the function that computes the motion of the water in currents and waves.

    Args:
        currents: the function that computes the motion in currents alone; None: no currents.
        waves: the waves.
        n: the number of bodies.
    """
    rows, row = np.zeros((n, WATER_ROW_LENGTH)), np.zeros(1, WAVY_WATER)
    row["waves"], row["n"], row["rows"] = address_of(waves.record), n, address_of(rows)
    if currents is not None:
        row["currents"] = currents.function, currents.address
    return WaterFunction(
        function=function_address(write_wavy_water),
        parameters=row,
        needs_points=True,
        uses_submerged_centre=True,
        memory_owners=(currents, waves, rows),
    )


def add_waves_to_drift(
    currents: DriftFunction | None, waves: Waves, n: int, timestep: float
) -> DriftFunction:
    """Return the function that moves kinematic vehicles with currents and waves.

    Args:
        currents: the function for the drift in currents alone; None: no currents.
        waves: the waves.
        n: the number of vehicles.
        timestep: the length of a step [s].
    """
    row = np.zeros(1, DRIFT_IN_WAVES)
    row["waves"], row["n"], row["timestep"] = address_of(waves.record), n, timestep
    if currents is not None:
        row["currents"] = currents.function, currents.address
    return DriftFunction(
        function=function_address(drift_in_waves), parameters=row, memory_owners=(currents, waves)
    )


def add_waves_to_points(currents: CompiledFunction, waves: Waves, n: int) -> CompiledFunction:
    """Return the function that computes the velocity of the water at points, with waves.

    Args:
        currents: the function that computes the velocity of the currents alone.
        waves: the waves.
        n: the number of points.
    """
    row = np.zeros(1, POINTS_IN_WAVES)
    row["currents"], row["waves"], row["n"] = currents.addresses, address_of(waves.record), n
    return CompiledFunction(
        addresses=(function_address(write_velocities_in_waves), address_of(row)),
        prepare=currents.prepare,
        memory_owners=(row, currents, waves),
    )


def write_wavy_water(parameters: int, values: int, time: float) -> None:
    """Write the motion of the water in currents and waves; see `WaterFunction`.

    Args:
        parameters: the address of a `WAVY_WATER` record.
        values: the address of the rows, (n, `WATER_ROW_LENGTH`).
        time: the time in the middle of the step [s].
    """
    water = carray(pointer(parameters), (1,), WAVY_WATER)[0]
    waves = carray(pointer(water.waves), (1,), WAVES)[0]
    rows = view_doubles(values, WATER_ROW_LENGTH * water.n).reshape((water.n, WATER_ROW_LENGTH))
    currents = view_doubles(water.rows, WATER_ROW_LENGTH * water.n).reshape(
        (water.n, WATER_ROW_LENGTH)
    )
    for i in range(water.n):
        for j in range(VELOCITY):
            currents[i, j] = rows[i, j]
    if water.currents.function != 0:
        call(water.currents.function, water.currents.parameters, water.rows, time)
    for i in range(water.n):
        for j in range(VELOCITY, SURFACE):
            rows[i, j] = currents[i, j]
        motion = compute_wave_motion(
            waves, rows[i, POINT], rows[i, POINT + 1], rows[i, POINT + 2], time
        )
        _add_motion(motion, rows[i])


@njit
def _add_motion(motion: Array, row: Array) -> None:
    """Add the motion in waves, as `compute_wave_motion` returns it, to the row of a body."""
    for j in range(3):
        row[VELOCITY + j] += motion[k.VELOCITY + j]
    u, v, w = row[VELOCITY], row[VELOCITY + 1], row[VELOCITY + 2]
    xx, xy, yy = motion[k.GRADIENT], motion[k.GRADIENT + 1], motion[k.GRADIENT + 2]
    xz, yz = motion[k.GRADIENT + 3], motion[k.GRADIENT + 4]
    acceleration = motion[k.ACCELERATION : k.GRADIENT]
    row[ACCELERATION] += acceleration[0] + xx * u + xy * v + xz * w
    row[ACCELERATION + 1] += acceleration[1] + xy * u + yy * v + yz * w
    row[ACCELERATION + 2] += acceleration[2] + xz * u + yz * v - (xx + yy) * w
    row[SURFACE] = motion[k.ELEVATION]
    row[SURFACE + 1], row[SURFACE + 2] = motion[k.SLOPE], motion[k.SLOPE + 1]


def drift_in_waves(parameters: int, values: int, time: float) -> None:
    """Move vehicles with currents and waves by one step.

    Args:
        parameters: the address of a `DRIFT_IN_WAVES` record.
        values: the address of the poses in W, (n, 7); see `DriftFunction`.
        time: the time at the end of the step [s].
    """
    record = carray(pointer(parameters), (1,), DRIFT_IN_WAVES)[0]
    waves = carray(pointer(record.waves), (1,), WAVES)[0]
    poses = view_doubles(values, 7 * record.n).reshape((record.n, 7))
    velocities = np.empty((record.n, 3))
    for i in range(record.n):
        motion = compute_wave_motion(waves, poses[i, 0], poses[i, 1], poses[i, 2], time)
        for j in range(3):
            velocities[i, j] = motion[k.VELOCITY + j]
    if record.currents.function != 0:
        call(record.currents.function, record.currents.parameters, values, time)
    for i in range(record.n):
        for j in range(3):
            poses[i, j] += velocities[i, j] * record.timestep


def write_velocities_in_waves(parameters: int, values: int, time: float) -> None:
    """Write the velocities of the water behind the points; see `uwsim.world.mounts.read_water`.

    Args:
        parameters: the address of a `POINTS_IN_WAVES` record.
        values: the address of n points in W [m], then of n velocities in W [m/s], (2, n, 3).
        time: the time [s].
    """
    record = carray(pointer(parameters), (1,), POINTS_IN_WAVES)[0]
    waves = carray(pointer(record.waves), (1,), WAVES)[0]
    call(record.currents.function, record.currents.parameters, values, time)
    rows = view_doubles(values, 6 * record.n).reshape((2, record.n, 3))
    for i in range(record.n):
        motion = compute_wave_motion(waves, rows[0, i, 0], rows[0, i, 1], rows[0, i, 2], time)
        for j in range(3):
            rows[1, i, j] += motion[k.VELOCITY + j]
