"""Energy-conserving step of free bodies in water: `midpoint` on MuJoCo's memory.

What MuJoCo solves is explicit. A force on the six degrees of freedom of a tree of bodies turns its
answer into that of the midpoint rule, and one on every joint leaves the joints alone. It is 0
for what does not turn, and vanishes with the length of a step.
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
from ..columns import BODY_COLUMNS, DRY, KIND, WATER_COLUMNS
from . import fields as f
from .equations import Six, Three, to_body
from .midpoint import (
    INERTIA,
    MOMENTUM,
    NUMBERS,
    RATE,
    SIDE,
    STEP,
    SUM,
    TWIST,
    multiply,
    solve_rate,
    substitute,
    turn_rate,
)

_IMPLICITFAST = 3  # mjINT_IMPLICITFAST
_RK4 = 1  # mjINT_RK4
_GRAVITY_OFF = 128  # mjDSBL_GRAVITY


@njit
def keep_energy(m: int, d: int, at: Ints64, work: Floats) -> None:
    """Take the Coriolis terms of every free body in water to the middle of the step.

    Args:
        m: address of the model.
        d: address of the data, whose ``M`` and ``qfrc_passive`` have their water.
        at: offsets of the fields.
        work: the rows of the bodies, summed up the trees.
    """
    n, nbody, nv = (
        read_int64(m + at[f.NTREE]),
        read_int64(m + at[f.NBODY]),
        read_int64(m + at[f.NV]),
    )
    h = read_double(m + at[f.TIMESTEP])
    first = view_int32s(read_int64(m + at[f.TREE_BODY]), n)
    n_bodies = view_int32s(read_int64(m + at[f.TREE_BODYNUM]), n)
    awake = view_int32s(read_int64(d + at[f.AWAKE]), n)
    n_joints = view_int32s(read_int64(m + at[f.BODY_JNTNUM]), nbody)
    n_dofs = view_int32s(read_int64(m + at[f.BODY_DOFNUM]), nbody)
    start = view_int32s(read_int64(m + at[f.TREE_DOFADR]), n)
    length = view_int32s(read_int64(m + at[f.TREE_DOFNUM]), n)
    passive = view_doubles(read_int64(d + at[f.PASSIVE]), nv)
    is_gyroscopic = read_int32(m + at[f.INTEGRATOR]) == _IMPLICITFAST
    b = np.empty(NUMBERS)
    for tree in range(n):
        body = first[tree]
        is_free = n_joints[body] == 1 and n_dofs[body] == 6
        if not is_free or awake[tree] == 0 or work[f.ROW * body + f.TOUCHED] == 0.0:
            continue
        _inertia(m, d, at, work, tree, b)
        lever = _gather(m, d, at, work, body, b)
        _rigid(m, d, at, work, body, n_bodies[tree], b)
        _applied(m, d, at, body, start[tree], lever, b)
        solve_rate(b, h)
        _bring_to_force(lever, h, b)
        if is_gyroscopic and length[tree] == 6:
            _undo_gyroscopic(view_doubles(read_int64(d + at[f.CRB]) + 80 * body, 10), lever, h, b)
        cdof = view_doubles(read_int64(d + at[f.CDOF]) + 48 * start[tree], 36)
        for k in range(6):
            for i in range(6):
                passive[start[tree] + k] += cdof[6 * k + i] * b[SIDE + i]
        if length[tree] > 6:
            for i in range(6):
                b[STEP + i] = b[SIDE + i]
            substitute(b)  # for the inertia alone, but for what vanishes with the step squared
            _hold_joints(m, d, at, body, start[tree], length[tree], lever, b, passive)


@njit
def to_the_middle(m: int, d: int, at: Ints64) -> None:
    """Carry free bodies half a step along, before MuJoCo's step: forces act on them there."""
    _half_a_step(m, d, at, 1.0)


@njit
def to_the_end(m: int, d: int, at: Ints64) -> None:
    """Carry free bodies from the middle of a step to its end, after MuJoCo's step.

    MuJoCo has carried them a whole one, which is taken back. What contacts and other constraints
    add to a velocity has the direction that it has in the world, and does not turn with the body.
    """
    _half_a_step(m, d, at, -1.0)


