"""Water that moves at the links of rows, computed before each step by the functions of the engine.

A row has the address of a `WaterFunction`, which computes the motion of the water from the time and
the positions of the links, and which the engine calls in the same way (`step_kernel.set_water`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ...base.numerics.calls import address_of, call
from ...base.numerics.jit import njit_borrowed
from ...base.numerics.memory import Floats, Ints64
from ...physics.hydrodynamics import columns as h
from ...physics.hydrodynamics.kernel import submersion
from ...physics.hydrodynamics.kernel.equations import to_world
from ...physics.hydrodynamics.kernel.flow import submerged_height
from ...physics.hydrodynamics.kernel.free_step import FreeVehicle, write_axes
from ...physics.hydrodynamics.water_function import (
    ANGULAR_VELOCITY,
    POINT,
    SURFACE,
    VELOCITY,
    WATER_ROW_LENGTH,
    WaterFunction,
)

FUNCTION, PARAMETERS, MOTIONS, NEEDS_POINTS, USES_SUBMERGED_CENTRE, IS_STEADY, FLOW_COLUMNS = range(
    7
)
"""The columns of `RowFlows.functions`: the addresses of a function (0: the water of the row remains
as it is), of its parameters and of the row of `RowFlows.motions`; then the flags of
`WaterFunction`."""
MEMORY = 21 + submersion.MEMORY
"""The length of the scratch memory of `move_water`."""


class RowFlows(NamedTuple):
    """The functions of the water of rows, and what they read and write."""

    functions: Ints64
    """The functions of the rows, (n, `FLOW_COLUMNS`)."""
    motions: Floats
    """The points and the motion of the water at them, (n, bodies, `WATER_ROW_LENGTH`)."""
    points: Floats
    """The points at which the water acts on the links, then on the base, in their axes,
    (links + 1, 3) [m]."""
    base_link: int
    """The index of the base among the links; the number of links if it is not in the water."""


def make_flows(vehicle: FreeVehicle, n: int) -> RowFlows:
    """Return the flows of n rows, in which no water moves yet."""
    n_links = len(vehicle.bodies)
    points = np.zeros((n_links + 1, 3))
    for i, row in enumerate(vehicle.bodies):
        points[i] = row[h.REFERENCE : h.REFERENCE + 3]
        if row[h.DISPLACED_MASS] > 0.0:
            points[i] += row[h.CENTRE : h.CENTRE + 3]
    base_link = base_link_of(vehicle)
    return RowFlows(
        functions=np.zeros((n, FLOW_COLUMNS), np.int64),
        motions=np.zeros((n, n_bodies(vehicle), WATER_ROW_LENGTH)),
        points=points,
        base_link=base_link,
    )


def set_flow(flows: RowFlows, row: int, function: WaterFunction | None) -> None:
    """Set the function of the water of a row; None: the water remains as it is."""
    flows.motions[row] = 0.0
    flows.functions[row] = 0
    if function is not None:
        flows.functions[row] = (
            function.function,
            function.address,
            address_of(flows.motions[row]),
            function.needs_points,
            function.uses_submerged_centre,
            function.is_steady,
        )


def base_link_of(vehicle: FreeVehicle) -> int:
    """Return the index of the base among the links; the number of links if it is none of them."""
    base_pose = np.concatenate([np.zeros(3), np.eye(3).ravel()])
    is_base: npt.NDArray[np.bool_] = (vehicle.poses == base_pose).all(axis=1)
    return int(np.argmax(is_base)) if is_base.any() else len(vehicle.bodies)


def n_bodies(vehicle: FreeVehicle) -> int:
    """Return the number of bodies at which the water is computed: the links, and the base."""
    n_links = len(vehicle.bodies)
    return n_links if base_link_of(vehicle) < n_links else n_links + 1


@njit_borrowed
def move_water(
    flows: RowFlows,
    row: int,
    vehicle: FreeVehicle,
    state: Floats,
    water: Floats,
    time: float,
    memory: Floats,
) -> None:
    """Set the water of a row for the step that begins, as the engine does.

    Args:
        flows: the functions of the water.
        row: the index of the row.
        vehicle: the numbers of its vehicle.
        state: the row of the state, (13 + k,).
        water: the water at the links, then at the base (`columns`), (links + 1, 12).
        time: the time in the middle of the step [s].
        memory: scratch memory, (`MEMORY`,).
    """
    flow, motions = flows.functions[row], flows.motions[row]
    n, n_links = len(motions), len(vehicle.bodies)
    if flow[NEEDS_POINTS] != 0:
        base_axes, axes, origin = memory[:9], memory[9:18], memory[18:21]
        write_axes(state, base_axes)
        for i in range(n):
            if i == n_links:
                _place_point(state, base_axes, flows.points[i], motions[i])
                continue
            _place_link(vehicle.poses[i], state, base_axes, origin, axes)
            _place_point(origin, axes, flows.points[i], motions[i])
            if flow[USES_SUBMERGED_CENTRE] != 0:
                motions[i, POINT + 2] = submerged_height(
                    vehicle.bodies[i], water[i], axes, origin[2], vehicle.world[h.SURFACE],
                    motions[i, POINT + 2], memory[21:],
                )  # fmt: skip
    call(flow[FUNCTION], flow[PARAMETERS], flow[MOTIONS], time)
    if flow[IS_STEADY] != 0:
        flow[FUNCTION] = 0
    for i in range(n_links + 1):
        motion, target = motions[flows.base_link if i == n_links else i], water[i]
        for k in range(6):
            target[k] = motion[VELOCITY + k]
        for k in range(3):
            target[h.OMEGA + k] = motion[ANGULAR_VELOCITY + k]
        target[h.ELEVATION] = motion[SURFACE]
        target[h.SLOPE_X], target[h.SLOPE_Y] = motion[SURFACE + 1], motion[SURFACE + 2]


@njit_borrowed
def _place_link(
    pose: Floats, base: Floats, base_axes: Floats, origin: Floats, axes: Floats
) -> None:
    """Write the origin and the axes of a link in W, from its pose in the base and the base's."""
    x, y, z = to_world(base_axes, pose[0], pose[1], pose[2])
    origin[0], origin[1], origin[2] = base[0] + x, base[1] + y, base[2] + z
    for i in range(3):
        for j in range(3):
            axes[3 * i + j] = (
                base_axes[3 * i] * pose[3 + j]
                + base_axes[3 * i + 1] * pose[6 + j]
                + base_axes[3 * i + 2] * pose[9 + j]
            )


@njit_borrowed
def _place_point(origin: Floats, axes: Floats, point: Floats, motion: Floats) -> None:
    """Write the position in W of a point of a link to the row of its water."""
    x, y, z = to_world(axes, point[0], point[1], point[2])
    motion[POINT], motion[POINT + 1] = origin[0] + x, origin[1] + y
    motion[POINT + 2] = origin[2] + z
