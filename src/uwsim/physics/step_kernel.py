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
from .engine_warnings import too_fast
from .hydrodynamics.columns import TURN, WATER_COLUMNS
from .hydrodynamics.kernel import fields as f
from .hydrodynamics.kernel.free_bodies import to_the_end, to_the_middle
from .hydrodynamics.water_function import POINT, ROTATION, VELOCITY, WATER_ROW
from .islands import choose_islands

_TINY = 1e-15  # mjMINVAL
WENT_WELL, WARNED, TOO_FAST = range(3)
"""What became of a step; of one that is too fast the degree of freedom is added."""

PLAN = np.dtype(
    [
        ("model", np.int64),  # addresses of MuJoCo's structs, and of the offsets in them
        ("data", np.int64),
        ("offsets", np.int64),
        ("n_offsets", np.int64),
        ("is_in_middle", np.int64),  # whether free bodies go half a step before MuJoCo's step
        ("step", np.int64),  # steps taken
        ("autopilot_steps", np.int64),  # between two ticks of the autopilots
        ("timestep", np.float64),  # [s]
        ("autopilots", np.int64),  # five numbers each: `Autopilot.addresses`
        ("n_autopilots", np.int64),
        ("servos", np.int64),  # three numbers a vehicle: `Servos.addresses`
        ("n_servos", np.int64),
        ("placed", np.int64),  # places in qpos and qvel of bodies that stay where they are put
        ("n_placed", np.int64),
        ("poses", np.int64),  # where those are, seven numbers each
        ("drift", np.int64),  # the addresses of a `DriftFunction` and its parameters; 0: none moves
        ("drift_parameters", np.int64),
        ("speeds", np.int64),  # `engine_warnings.speeds_of`
        ("n_speeds", np.int64),
        ("warnings", np.int64),  # MuJoCo's counters
        ("n_warnings", np.int64),
        ("stride", np.int64),  # bytes from one to the next
        ("wet", np.int64),  # bodies that feel the water
        ("n_wet", np.int64),
        ("samples", np.int64),  # a record of `sampling.TABLE`; 0: none are taken
        ("ahead", np.int64),  # steps of the simulation's clock less those of this count
        ("kinematics", np.int64),  # the address of MuJoCo's function
        ("felt_at", np.int64),  # where these feel it, in their axes, three numbers each
        ("water_rows", np.int64),  # how it moves there, `WATER_ROW` numbers each
        ("flow", np.int64),  # the addresses of a `WaterFunction` and its parameters
        ("flow_parameters", np.int64),
        ("needs_points", np.int64),  # whether it reads where the bodies are
        ("n_water", np.int64),  # steps in which it is asked; behind them the water is as it was
    ],
    align=True,
)
"""What the step of one engine has to do: addresses and numbers."""

Record = Any


@njit
def begin(plans: Record) -> None:
    """Set the water, the thrusters and the servos of the step that begins."""
    plan = plans[0]
    m, d = plan.model, plan.data
    at = view_int64s(plan.offsets, plan.n_offsets)
    qpos = view_doubles(read_int64(d + at[f.QPOS]), read_int64(m + at[f.NQ]))
    if plan.n_placed > 0:
        keep_placed(plan, qpos)
    if plan.n_water > 0:
        set_water(plan, at)
    ctrl = view_doubles(read_int64(d + at[f.CTRL]), read_int64(m + at[f.NU]))
    set_thrusters(plan, at, qpos, ctrl)
    nv = word(m + at[f.NV])
    engine = EngineArrays(
        qpos=qpos,
        bias=floats(word(d + at[f.BIAS_FORCE]), nv),
        passive=floats(word(d + at[f.PASSIVE]), nv),
        spring=floats(word(d + at[f.SPRING]), nv),
        damper=floats(word(d + at[f.DAMPER]), nv),
        efforts=floats(word(d + at[f.ACTUATOR]), nv),
        controls=ctrl,
    )
    servos = view_int64s(plan.servos, 3 * plan.n_servos)
    for i in range(plan.n_servos):
        joints = carray(pointer(servos[3 * i]), (servos[3 * i + 2],), JOINT)
        states = carray(pointer(servos[3 * i + 1]), (servos[3 * i + 2],), JOINT_STATE)
        advance_requests(plan.timestep, joints, states, qpos)
        apply_servos(plan.timestep, joints, states, engine)
    if plan.is_in_middle != 0:
        to_the_middle(m, d, at)


