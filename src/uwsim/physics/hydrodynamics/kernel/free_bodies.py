"""The energy-conserving step of free bodies in water: `midpoint` applied to MuJoCo's memory.

MuJoCo evaluates Coriolis forces explicitly. A force on the six degrees of freedom of a free body is
added, which changes MuJoCo's solution to that of the midpoint rule. Forces on the joints of the
body keep their accelerations unchanged. These forces are 0 for bodies that do not rotate, and
vanish with the length of a step.
"""

from __future__ import annotations

import numpy as np

from ....base.numerics.jit import njit
from ....base.numerics.memory import (
    Floats,
    Ints64,
    read_double,
    read_int32,
    read_int64,
    view_doubles,
    view_int32s,
)
from ..columns import BODY_COLUMNS, DRY_BODY, KIND, WATER_COLUMNS
from . import fields as f
from .equations import Three, read_six, to_body
from .free_motion import (
    add_rigid_body,
    convert_rate,
    fill_inertia,
    fill_motion,
    rotate_attitude,
    rotate_velocity,
    undo_gyroscopic,
)
from .midpoint import (
    CORRECTION,
    FORCE,
    NUMBERS,
    RATE,
    SUM,
    TWIST,
    multiply,
    solve_rate,
    substitute,
)

_IMPLICITFAST = 3  # mjINT_IMPLICITFAST
_RK4 = 1  # mjINT_RK4
_GRAVITY_OFF = 128  # mjDSBL_GRAVITY


@njit
def conserve_energy(m: int, d: int, o: Ints64, work: Floats) -> None:
    """Evaluate the Coriolis terms of every free body in water at the middle of the step.

    Args:
        m: the address of the model.
        d: the address of the data, with the water in ``M`` and ``qfrc_passive``.
        o: the offsets of the fields.
        work: the rows of the bodies, summed over their subtrees.
    """
    n, nbody, nv = (
        read_int64(m + o[f.NTREE]),
        read_int64(m + o[f.NBODY]),
        read_int64(m + o[f.NV]),
    )
    h = read_double(m + o[f.TIMESTEP])
    roots = view_int32s(read_int64(m + o[f.TREE_BODY]), n)
    n_bodies = view_int32s(read_int64(m + o[f.TREE_BODYNUM]), n)
    is_awake = view_int32s(read_int64(d + o[f.TREE_AWAKE]), n)
    n_joints = view_int32s(read_int64(m + o[f.BODY_JNTNUM]), nbody)
    n_dofs = view_int32s(read_int64(m + o[f.BODY_DOFNUM]), nbody)
    start = view_int32s(read_int64(m + o[f.TREE_DOFADR]), n)
    length = view_int32s(read_int64(m + o[f.TREE_DOFNUM]), n)
    passive = view_doubles(read_int64(d + o[f.PASSIVE]), nv)
    is_gyroscopic = read_int32(m + o[f.INTEGRATOR]) == _IMPLICITFAST
    b = np.empty(NUMBERS)
    for tree in range(n):
        body = roots[tree]
        is_free = n_joints[body] == 1 and n_dofs[body] == 6
        if not is_free or is_awake[tree] == 0 or work[f.ROW * body + f.IS_ACTIVE] == 0.0:
            continue
        _fill_inertia(m, d, o, work, tree, b)
        lever = _fill_numbers(m, d, o, work, body, b)
        _add_rigid(m, d, o, work, body, n_bodies[tree], b)
        _add_applied(m, d, o, body, start[tree], lever, b)
        solve_rate(b, h)
        _convert_to_wrench(lever, h, b)
        if is_gyroscopic and length[tree] == 6:
            undo_gyroscopic(view_doubles(read_int64(d + o[f.CRB]) + 80 * body, 10), lever, h, b)
        cdof = view_doubles(read_int64(d + o[f.CDOF]) + 48 * start[tree], 36)
        for k in range(6):
            for i in range(6):
                passive[start[tree] + k] += cdof[6 * k + i] * b[FORCE + i]
        if length[tree] > 6:
            for i in range(6):
                b[CORRECTION + i] = b[FORCE + i]
            substitute(b)  # the factors are those of the inertia, up to terms of order h squared
            _hold_joints(m, d, o, body, start[tree], length[tree], lever, b, passive)


@njit
def move_to_middle(m: int, d: int, o: Ints64) -> None:
    """Move free bodies by half a step, before MuJoCo's step, which evaluates forces there."""
    _move_half_step(m, d, o, 1.0)