@njit
def _half_a_step(m: int, d: int, at: Ints64, sign: float) -> None:
    """Half a step at a free body's own twist, whose linear part turns with the body."""
    if read_int32(m + at[f.INTEGRATOR]) == _RK4:
        return
    n, nbody = read_int64(m + at[f.NTREE]), read_int64(m + at[f.NBODY])
    h = read_double(m + at[f.TIMESTEP])
    first = view_int32s(read_int64(m + at[f.TREE_BODY]), n)
    n_joints = view_int32s(read_int64(m + at[f.BODY_JNTNUM]), nbody)
    n_dofs = view_int32s(read_int64(m + at[f.BODY_DOFNUM]), nbody)
    start = view_int32s(read_int64(m + at[f.TREE_DOFADR]), n)
    awake = view_int32s(read_int64(d + at[f.AWAKE]), n)
    for tree in range(n):
        body = first[tree]
        if n_joints[body] != 1 or n_dofs[body] != 6 or awake[tree] == 0:
            continue
        if read_double(read_int64(m + at[f.BODY_USER]) + 8 * (BODY_COLUMNS * body + KIND)) == DRY:
            continue
        v = view_doubles(read_int64(d + at[f.QVEL]) + 8 * start[tree], 6)
        joint = read_int32(read_int64(m + at[f.BODY_JNTADR]) + 4 * body)
        address = read_int32(read_int64(m + at[f.JNT_QPOSADR]) + 4 * joint)
        q = view_doubles(read_int64(d + at[f.QPOS]) + 8 * address, 7)
        water = view_doubles(read_int64(d + at[f.USERDATA]) + 8 * WATER_COLUMNS * body, 6)
        before = 0.5 * h if sign > 0.0 else -h  # when the water is what the velocity is turned in
        dof = 8 * start[tree]
        all_in, without = (
            view_doubles(read_int64(d + at[f.ACCELERATION]) + dof, 3),
            view_doubles(read_int64(d + at[f.UNCONSTRAINED]) + dof, 3),
        )
        pushed = h if sign < 0.0 and read_int32(d + at[f.N_ROWS]) > 0 else 0.0
        jx = pushed * (all_in[0] - without[0])
        jy = pushed * (all_in[1] - without[1])
        jz = pushed * (all_in[2] - without[2])
        for i in range(3):
            q[i] += 0.5 * h * v[i] if sign > 0.0 else -h * v[i]
        if pushed > 0.0:
            v[0], v[1], v[2] = v[0] - jx, v[1] - jy, v[2] - jz
        _turn_velocity(v, q, water, 0.5 * h * sign, before)
        if pushed > 0.0:
            v[0], v[1], v[2] = v[0] + jx, v[1] + jy, v[2] + jz
        if sign < 0.0:
            for i in range(3):
                q[i] += 0.5 * h * v[i]
        _turn_attitude(q, v, 0.5 * h * sign)


@njit
def _turn_velocity(v: Floats, q: Floats, water: Floats, time: float, before: float) -> None:
    """Turn the velocity relative to the water along with the body for a time.

    Args:
        v: linear velocity in world axes, angular velocity in the body's, (6,).
        q: position, then attitude wxyz, (7,).
        water: its velocity in the middle of the step, and its acceleration.
        time: how long; below 0 it is turned back.
        before: from the velocity that is given to the middle of the step.
    """
    wx, wy, wz = _by_quaternion(q, v[3], v[4], v[5])
    rx = v[0] - water[0] + before * water[3]
    ry = v[1] - water[1] + before * water[4]
    rz = v[2] - water[2] + before * water[5]
    x, y, z = turn_rate(wx, wy, wz, rx, ry, rz, time)
    after = before - time
    v[0] = rx + time * x + water[0] - after * water[3]
    v[1] = ry + time * y + water[1] - after * water[4]
    v[2] = rz + time * z + water[2] - after * water[5]


@njit
def _by_quaternion(q: Floats, x: float, y: float, z: float) -> Three:
    """Turn a vector of the body into the axes of the world."""
    n, a, b, c = q[3], q[4], q[5], q[6]
    tx, ty, tz = 2.0 * (b * z - c * y), 2.0 * (c * x - a * z), 2.0 * (a * y - b * x)
    return (
        x + n * tx + b * tz - c * ty,
        y + n * ty + c * tx - a * tz,
        z + n * tz + a * ty - b * tx,
    )


