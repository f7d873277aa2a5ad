"""The energy-conserving step of free bodies in water: `midpoint` applied to MuJoCo's memory.

MuJoCo evaluates Coriolis forces explicitly. A force on the six degrees of freedom of a free body is
added, which changes MuJoCo's solution to that of the midpoint rule. Forces on the joints of the
body keep their accelerations unchanged. These forces are 0 for bodies that do not rotate, and
vanish with the length of a step.
"""

from __future__ import annotations

import math

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
from .equations import Six, Three, to_body
from .midpoint import (
    CORRECTION,
    FORCE,
    INERTIA,
    MOMENTUM,
    NUMBERS,
    RATE,
    SUM,
    TWIST,
    multiply,
    rotation_rate,
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
            _undo_gyroscopic(view_doubles(read_int64(d + o[f.CRB]) + 80 * body, 10), lever, h, b)
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
        _rotate_velocity(v, q, water, 0.5 * h * sign, to_middle)
        if contact_time > 0.0:
            v[0], v[1], v[2] = v[0] + jx, v[1] + jy, v[2] + jz
        if sign < 0.0:
            for i in range(3):
                q[i] += 0.5 * h * v[i]
        _rotate_attitude(q, v, 0.5 * h * sign)


@njit
def _rotate_velocity(v: Floats, q: Floats, water: Floats, time: float, to_middle: float) -> None:
    """Rotate the linear velocity relative to the water with the body for a time.

    Args:
        v: the linear velocity in world axes, which is changed, and the angular velocity in body
            axes, (6,) [m/s, rad/s].
        q: the position, then the attitude (wxyz), (7,).
        water: the velocity [m/s] and the acceleration [m/s2] of the water in the middle of the
            step, in world axes, (6,).
        time: the time [s]; negative to rotate backwards.
        to_middle: the time from this velocity to the middle of the step [s].
    """
    wx, wy, wz = _rotate_to_world(q, v[3], v[4], v[5])
    rx = v[0] - water[0] + to_middle * water[3]
    ry = v[1] - water[1] + to_middle * water[4]
    rz = v[2] - water[2] + to_middle * water[5]
    x, y, z = rotation_rate(wx, wy, wz, rx, ry, rz, time)
    t_after = to_middle - time
    v[0] = rx + time * x + water[0] - t_after * water[3]
    v[1] = ry + time * y + water[1] - t_after * water[4]
    v[2] = rz + time * z + water[2] - t_after * water[5]


@njit
def _rotate_to_world(q: Floats, x: float, y: float, z: float) -> Three:
    """Rotate a vector from body axes to world axes by the quaternion in q."""
    n, a, b, c = q[3], q[4], q[5], q[6]
    tx, ty, tz = 2.0 * (b * z - c * y), 2.0 * (c * x - a * z), 2.0 * (a * y - b * x)
    return (
        x + n * tx + b * tz - c * ty,
        y + n * ty + c * tx - a * tz,
        z + n * tz + a * ty - b * tx,
    )


@njit
def _rotate_attitude(q: Floats, v: Floats, time: float) -> None:
    """Rotate the attitude in q with the angular velocity in v for a time [s]."""
    half2 = 0.25 * time * time * (v[3] * v[3] + v[4] * v[4] + v[5] * v[5])
    if half2 < 1e-4:  # the truncated series are exact in double precision
        n = 1.0 - half2 * (0.5 - half2 * (1.0 / 24.0 - half2 / 720.0))
        share = 0.5 * time * (1.0 - half2 * (1.0 / 6.0 - half2 * (1.0 / 120.0 - half2 / 5040.0)))
    else:
        half = math.sqrt(half2)
        n, share = math.cos(half), 0.5 * time * math.sin(half) / half
    a, b, c = share * v[3], share * v[4], share * v[5]
    w, x, y, z = q[3], q[4], q[5], q[6]
    q[3] = w * n - x * a - y * b - z * c
    q[4] = w * a + x * n + y * c - z * b
    q[5] = w * b + y * n + z * a - x * c
    q[6] = w * c + z * n + x * b - y * a
    inverse = 1.0 / math.sqrt(q[3] * q[3] + q[4] * q[4] + q[5] * q[5] + q[6] * q[6])
    for i in range(3, 7):
        q[i] *= inverse


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
    rx, ry, rz = position[0] - com[0], position[1] - com[1], position[2] - com[2]
    for i in range(3):
        b[TWIST + i] = twist[i]
        b[TWIST + 3 + i] = twist[3 + i] - water[i]
    for i in range(6):
        b[MOMENTUM + i] = work[base + f.MOMENTUM + i]
    wx, wy, wz = twist[0], twist[1], twist[2]
    # the rate of the relative twist in body axes if no degree of freedom accelerates
    ux = b[TWIST + 3] + wy * rz - wz * ry
    uy = b[TWIST + 4] + wz * rx - wx * rz
    uz = b[TWIST + 5] + wx * ry - wy * rx
    for i in range(3):
        b[RATE + i] = 0.0
    b[RATE + 3] = uy * wz - uz * wy - water[3]
    b[RATE + 4] = uz * wx - ux * wz - water[4]
    b[RATE + 5] = ux * wy - uy * wx - water[5]
    multiply(b, SUM, RATE, FORCE)
    for i in range(6):
        b[FORCE + i] += work[base + f.WRENCH + i]
    return rx, ry, rz


@njit
def _add_rigid(m: int, d: int, o: Ints64, work: Floats, root: int, n: int, b: Floats) -> None:
    """Add the momentum, the weight and the gyroscopic forces of the n rigid bodies of a tree."""
    inertias = view_doubles(read_int64(d + o[f.CINERT]) + 80 * root, 10 * n)
    twists = view_doubles(read_int64(d + o[f.CVEL]) + 48 * root, 6 * n)
    gravity = view_doubles(m + o[f.GRAVITY], 3)
    scale = 0.0 if (read_int32(m + o[f.DISABLE]) & _GRAVITY_OFF) != 0 else 1.0
    # the velocity of the water at the base
    sx, sy, sz = twists[3] - b[TWIST + 3], twists[4] - b[TWIST + 4], twists[5] - b[TWIST + 5]
    for i in range(n):
        row = inertias[10 * i : 10 * i + 10]
        t = 6 * i
        wx, wy, wz = twists[t], twists[t + 1], twists[t + 2]
        vx, vy, vz = twists[t + 3], twists[t + 4], twists[t + 5]
        hx, hy, hz, px, py, pz = _momentum(row, wx, wy, wz, vx, vy, vz)
        bias = f.ROW * (root + i) + f.BIAS
        ax, ay, az, fx, fy, fz = _momentum(
            row, work[bias], work[bias + 1], work[bias + 2],
            work[bias + 3] - scale * gravity[0], work[bias + 4] - scale * gravity[1],
            work[bias + 5] - scale * gravity[2],
        )  # fmt: skip
        b[FORCE] -= ax + wy * hz - wz * hy + vy * pz - vz * py
        b[FORCE + 1] -= ay + wz * hx - wx * hz + vz * px - vx * pz
        b[FORCE + 2] -= az + wx * hy - wy * hx + vx * py - vy * px
        b[FORCE + 3] -= fx + wy * pz - wz * py
        b[FORCE + 4] -= fy + wz * px - wx * pz
        b[FORCE + 5] -= fz + wx * py - wy * px
        mass, cx, cy, cz = row[9], row[6], row[7], row[8]
        b[MOMENTUM] += hx - cy * sz + cz * sy
        b[MOMENTUM + 1] += hy - cz * sx + cx * sz
        b[MOMENTUM + 2] += hz - cx * sy + cy * sx
        b[MOMENTUM + 3] += px - mass * sx
        b[MOMENTUM + 4] += py - mass * sy
        b[MOMENTUM + 5] += pz - mass * sz


@njit
def _momentum(row: Floats, wx: float, wy: float, wz: float, vx: float, vy: float, vz: float) -> Six:
    """Return the momentum of a rigid body with a row of ``cinert``, rotational part first."""
    cx, cy, cz, mass = row[6], row[7], row[8], row[9]
    hx, hy, hz = _multiply_inertia(row, wx, wy, wz)
    return (
        hx + cy * vz - cz * vy,
        hy + cz * vx - cx * vz,
        hz + cx * vy - cy * vx,
        mass * vx + wy * cz - wz * cy,
        mass * vy + wz * cx - wx * cz,
        mass * vz + wx * cy - wy * cx,
    )


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
    _unpack_inertia(work, f.ROW * body + f.FF, b, SUM)
    b[SUM] += crb[0]
    b[SUM + 1] += crb[3]
    b[SUM + 2] += crb[4]
    b[SUM + 7] += crb[1]
    b[SUM + 8] += crb[5]
    b[SUM + 14] += crb[2]
    for i in range(21, 36, 7):
        b[SUM + i] += crb[9]
    scratch = f.ROW * read_int64(m + o[f.NBODY]) + f.SCRATCH
    _unpack_inertia(work, scratch + f.DRAG * tree, b, INERTIA)
    for i in range(6):
        for j in range(i, 6):
            b[INERTIA + 6 * i + j] = b[SUM + 6 * i + j] - b[INERTIA + 6 * i + j]
            b[INERTIA + 6 * j + i] = b[INERTIA + 6 * i + j]
            b[SUM + 6 * j + i] = b[SUM + 6 * i + j]


@njit
def _unpack_inertia(work: Floats, ff: int, b: Floats, k: int) -> None:
    """Copy an inertia in blocks, from index ``ff`` on, to the upper triangle of a matrix at k.

    The matrix (6, 6) has the rotational part first.
    """
    ft, tt = ff + f.FT - f.FF, ff + f.TT - f.FF
    b[k], b[k + 1], b[k + 2] = work[tt], work[tt + 1], work[tt + 2]
    b[k + 7], b[k + 8], b[k + 14] = work[tt + 3], work[tt + 4], work[tt + 5]
    b[k + 21], b[k + 22], b[k + 23] = work[ff], work[ff + 1], work[ff + 2]
    b[k + 28], b[k + 29], b[k + 35] = work[ff + 3], work[ff + 4], work[ff + 5]
    for i in range(3):
        for j in range(3):
            b[k + 6 * j + 3 + i] = work[ft + 3 * i + j]


@njit
def _convert_to_wrench(lever: Three, h: float, b: Floats) -> None:
    """Write the additional wrench that gives the solved rate into ``FORCE``.

    The rate of `midpoint` is that of the twist in body axes, which rotate in the step; MuJoCo's is
    that of the twist in world axes.
    """
    rx, ry, rz = lever
    wx, wy, wz = b[TWIST], b[TWIST + 1], b[TWIST + 2]
    ax, ay, az = b[RATE], b[RATE + 1], b[RATE + 2]
    ux, uy, uz = (
        b[TWIST + 3] + wy * rz - wz * ry,
        b[TWIST + 4] + wz * rx - wx * rz,
        b[TWIST + 5] + wx * ry - wy * rx,
    )
    ex, ey, ez = rotation_rate(
        wx + h * ax, wy + h * ay, wz + h * az,
        ux + h * (b[RATE + 3] + ay * rz - az * ry),
        uy + h * (b[RATE + 4] + az * rx - ax * rz),
        uz + h * (b[RATE + 5] + ax * ry - ay * rx),
        h,
    )  # fmt: skip
    b[RATE + 3] += ex - (wy * uz - wz * uy)
    b[RATE + 4] += ey - (wz * ux - wx * uz)
    b[RATE + 5] += ez - (wx * uy - wy * ux)
    multiply(b, SUM, RATE, CORRECTION)
    for i in range(6):
        b[FORCE + i] = b[CORRECTION + i] - b[FORCE + i]


@njit
def _undo_gyroscopic(crb: Floats, lever: Three, h: float, b: Floats) -> None:
    r"""Subtract the gyroscopic term that ``implicitfast`` adds for a free body without joints.

    MuJoCo solves :math:`(M - hD)\dot v = f` with the derivative D of the gyroscopic forces of the
    rigid body. This is the implicit Euler method, which loses energy.
    """
    rx, ry, rz = lever
    wx, wy, wz = b[TWIST], b[TWIST + 1], b[TWIST + 2]
    ax, ay, az = b[RATE], b[RATE + 1], b[RATE + 2]
    hx, hy, hz = _multiply_inertia(crb, wx, wy, wz)
    gx, gy, gz = _multiply_inertia(crb, ax, ay, az)
    b[FORCE] += h * (ay * hz - az * hy + wy * gz - wz * gy)
    b[FORCE + 1] += h * (az * hx - ax * hz + wz * gx - wx * gz)
    b[FORCE + 2] += h * (ax * hy - ay * hx + wx * gy - wy * gx)
    # the centre of mass is at -lever from the origin, where the velocity is given
    vx, vy, vz = wz * ry - wy * rz, wx * rz - wz * rx, wy * rx - wx * ry
    ux, uy, uz = az * ry - ay * rz, ax * rz - az * rx, ay * rx - ax * ry
    b[FORCE + 3] += h * crb[9] * (ay * vz - az * vy + wy * uz - wz * uy)
    b[FORCE + 4] += h * crb[9] * (az * vx - ax * vz + wz * ux - wx * uz)
    b[FORCE + 5] += h * crb[9] * (ax * vy - ay * vx + wx * uy - wy * ux)


@njit
def _multiply_inertia(crb: Floats, x: float, y: float, z: float) -> Three:
    """Multiply the rotational inertia of a (composite) rigid body by a vector."""
    return (
        crb[0] * x + crb[3] * y + crb[4] * z,
        crb[3] * x + crb[1] * y + crb[5] * z,
        crb[4] * x + crb[5] * y + crb[2] * z,
    )


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
