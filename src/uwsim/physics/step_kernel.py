"""The compiled parts of a time step: commands and water before MuJoCo's step, checks after it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import call, call_both
from ..base.numerics.jit import njit
from ..base.numerics.memory import (
    Ints64,
    carray,
    pointer,
    read_int32,
    read_int64,
    view_doubles,
    view_int64s,
)
from ..base.sampling import TABLE, take_due
from .actuation.autopilot_kernel import Base, steer
from .actuation.records import AUTOPILOT, AUTOPILOT_STATE, JOINT, JOINT_STATE, POSITION, THRUSTER
from .actuation.servo_kernel import EngineArrays, advance_requests, apply_servos
from .engine_warnings import find_excess_speed
from .hydrodynamics.columns import ELEVATION, OMEGA, SLOPE_X, SLOPE_Y, WATER_COLUMNS
from .hydrodynamics.kernel import fields as f
from .hydrodynamics.kernel.flow import submerged_middle
from .hydrodynamics.kernel.free_bodies import move_to_end, move_to_middle
from .hydrodynamics.water_function import (
    ANGULAR_VELOCITY,
    POINT,
    SURFACE,
    VELOCITY,
    WATER_ROW_LENGTH,
)
from .islands import choose_islands

_MINVAL = 1e-15  # mjMINVAL
STEP_OK, ENGINE_WARNING, EXCESS_SPEED = range(3)
"""The outcomes of a step; for an excess speed the outcome is `EXCESS_SPEED` plus the index of the
degree of freedom."""

PLAN = np.dtype(
    [
        ("model", np.int64),  # addresses of MuJoCo's structs, and of the offsets of their fields
        ("data", np.int64),
        ("offsets", np.int64),
        ("n_offsets", np.int64),
        ("uses_midpoint", np.int64),  # 1 if free bodies move by half a step before MuJoCo's step
        ("step", np.int64),  # the number of steps taken
        ("autopilot_steps", np.int64),  # the period of the autopilots, in steps
        ("timestep", np.float64),  # the length of a step [s]
        ("autopilots", np.int64),  # the address of the numbers of `Autopilot.addresses`, 5 each
        ("n_autopilots", np.int64),
        ("servos", np.int64),  # the address of the numbers of `Servos.addresses`, 3 for a vehicle
        ("n_servos", np.int64),
        ("kinematic_bodies", np.int64),  # the address of their indices in qpos and qvel, 2 each
        ("n_kinematic_bodies", np.int64),
        ("poses", np.int64),  # the poses of kinematic bodies in W, 7 numbers each
        ("drift", np.int64),  # the addresses of a `DriftFunction` and its parameters; 0: no drift
        ("drift_parameters", np.int64),
        ("speeds", np.int64),  # the address of the rows of `engine_warnings.speed_limits`
        ("n_speeds", np.int64),
        ("warnings", np.int64),  # the address of MuJoCo's counters of warnings
        ("n_warnings", np.int64),
        ("warning_stride", np.int64),  # the number of bytes from one counter to the next
        ("submerged_bodies", np.int64),  # the address of the MuJoCo IDs of bodies in the water
        ("n_submerged_bodies", np.int64),
        ("samples", np.int64),  # the address of a record of `sampling.TABLE`; 0: no samples
        ("step_offset", np.int64),  # the simulation's step count minus ``step``
        ("kinematics", np.int64),  # the address of ``mj_kinematics``
        ("points", np.int64),  # the address of the bodies' reference points, in body axes [m]
        (
            "water_rows",
            np.int64,
        ),  # the address of the water's motion at them, (n, `WATER_ROW_LENGTH`)
        ("flow", np.int64),  # the addresses of a `WaterFunction` and its parameters
        ("flow_parameters", np.int64),
        ("needs_points", np.int64),  # 1 if this function reads the positions of the points
        (
            "uses_submerged_centre",
            np.int64,
        ),  # 1: heights of points are at submerged parts' centres
        ("n_water", np.int64),  # the number of further steps in which this function is called
    ],
    align=True,
)
"""The parameters of the steps of one engine."""

Record = Any


@njit
def begin_step(plans: Record) -> None:
    """Set the water, the thrusters and the servos for the step that begins.

    Args:
        plans: a record of `PLAN`, (1,).
    """
    plan = plans[0]
    m, d = plan.model, plan.data
    o = view_int64s(plan.offsets, plan.n_offsets)
    qpos = view_doubles(read_int64(d + o[f.QPOS]), read_int64(m + o[f.NQ]))
    if plan.n_kinematic_bodies > 0:
        record_kinematic_poses(plan, qpos)
    if plan.n_water > 0:
        set_water(plan, o)
    ctrl = view_doubles(read_int64(d + o[f.CTRL]), read_int64(m + o[f.NU]))
    run_autopilots(plan, o, qpos, ctrl)
    nv = read_int64(m + o[f.NV])
    engine = EngineArrays(
        qpos=qpos,
        bias=view_doubles(read_int64(d + o[f.BIAS_FORCE]), nv),
        passive=view_doubles(read_int64(d + o[f.PASSIVE]), nv),
        spring=view_doubles(read_int64(d + o[f.SPRING]), nv),
        damper=view_doubles(read_int64(d + o[f.DAMPER]), nv),
        efforts=view_doubles(read_int64(d + o[f.ACTUATOR]), nv),
        controls=ctrl,
    )
    servos = view_int64s(plan.servos, 3 * plan.n_servos)
    for i in range(plan.n_servos):
        joints = carray(pointer(servos[3 * i]), (servos[3 * i + 2],), JOINT)
        states = carray(pointer(servos[3 * i + 1]), (servos[3 * i + 2],), JOINT_STATE)
        advance_requests(plan.timestep, joints, states, qpos)
        apply_servos(plan.timestep, joints, states, engine)
    if plan.uses_midpoint != 0:
        move_to_middle(m, d, o)


@njit
def end_step(plans: Record) -> int:
    """Complete a step after MuJoCo's step, and return its outcome."""
    plan = plans[0]
    m, d = plan.model, plan.data
    o = view_int64s(plan.offsets, plan.n_offsets)
    if plan.uses_midpoint != 0:
        move_to_end(m, d, o)
    for i in range(plan.n_warnings):
        if read_int32(plan.warnings + plan.warning_stride * i) != 0:
            return ENGINE_WARNING
    qvel = view_doubles(read_int64(d + o[f.QVEL]), read_int64(m + o[f.NV]))
    speeds = view_int64s(plan.speeds, 3 * plan.n_speeds).reshape((-1, 3))
    dof = find_excess_speed(qvel, speeds)
    if dof >= 0:
        return EXCESS_SPEED + dof
    qpos = view_doubles(read_int64(d + o[f.QPOS]), read_int64(m + o[f.NQ]))
    addresses = view_int64s(plan.kinematic_bodies, 2 * plan.n_kinematic_bodies)
    poses = view_doubles(plan.poses, 7 * plan.n_kinematic_bodies)
    for i in range(plan.n_kinematic_bodies):
        for k in range(7):
            qpos[addresses[2 * i] + k] = poses[7 * i + k]
        for k in range(6):
            qvel[addresses[2 * i + 1] + k] = 0.0
    plan.step += 1
    choose_islands(m, d, o, plan.step)
    return STEP_OK