@njit
def _turn_attitude(q: Floats, v: Floats, time: float) -> None:
    """Turn the attitude at the angular velocity for a time."""
    half2 = 0.25 * time * time * (v[3] * v[3] + v[4] * v[4] + v[5] * v[5])
    if half2 < 1e-4:  # the series are exact to the last digit
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
def _gather(
    m: int, d: int, at: Ints64, work: Floats, body: int, b: Floats
) -> tuple[float, float, float]:
    """Fill in the numbers of one body with all that hangs on it, held; return a lever.

    All is in the axes of the world about the centre of mass of the whole, and relative to the
    water at its base, which counts as one all round. The lever leads to the body's origin [m].
    """
    base = f.ROW * body
    twist = view_doubles(read_int64(d + at[f.CVEL]) + 48 * body, 6)
    water = view_doubles(read_int64(d + at[f.USERDATA]) + 8 * WATER_COLUMNS * body, 6)
    place = view_doubles(read_int64(d + at[f.XPOS]) + 24 * body, 3)
    com = view_doubles(read_int64(d + at[f.COM]) + 24 * body, 3)
    rx, ry, rz = place[0] - com[0], place[1] - com[1], place[2] - com[2]
    for i in range(3):
        b[TWIST + i] = twist[i]
        b[TWIST + 3 + i] = twist[3 + i] - water[i]
    for i in range(6):
        b[MOMENTUM + i] = work[base + f.MOMENTUM + i]
    wx, wy, wz = twist[0], twist[1], twist[2]
    # the rate of the relative twist in the body's axes when no degree of freedom accelerates
    ux = b[TWIST + 3] + wy * rz - wz * ry
    uy = b[TWIST + 4] + wz * rx - wx * rz
    uz = b[TWIST + 5] + wx * ry - wy * rx
    for i in range(3):
        b[RATE + i] = 0.0
    b[RATE + 3] = uy * wz - uz * wy - water[3]
    b[RATE + 4] = uz * wx - ux * wz - water[4]
    b[RATE + 5] = ux * wy - uy * wx - water[5]
    multiply(b, SUM, RATE, SIDE)
    for i in range(6):
        b[SIDE + i] += work[base + f.WRENCH + i]
    return rx, ry, rz


@njit
def _rigid(m: int, d: int, at: Ints64, work: Floats, first: int, n: int, b: Floats) -> None:
    """Add the momentum of the rigid bodies of a tree, their weight, and what turns them."""
    inertias = view_doubles(read_int64(d + at[f.CINERT]) + 80 * first, 10 * n)
    twists = view_doubles(read_int64(d + at[f.CVEL]) + 48 * first, 6 * n)
    gravity = view_doubles(m + at[f.GRAVITY], 3)
    weight = 0.0 if (read_int32(m + at[f.DISABLE]) & _GRAVITY_OFF) != 0 else 1.0
    # what the water at the base moves with
    sx, sy, sz = twists[3] - b[TWIST + 3], twists[4] - b[TWIST + 4], twists[5] - b[TWIST + 5]
    for i in range(n):
        own = inertias[10 * i : 10 * i + 10]
        t = 6 * i
        wx, wy, wz = twists[t], twists[t + 1], twists[t + 2]
        vx, vy, vz = twists[t + 3], twists[t + 4], twists[t + 5]
        hx, hy, hz, px, py, pz = _momentum(own, wx, wy, wz, vx, vy, vz)
        bias = f.ROW * (first + i) + f.BIAS
        ax, ay, az, fx, fy, fz = _momentum(
            own, work[bias], work[bias + 1], work[bias + 2],
            work[bias + 3] - weight * gravity[0], work[bias + 4] - weight * gravity[1],
            work[bias + 5] - weight * gravity[2],
        )  # fmt: skip
        b[SIDE] -= ax + wy * hz - wz * hy + vy * pz - vz * py
        b[SIDE + 1] -= ay + wz * hx - wx * hz + vz * px - vx * pz
        b[SIDE + 2] -= az + wx * hy - wy * hx + vx * py - vy * px
        b[SIDE + 3] -= fx + wy * pz - wz * py
        b[SIDE + 4] -= fy + wz * px - wx * pz
        b[SIDE + 5] -= fz + wx * py - wy * px
        mass, cx, cy, cz = own[9], own[6], own[7], own[8]
        b[MOMENTUM] += hx - cy * sz + cz * sy
        b[MOMENTUM + 1] += hy - cz * sx + cx * sz
        b[MOMENTUM + 2] += hz - cx * sy + cy * sx
        b[MOMENTUM + 3] += px - mass * sx
        b[MOMENTUM + 4] += py - mass * sy
        b[MOMENTUM + 5] += pz - mass * sz