@njit
def move_to_end(m: int, d: int, o: Ints64) -> None:
    """Move free bodies from the middle of a step to its end, after MuJoCo's step.

    MuJoCo's own motion by a whole step is undone. The change of velocity by contacts and other
    constraints has a fixed direction in the world: it does not rotate with the body.
    """
    _move_half_step(m, d, o, -1.0)


@njit
def _move_half_step(m: int, d: int, o: Ints64, sign: float) -> None:
    """Move free bodies by half a step with their twist, whose linear part rotates with the body.

    Args:
        m: the address of the model.
        d: the address of the data.
        o: the offsets of the fields.
        sign: 1 for the move before MuJoCo's step, -1 for the move after it.
    """
    if read_int32(m + o[f.INTEGRATOR]) == _RK4:
        return
    n, nbody = read_int64(m + o[f.NTREE]), read_int64(m + o[f.NBODY])
    h = read_double(m + o[f.TIMESTEP])
    roots = view_int32s(read_int64(m + o[f.TREE_BODY]), n)
    n_joints = view_int32s(read_int64(m + o[f.BODY_JNTNUM]), nbody)
    n_dofs = view_int32s(read_int64(m + o[f.BODY_DOFNUM]), nbody)
    start = view_int32s(read_int64(m + o[f.TREE_DOFADR]), n)
    is_awake = view_int32s(read_int64(d + o[f.TREE_AWAKE]), n)
    for tree in range(n):
        body = roots[tree]
        if n_joints[body] != 1 or n_dofs[body] != 6 or is_awake[tree] == 0:
            continue
        kind = read_double(read_int64(m + o[f.BODY_USER]) + 8 * (BODY_COLUMNS * body + KIND))
        if kind == DRY_BODY:
            continue
        v = view_doubles(read_int64(d + o[f.QVEL]) + 8 * start[tree], 6)
        joint = read_int32(read_int64(m + o[f.BODY_JNTADR]) + 4 * body)
        address = read_int32(read_int64(m + o[f.JNT_QPOSADR]) + 4 * joint)
        q = view_doubles(read_int64(d + o[f.QPOS]) + 8 * address, 7)
        water = view_doubles(read_int64(d + o[f.USERDATA]) + 8 * WATER_COLUMNS * body, 6)
        to_middle = 0.5 * h if sign > 0.0 else -h  # the time from the velocity to the middle [s]
        dof = 8 * start[tree]
        qacc, qacc_smooth = (
            view_doubles(read_int64(d + o[f.QACC]) + dof, 3),
            view_doubles(read_int64(d + o[f.QACC_SMOOTH]) + dof, 3),
        )
        contact_time = h if sign < 0.0 and read_int32(d + o[f.N_ROWS]) > 0 else 0.0
        jx = contact_time * (qacc[0] - qacc_smooth[0])
        jy = contact_time * (qacc[1] - qacc_smooth[1])
        jz = contact_time * (qacc[2] - qacc_smooth[2])
        for i in range(3):
            q[i] += 0.5 * h * v[i] if sign > 0.0 else -h * v[i]
        if contact_time > 0.0:
            v[0], v[1], v[2] = v[0] - jx, v[1] - jy, v[2] - jz
        rotate_velocity(v, q, water, 0.5 * h * sign, to_middle)
        if contact_time > 0.0:
            v[0], v[1], v[2] = v[0] + jx, v[1] + jy, v[2] + jz
        if sign < 0.0:
            for i in range(3):
                q[i] += 0.5 * h * v[i]
        rotate_attitude(q, v, 0.5 * h * sign)


@njit
def _fill_numbers(
    m: int, d: int, o: Ints64, work: Floats, body: int, b: Floats
) -> tuple[float, float, float]:
    """Fill in the twist, momentum and force of one tree for `midpoint`, and return a lever.

    The numbers are in world axes, about the centre of mass of the tree, and relative to the water
    at its root body, which counts as uniform. The lever is the vector from the centre of mass to
    the origin of the root body, in world axes [m].
    """
    base = f.ROW * body
    twist = view_doubles(read_int64(d + o[f.CVEL]) + 48 * body, 6)
    water = view_doubles(read_int64(d + o[f.USERDATA]) + 8 * WATER_COLUMNS * body, 6)
    position = view_doubles(read_int64(d + o[f.XPOS]) + 24 * body, 3)
    com = view_doubles(read_int64(d + o[f.COM]) + 24 * body, 3)
    lever = (position[0] - com[0], position[1] - com[1], position[2] - com[2])
    fill_motion(twist, water, lever, work, base, b)
    return lever


