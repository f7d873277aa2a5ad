"""The drift of kinematic vehicles with the water, in compiled code: `WaterMotion.drifted_pose`.

W is the world frame and L the localized world, the frame of scene files.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...base.geometry import Pose, write_quaternion
from ...base.numerics.calls import FUNCTION, address_of, call, function_address
from ...base.numerics.memory import carray, pointer, view_doubles
from ...currents.flow_function import QUERY, FlowFunction, query_of
from ...physics.hydrodynamics.water_function import DriftFunction
from ...physics.step_kernel import engine_rotation

DRIFT = np.dtype(
    [
        ("flow", FUNCTION),
        # the address of a record of dtype `QUERY` (a request for the flow at points), with one
        # point for each vehicle
        ("query", np.int64),
        ("timestep", np.float64),  # [s]
        ("rotation", np.float64, (3, 3)),  # of L in W
        ("position", np.float64, 3),  # of L in W [m]
        ("inverse_rotation", np.float64, (3, 3)),  # of W in L
        ("inverse_position", np.float64, 3),  # of W in L [m]
    ],
    align=True,
)
"""The record of drifting vehicles, for compiled code."""


def drift_function(
    flow: FlowFunction, world_from_localized: Pose, vehicles: npt.NDArray[np.int64], timestep: float
) -> DriftFunction:
    """Return the function that moves kinematic vehicles with a flow.

    Args:
        flow: the compiled function of the flow, in L.
        world_from_localized: the pose of L in W.
        vehicles: the index of each vehicle in ``flow``, (n,).
        timestep: the length of a step [s].
    """
    query, *arrays = query_of(vehicles)
    query["acceleration"] = 0
    inverse = world_from_localized.inverse()
    row = np.zeros(1, DRIFT)
    row["flow"], row["query"], row["timestep"] = flow.addresses, address_of(query), timestep
    row["rotation"], row["position"] = world_from_localized.rotation, world_from_localized.position
    row["inverse_rotation"], row["inverse_position"] = inverse.rotation, inverse.position
    return DriftFunction(
        function=function_address(drift), parameters=row, memory_owners=(flow, query, arrays)
    )


def drift(parameters: int, values: int, time: float) -> None:
    """Move vehicles with the water by one step.

    Args:
        parameters: the address of a `DRIFT` record.
        values: the address of the poses in W, (n, 7); see `DriftFunction`.
        time: the time at the end of the step [s].
    """
    record = carray(pointer(parameters), (1,), DRIFT)[0]
    query = carray(pointer(record.query), (1,), QUERY)[0]
    poses = view_doubles(values, 7 * query.n).reshape((query.n, 7))
    points, velocities = (
        view_doubles(query.points, 3 * query.n),
        view_doubles(query.velocity, 3 * query.n),
    )
    for i in range(query.n):
        x, y, z = poses[i, 0], poses[i, 1], poses[i, 2]
        for k in range(3):
            row = record.inverse_rotation[k]
            point = row[0] * x + row[1] * y + row[2] * z
            points[3 * i + k] = point + record.inverse_position[k]
    call(record.flow.function, record.flow.parameters, record.query, time)
    for i in range(query.n):
        for k in range(3):
            points[3 * i + k] += velocities[3 * i + k] * record.timestep
        x, y, z = points[3 * i], points[3 * i + 1], points[3 * i + 2]
        for k in range(3):
            row = record.rotation[k]
            poses[i, k] = row[0] * x + row[1] * y + row[2] * z + record.position[k]
        # the attitude is kept as in `WaterMotion.drifted_pose`, whose `Pose` has a rotation matrix:
        # the same bytes need the same conversions
        rotation = engine_rotation(poses[i, 3], poses[i, 4], poses[i, 5], poses[i, 6])
        write_quaternion(rotation, poses[i, 3:7])