@njit
def _momentum(own: Floats, wx: float, wy: float, wz: float, vx: float, vy: float, vz: float) -> Six:
    """Momentum of a rigid body: rotational part first."""
    cx, cy, cz, mass = own[6], own[7], own[8], own[9]
    hx, hy, hz = _turned_inertia(own, wx, wy, wz)
    return (
        hx + cy * vz - cz * vy,
        hy + cz * vx - cx * vz,
        hz + cx * vy - cy * vx,
        mass * vx + wy * cz - wz * cy,
        mass * vy + wz * cx - wx * cz,
        mass * vz + wx * cy - wy * cx,
    )


@njit
def _applied(m: int, d: int, at: Ints64, body: int, dof: int, lever: Three, b: Floats) -> None:
    """Add ``qfrc_applied`` of the six degrees of freedom."""
    force = view_doubles(read_int64(d + at[f.APPLIED]) + 8 * dof, 6)
    axes = view_doubles(read_int64(d + at[f.XMAT]) + 72 * body, 9)
    rx, ry, rz = lever
    for i in range(3):
        b[SIDE + i] += (
            axes[3 * i] * force[3] + axes[3 * i + 1] * force[4] + axes[3 * i + 2] * force[5]
        )
        b[SIDE + 3 + i] += force[i]
    b[SIDE] += ry * force[2] - rz * force[1]
    b[SIDE + 1] += rz * force[0] - rx * force[2]
    b[SIDE + 2] += rx * force[1] - ry * force[0]


@njit
def _inertia(m: int, d: int, at: Ints64, work: Floats, tree: int, b: Floats) -> None:
    """The inertia of water and rigid bodies of a tree, with and without implicit drag."""
    body = view_int32s(read_int64(m + at[f.TREE_BODY]), tree + 1)[tree]
    rigid = view_doubles(read_int64(d + at[f.CRB]) + 80 * body, 10)
    _unpack(work, f.ROW * body + f.FF, b, SUM)
    b[SUM] += rigid[0]
    b[SUM + 1] += rigid[3]
    b[SUM + 2] += rigid[4]
    b[SUM + 7] += rigid[1]
    b[SUM + 8] += rigid[5]
    b[SUM + 14] += rigid[2]
    for i in range(21, 36, 7):
        b[SUM + i] += rigid[9]
    behind = f.ROW * read_int64(m + at[f.NBODY]) + f.SCRATCH
    _unpack(work, behind + f.DRAG * tree, b, INERTIA)
    for i in range(6):
        for j in range(i, 6):
            b[INERTIA + 6 * i + j] = b[SUM + 6 * i + j] - b[INERTIA + 6 * i + j]
            b[INERTIA + 6 * j + i] = b[INERTIA + 6 * i + j]
            b[SUM + 6 * j + i] = b[SUM + 6 * i + j]


@njit
def _unpack(work: Floats, ff: int, b: Floats, to: int) -> None:
    """The 21 numbers of an inertia, from ``ff`` on, to their places on and above the diagonal.

    Rotational part first.
    """
    ft, tt = ff + f.FT - f.FF, ff + f.TT - f.FF
    b[to], b[to + 1], b[to + 2] = work[tt], work[tt + 1], work[tt + 2]
    b[to + 7], b[to + 8], b[to + 14] = work[tt + 3], work[tt + 4], work[tt + 5]
    b[to + 21], b[to + 22], b[to + 23] = work[ff], work[ff + 1], work[ff + 2]
    b[to + 28], b[to + 29], b[to + 35] = work[ff + 3], work[ff + 4], work[ff + 5]
    for i in range(3):
        for j in range(3):
            b[to + 6 * j + 3 + i] = work[ft + 3 * i + j]