@njit
def end(plans: Record) -> int:
    """Complete the step after MuJoCo's, and say what became of it."""
    plan = plans[0]
    m, d = plan.model, plan.data
    at = view_int64s(plan.offsets, plan.n_offsets)
    if plan.is_in_middle != 0:
        to_the_end(m, d, at)
    for i in range(plan.n_warnings):
        if read_int32(plan.warnings + plan.stride * i) != 0:
            return WARNED
    qvel = view_doubles(read_int64(d + at[f.QVEL]), read_int64(m + at[f.NV]))
    speeds = view_int64s(plan.speeds, 3 * plan.n_speeds).reshape((-1, 3))
    dof = too_fast(qvel, speeds)
    if dof >= 0:
        return TOO_FAST + dof
    qpos = view_doubles(read_int64(d + at[f.QPOS]), read_int64(m + at[f.NQ]))
    placed = view_int64s(plan.placed, 2 * plan.n_placed)
    poses = view_doubles(plan.poses, 7 * plan.n_placed)
    for i in range(plan.n_placed):
        for k in range(7):
            qpos[placed[2 * i] + k] = poses[7 * i + k]
        for k in range(6):
            qvel[placed[2 * i + 1] + k] = 0.0
    plan.step += 1
    choose_islands(m, d, at, plan.step)
    return WENT_WELL


@njit
def sample(plans: Record) -> bool:
    """Take the samples that are due after a step, with all bodies placed where they are then.

    Returns whether a timer was due.
    """
    plan = plans[0]
    if plan.samples == 0:
        return False
    tables, step = carray(pointer(plan.samples), (1,), TABLE), plan.step + plan.ahead
    if step < read_int64(tables[0].due):
        return False
    call_both(plan.kinematics, plan.model, plan.data)
    take_due(tables, step)
    return True


@njit
def sample_and_begin(plans: Record) -> None:
    """Take the samples that are due after a step, and begin the next."""
    plan, is_placed = plans[0], sample(plans)
    if plan.needs_points != 0 and not is_placed:
        call_both(plan.kinematics, plan.model, plan.data)
    begin(plans)


@njit
def end_and_begin(plans: Record) -> int:
    """Complete a step, sample, and begin the next, if the first went well."""
    found = end(plans)
    if found == WENT_WELL:
        sample_and_begin(plans)
    return found


@njit
def keep_placed(plan: Record, qpos: Array) -> None:
    """Write down where the bodies are that stay where they are put, after they have drifted."""
    placed = view_int64s(plan.placed, 2 * plan.n_placed)
    poses = view_doubles(plan.poses, 7 * plan.n_placed)
    for i in range(plan.n_placed):
        for k in range(7):
            poses[7 * i + k] = qpos[placed[2 * i] + k]
    if plan.drift == 0:
        return
    time = (plan.step + plan.ahead + 1) * plan.timestep
    call(plan.drift, plan.drift_parameters, plan.poses, time)
    for i in range(plan.n_placed):
        for k in range(7):
            qpos[placed[2 * i] + k] = poses[7 * i + k]