@njit
def sample(plans: Record) -> bool:
    """Take the samples that are due after a step, with updated poses; return if any was due."""
    plan = plans[0]
    if plan.samples == 0:
        return False
    tables, step = carray(pointer(plan.samples), (1,), TABLE), plan.step + plan.step_offset
    if step < read_int64(tables[0].due):
        return False
    call_both(plan.kinematics, plan.model, plan.data)
    take_due(tables, step)
    return True


@njit
def sample_and_begin(plans: Record) -> None:
    """Take the samples that are due after a step, and begin the next."""
    plan, has_current_poses = plans[0], sample(plans)
    if plan.needs_points != 0 and not has_current_poses:
        call_both(plan.kinematics, plan.model, plan.data)
    begin_step(plans)


@njit
def end_and_begin(plans: Record) -> int:
    """Complete a step, take samples and begin the next step, unless the step failed."""
    outcome = end_step(plans)
    if outcome == STEP_OK:
        sample_and_begin(plans)
    return outcome


@njit
def record_kinematic_poses(plan: Record, qpos: Array) -> None:
    """Move the kinematic bodies with the water, and record their poses, which MuJoCo changes."""
    addresses = view_int64s(plan.kinematic_bodies, 2 * plan.n_kinematic_bodies)
    poses = view_doubles(plan.poses, 7 * plan.n_kinematic_bodies)
    for i in range(plan.n_kinematic_bodies):
        for k in range(7):
            poses[7 * i + k] = qpos[addresses[2 * i] + k]
    if plan.drift == 0:
        return
    time = (plan.step + plan.step_offset + 1) * plan.timestep
    call(plan.drift, plan.drift_parameters, plan.poses, time)
    for i in range(plan.n_kinematic_bodies):
        for k in range(7):
            qpos[addresses[2 * i] + k] = poses[7 * i + k]