@njit
def _bring_to_force(lever: Three, h: float, b: Floats) -> None:
    """Turn the rate over the step into the wrench that is missing for it, in ``SIDE``.

    The new twist is in the axes that the body has after the step, and MuJoCo's in the world's.
    """
    rx, ry, rz = lever
    wx, wy, wz = b[TWIST], b[TWIST + 1], b[TWIST + 2]
    ax, ay, az = b[RATE], b[RATE + 1], b[RATE + 2]
    ux, uy, uz = (
        b[TWIST + 3] + wy * rz - wz * ry,
        b[TWIST + 4] + wz * rx - wx * rz,
        b[TWIST + 5] + wx * ry - wy * rx,
    )
    ex, ey, ez = turn_rate(
        wx + h * ax, wy + h * ay, wz + h * az,
        ux + h * (b[RATE + 3] + ay * rz - az * ry),
        uy + h * (b[RATE + 4] + az * rx - ax * rz),
        uz + h * (b[RATE + 5] + ax * ry - ay * rx),
        h,
    )  # fmt: skip
    b[RATE + 3] += ex - (wy * uz - wz * uy)
    b[RATE + 4] += ey - (wz * ux - wx * uz)
    b[RATE + 5] += ez - (wx * uy - wy * ux)
    multiply(b, SUM, RATE, STEP)
    for i in range(6):
        b[SIDE + i] = b[STEP + i] - b[SIDE + i]


@njit
def _undo_gyroscopic(rigid: Floats, lever: Three, h: float, b: Floats) -> None:
    r"""Take back what ``implicitfast`` does by itself for a free body without joints.

    It solves :math:`(M - hD)\dot v = f` with the derivative D of the gyroscopic forces of the
    rigid body: implicit Euler, which takes energy away.
    """
    rx, ry, rz = lever
    wx, wy, wz = b[TWIST], b[TWIST + 1], b[TWIST + 2]
    ax, ay, az = b[RATE], b[RATE + 1], b[RATE + 2]
    hx, hy, hz = _turned_inertia(rigid, wx, wy, wz)
    gx, gy, gz = _turned_inertia(rigid, ax, ay, az)
    b[SIDE] += h * (ay * hz - az * hy + wy * gz - wz * gy)
    b[SIDE + 1] += h * (az * hx - ax * hz + wz * gx - wx * gz)
    b[SIDE + 2] += h * (ax * hy - ay * hx + wx * gy - wy * gx)
    # the centre of mass lies at -lever from the origin, to which the velocity belongs
    vx, vy, vz = wz * ry - wy * rz, wx * rz - wz * rx, wy * rx - wx * ry
    ux, uy, uz = az * ry - ay * rz, ax * rz - az * rx, ay * rx - ax * ry
    b[SIDE + 3] += h * rigid[9] * (ay * vz - az * vy + wy * uz - wz * uy)
    b[SIDE + 4] += h * rigid[9] * (az * vx - ax * vz + wz * ux - wx * uz)
    b[SIDE + 5] += h * rigid[9] * (ax * vy - ay * vx + wx * uy - wy * ux)


@njit
def _turned_inertia(rigid: Floats, x: float, y: float, z: float) -> Three:
    """Rotational inertia of a composite rigid body times a vector."""
    return (
        rigid[0] * x + rigid[3] * y + rigid[4] * z,
        rigid[3] * x + rigid[1] * y + rigid[5] * z,
        rigid[4] * x + rigid[5] * y + rigid[2] * z,
    )


@njit
def _hold_joints(
    m: int, d: int, at: Ints64, body: int, start: int, length: int, lever: Three, b: Floats,
    passive: Floats,
) -> None:  # fmt: skip
    """Apply the additional acceleration to the joints, so that they do not move by it."""
    rx, ry, rz = lever
    axes = view_doubles(read_int64(d + at[f.XMAT]) + 72 * body, 9)
    x, y, z = b[STEP], b[STEP + 1], b[STEP + 2]
    a0 = b[STEP + 3] + y * rz - z * ry
    a1 = b[STEP + 4] + z * rx - x * rz
    a2 = b[STEP + 5] + x * ry - y * rx
    a3, a4, a5 = to_body(axes, x, y, z)
    rows = view_int32s(read_int64(m + at[f.ROW_START]) + 4 * start, length)
    for k in range(6, length):
        row = view_doubles(read_int64(d + at[f.M]) + 8 * rows[k], 6)
        passive[start + k] += (
            row[0] * a0 + row[1] * a1 + row[2] * a2 + row[3] * a3 + row[4] * a4 + row[5] * a5
        )