@njit
def _add_rigid(m: int, d: int, o: Ints64, work: Floats, root: int, n: int, b: Floats) -> None:
    """Add the momentum, the weight and the gyroscopic forces of the n rigid bodies of a tree."""
    inertias = view_doubles(read_int64(d + o[f.CINERT]) + 80 * root, 10 * n)
    twists = view_doubles(read_int64(d + o[f.CVEL]) + 48 * root, 6 * n)
    gravity = view_doubles(m + o[f.GRAVITY], 3)
    scale = 0.0 if (read_int32(m + o[f.DISABLE]) & _GRAVITY_OFF) != 0 else 1.0
    # the velocity of the water at the base
    speed = (twists[3] - b[TWIST + 3], twists[4] - b[TWIST + 4], twists[5] - b[TWIST + 5])
    weight = (scale * gravity[0], scale * gravity[1], scale * gravity[2])
    for i in range(n):
        bias = read_six(work, f.ROW * (root + i) + f.BIAS)
        row = inertias[10 * i : 10 * i + 10]
        add_rigid_body(row, read_six(twists, 6 * i), bias, weight, speed, b)


@njit
def _add_applied(m: int, d: int, o: Ints64, body: int, dof: int, lever: Three, b: Floats) -> None:
    """Add ``qfrc_applied`` of the six degrees of freedom of the root body to the force."""
    force = view_doubles(read_int64(d + o[f.APPLIED]) + 8 * dof, 6)
    axes = view_doubles(read_int64(d + o[f.XMAT]) + 72 * body, 9)
    rx, ry, rz = lever
    for i in range(3):
        b[FORCE + i] += (
            axes[3 * i] * force[3] + axes[3 * i + 1] * force[4] + axes[3 * i + 2] * force[5]
        )
        b[FORCE + 3 + i] += force[i]
    b[FORCE] += ry * force[2] - rz * force[1]
    b[FORCE + 1] += rz * force[0] - rx * force[2]
    b[FORCE + 2] += rx * force[1] - ry * force[0]


@njit
def _fill_inertia(m: int, d: int, o: Ints64, work: Floats, tree: int, b: Floats) -> None:
    """Fill in the inertia of water and rigid bodies of a tree, without and with implicit drag."""
    body = view_int32s(read_int64(m + o[f.TREE_BODY]), tree + 1)[tree]
    crb = view_doubles(read_int64(d + o[f.CRB]) + 80 * body, 10)
    scratch = f.ROW * read_int64(m + o[f.NBODY]) + f.SCRATCH
    fill_inertia(crb, work, f.ROW * body + f.FF, scratch + f.DRAG * tree, b)


@njit
def _convert_to_wrench(lever: Three, h: float, b: Floats) -> None:
    """Write the additional wrench that gives the solved rate into ``FORCE``."""
    convert_rate(lever, h, b)
    multiply(b, SUM, RATE, CORRECTION)
    for i in range(6):
        b[FORCE + i] = b[CORRECTION + i] - b[FORCE + i]


@njit
def _hold_joints(
    m: int, d: int, o: Ints64, body: int, start: int, length: int, lever: Three, b: Floats,
    passive: Floats,
) -> None:  # fmt: skip
    """Add forces on the joints of a tree, which the additional wrench would else accelerate."""
    rx, ry, rz = lever
    axes = view_doubles(read_int64(d + o[f.XMAT]) + 72 * body, 9)
    x, y, z = b[CORRECTION], b[CORRECTION + 1], b[CORRECTION + 2]
    a0 = b[CORRECTION + 3] + y * rz - z * ry
    a1 = b[CORRECTION + 4] + z * rx - x * rz
    a2 = b[CORRECTION + 5] + x * ry - y * rx
    a3, a4, a5 = to_body(axes, x, y, z)
    rows = view_int32s(read_int64(m + o[f.ROW_START]) + 4 * start, length)
    for k in range(6, length):
        row = view_doubles(read_int64(d + o[f.M]) + 8 * rows[k], 6)
        passive[start + k] += (
            row[0] * a0 + row[1] * a1 + row[2] * a2 + row[3] * a3 + row[4] * a4 + row[5] * a5
        )