@njit
def set_water(plan: Record, o: Ints64) -> None:
    """Set the motion of the water for the step that begins, evaluated at the middle of the step."""
    d, n = plan.data, plan.n_submerged_bodies
    bodies = view_int64s(plan.submerged_bodies, n)
    rows = view_doubles(plan.water_rows, WATER_ROW_LENGTH * n).reshape((n, WATER_ROW_LENGTH))
    if plan.needs_points != 0:
        points = view_doubles(plan.points, 3 * n)
        for i in range(n):
            origin = view_doubles(read_int64(d + o[f.XPOS]) + 24 * bodies[i], 3)
            axes = view_doubles(read_int64(d + o[f.XMAT]) + 72 * bodies[i], 9)
            x, y, z = points[3 * i], points[3 * i + 1], points[3 * i + 2]
            for k in range(3):
                rows[i, POINT + k] = (
                    origin[k] + axes[3 * k] * x + axes[3 * k + 1] * y + axes[3 * k + 2] * z
                )
            if plan.uses_submerged_centre != 0:
                rows[i, POINT + 2] = submerged_middle(
                    plan.model, d, o, bodies[i], rows[i, POINT + 2]
                )
    time = (plan.step + plan.step_offset + 1) * plan.timestep - 0.5 * plan.timestep
    call(plan.flow, plan.flow_parameters, plan.water_rows, time)
    userdata = view_doubles(read_int64(d + o[f.USERDATA]), read_int64(plan.model + o[f.NUSERDATA]))
    for i in range(n):
        start = WATER_COLUMNS * bodies[i]
        for k in range(6):
            userdata[start + k] = rows[i, VELOCITY + k]
        for k in range(3):
            userdata[start + OMEGA + k] = rows[i, ANGULAR_VELOCITY + k]
        userdata[start + ELEVATION] = rows[i, SURFACE]
        userdata[start + SLOPE_X] = rows[i, SURFACE + 1]
        userdata[start + SLOPE_Y] = rows[i, SURFACE + 2]
    plan.n_water -= 1


@njit
def run_autopilots(plan: Record, o: Ints64, qpos: Array, ctrl: Array) -> None:
    """Run the autopilots that are due or have a new command; they set their thruster commands."""
    addresses = view_int64s(plan.autopilots, 5 * plan.n_autopilots)
    is_due = plan.step % plan.autopilot_steps == 0
    for i in range(plan.n_autopilots):
        numbers = addresses[5 * i : 5 * i + 5]
        state = carray(pointer(numbers[1]), (1,), AUTOPILOT_STATE)[0]
        if not is_due and state.has_new_command == 0:
            continue
        autopilot = carray(pointer(numbers[0]), (1,), AUTOPILOT)[0]
        thrusters = carray(pointer(numbers[2]), (numbers[4],), THRUSTER)
        is_over_ground = autopilot.is_over_ground != 0 or state.mode == POSITION
        qvel = view_doubles(read_int64(plan.data + o[f.QVEL]) + 8 * autopilot.dof_address, 6)
        water = read_int64(plan.data + o[f.USERDATA]) + 8 * WATER_COLUMNS * autopilot.body
        base = base_motion(
            qpos[autopilot.qpos_address : autopilot.qpos_address + 7],
            qvel,
            view_doubles(water, 3),
            is_over_ground,
        )
        commands = view_doubles(numbers[3], numbers[4])
        dt = plan.autopilot_steps * plan.timestep
        steer(dt, autopilot, state, thrusters, commands, base, ctrl)


@njit
def base_motion(qpos: Array, qvel: Array, water: Array, is_over_ground: bool) -> Base:
    """Return the motion of a vehicle's base for its autopilot.

    Args:
        qpos: the position in W [m] and quaternion (wxyz) of the base, (7,).
        qvel: the linear velocity in W [m/s], and the angular velocity in base axes [rad/s], (6,).
        water: the velocity of the water in W, (3,) [m/s].
        is_over_ground: true for the velocity over ground, else through the water.
    """
    rotation = engine_rotation(qpos[3], qpos[4], qpos[5], qpos[6])
    velocity = qvel.copy()
    for i in range(3):
        velocity[i] = rotation[0, i] * qvel[0] + rotation[1, i] * qvel[1] + rotation[2, i] * qvel[2]
        if not is_over_ground:
            velocity[i] -= (
                rotation[0, i] * water[0] + rotation[1, i] * water[1] + rotation[2, i] * water[2]
            )
    return Base(position=qpos[:3].copy(), rotation=rotation, velocity=velocity)


@njit
def engine_rotation(w: float, x: float, y: float, z: float) -> Array:
    """Return the rotation matrix of a quaternion (3, 3), with exactly the bits of MuJoCo."""
    size = math.sqrt((w * w + x * x) + (y * y + z * z))
    if size < _MINVAL:
        w, x, y, z = 1.0, 0.0, 0.0, 0.0
    elif abs(size - 1.0) > _MINVAL:
        share = 1.0 / size
        w, x, y, z = w * share, x * share, y * share, z * share
    axes = np.empty((3, 3))
    a, b, c, d = w * w, x * x, y * y, z * z
    axes[0, 0], axes[1, 1], axes[2, 2] = (a - c) + (b - d), (a + c) - (b + d), (a - c) - (b - d)
    axes[0, 1], axes[0, 2] = 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)
    axes[1, 0], axes[1, 2] = 2.0 * (x * y + w * z), 2.0 * (y * z - w * x)
    axes[2, 0], axes[2, 1] = 2.0 * (x * z - w * y), 2.0 * (y * z + w * x)
    return axes