@njit
def set_water(plan: Record, at: Ints64) -> None:
    """Let the water move in the step that begins as its function says, at its middle."""
    d, n = plan.data, plan.n_wet
    wet = view_int64s(plan.wet, n)
    rows = view_doubles(plan.water_rows, WATER_ROW * n).reshape((n, WATER_ROW))
    if plan.needs_points != 0:
        felt_at = view_doubles(plan.felt_at, 3 * n)
        for i in range(n):
            origin = view_doubles(read_int64(d + at[f.XPOS]) + 24 * wet[i], 3)
            axes = view_doubles(read_int64(d + at[f.XMAT]) + 72 * wet[i], 9)
            x, y, z = felt_at[3 * i], felt_at[3 * i + 1], felt_at[3 * i + 2]
            for k in range(3):
                rows[i, POINT + k] = (
                    origin[k] + axes[3 * k] * x + axes[3 * k + 1] * y + axes[3 * k + 2] * z
                )
    time = (plan.step + plan.ahead + 1) * plan.timestep - 0.5 * plan.timestep
    call(plan.flow, plan.flow_parameters, plan.water_rows, time)
    userdata = view_doubles(
        read_int64(d + at[f.USERDATA]), read_int64(plan.model + at[f.NUSERDATA])
    )
    for i in range(n):
        to = WATER_COLUMNS * wet[i]
        for k in range(6):
            userdata[to + k] = rows[i, VELOCITY + k]
        for k in range(3):
            userdata[to + TURN + k] = rows[i, ROTATION + k]
    plan.n_water -= 1


@njit
def set_thrusters(plan: Record, at: Ints64, qpos: Array, ctrl: Array) -> None:
    """Let the autopilots that are due, or have got a command, set their thrusters."""
    addresses = view_int64s(plan.autopilots, 5 * plan.n_autopilots)
    is_due = plan.step % plan.autopilot_steps == 0
    for i in range(plan.n_autopilots):
        own = addresses[5 * i : 5 * i + 5]
        state = carray(pointer(own[1]), (1,), AUTOPILOT_STATE)[0]
        if not is_due and state.has_news == 0:
            continue
        autopilot = carray(pointer(own[0]), (1,), AUTOPILOT)[0]
        thrusters = carray(pointer(own[2]), (own[4],), THRUSTER)
        is_over_ground = autopilot.is_over_ground != 0 or state.mode == POSITION
        qvel = floats(word(plan.data + at[f.QVEL]) + 8 * autopilot.dof_address, 6)
        water = word(plan.data + at[f.USERDATA]) + 8 * WATER_COLUMNS * autopilot.body
        seen = look(
            qpos[autopilot.qpos_address : autopilot.qpos_address + 7],
            qvel,
            floats(water, 3),
            is_over_ground,
        )
        commands = view_doubles(own[3], own[4])
        dt = plan.autopilot_steps * plan.timestep
        steer(dt, autopilot, state, thrusters, commands, seen, ctrl)


@njit
def look(qpos: Array, qvel: Array, water: Array, is_over_ground: bool) -> Base:
    """Return a free body as its autopilot sees it."""
    rotation = rotation_of(qpos[3], qpos[4], qpos[5], qpos[6])
    velocity = qvel.copy()
    for i in range(3):
        velocity[i] = rotation[0, i] * qvel[0] + rotation[1, i] * qvel[1] + rotation[2, i] * qvel[2]
        if not is_over_ground:
            velocity[i] -= (
                rotation[0, i] * water[0] + rotation[1, i] * water[1] + rotation[2, i] * water[2]
            )
    return Base(position=qpos[:3].copy(), rotation=rotation, velocity=velocity)


@njit
def rotation_of(w: float, x: float, y: float, z: float) -> Array:
    """Return the matrix of a quaternion, bit for bit as MuJoCo computes it, (3, 3)."""
    size = math.sqrt((w * w + x * x) + (y * y + z * z))
    if size < _TINY:
        w, x, y, z = 1.0, 0.0, 0.0, 0.0
    elif abs(size - 1.0) > _TINY:
        share = 1.0 / size
        w, x, y, z = w * share, x * share, y * share, z * share
    found = np.empty((3, 3))
    a, b, c, d = w * w, x * x, y * y, z * z
    found[0, 0], found[1, 1], found[2, 2] = (a - c) + (b - d), (a + c) - (b + d), (a - c) - (b - d)
    found[0, 1], found[0, 2] = 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)
    found[1, 0], found[1, 2] = 2.0 * (x * y + w * z), 2.0 * (y * z - w * x)
    found[2, 0], found[2, 1] = 2.0 * (x * z - w * y), 2.0 * (y * z + w * x)
    return found
