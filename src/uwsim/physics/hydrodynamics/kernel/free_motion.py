r"""The motion of a free body in a step, on plain numbers: the parts of the midpoint rule.

`free_bodies` applies these functions to MuJoCo's memory, `free_step` to one row of a batch. A free
body is the root of a tree of bodies. ``b`` is the array of `midpoint` and ``lever`` the vector from
the centre of mass of the tree to the origin of the root, in world axes [m]. A row ``q`` has the
position, then the attitude (wxyz), (7,); a row ``v`` the linear velocity in world axes, then the
angular velocity in body axes, (6,) [m/s, rad/s]. ``crb`` is the row of a rigid body as MuJoCo
stores it: moments of inertia (xx yy zz xy xz yz), mass times centre, mass; in world axes, about the
centre of mass of the tree.
"""

from __future__ import annotations

import math

from ....base.numerics.jit import njit_borrowed
from ....base.numerics.memory import Floats
from . import fields as f
from .equations import Six, Three
from .midpoint import FORCE, INERTIA, MOMENTUM, RATE, SUM, TWIST, multiply, rotation_rate


@njit_borrowed
def rotate_velocity(v: Floats, q: Floats, water: Floats, time: float, to_middle: float) -> None:
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
    wx, wy, wz = rotate_to_world(q, v[3], v[4], v[5])
    rx = v[0] - water[0] + to_middle * water[3]
    ry = v[1] - water[1] + to_middle * water[4]
    rz = v[2] - water[2] + to_middle * water[5]
    x, y, z = rotation_rate(wx, wy, wz, rx, ry, rz, time)
    t_after = to_middle - time
    v[0] = rx + time * x + water[0] - t_after * water[3]
    v[1] = ry + time * y + water[1] - t_after * water[4]
    v[2] = rz + time * z + water[2] - t_after * water[5]


@njit_borrowed
def rotate_to_world(q: Floats, x: float, y: float, z: float) -> Three:
    """Rotate a vector from body axes to world axes by the quaternion in q."""
    n, a, b, c = q[3], q[4], q[5], q[6]
    tx, ty, tz = 2.0 * (b * z - c * y), 2.0 * (c * x - a * z), 2.0 * (a * y - b * x)
    return (
        x + n * tx + b * tz - c * ty,
        y + n * ty + c * tx - a * tz,
        z + n * tz + a * ty - b * tx,
    )


@njit_borrowed
def rotate_attitude(q: Floats, v: Floats, time: float) -> None:
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


@njit_borrowed
def rigid_momentum(
    row: Floats, wx: float, wy: float, wz: float, vx: float, vy: float, vz: float
) -> Six:
    """Return the momentum of a rigid body with a row of ``cinert``, rotational part first."""
    cx, cy, cz, mass = row[6], row[7], row[8], row[9]
    hx, hy, hz = multiply_inertia(row, wx, wy, wz)
    return (
        hx + cy * vz - cz * vy,
        hy + cz * vx - cx * vz,
        hz + cx * vy - cy * vx,
        mass * vx + wy * cz - wz * cy,
        mass * vy + wz * cx - wx * cz,
        mass * vz + wx * cy - wy * cx,
    )


@njit_borrowed
def multiply_inertia(crb: Floats, x: float, y: float, z: float) -> Three:
    """Multiply the rotational inertia of a (composite) rigid body by a vector."""
    return (
        crb[0] * x + crb[3] * y + crb[4] * z,
        crb[3] * x + crb[1] * y + crb[5] * z,
        crb[4] * x + crb[5] * y + crb[2] * z,
    )


@njit_borrowed
def unpack_inertia(work: Floats, ff: int, b: Floats, k: int) -> None:
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


@njit_borrowed
def undo_gyroscopic(crb: Floats, lever: Three, h: float, b: Floats) -> None:
    r"""Subtract the gyroscopic term that ``implicitfast`` adds for a free body without joints.

    MuJoCo solves :math:`(M - hD)\dot v = f` with the derivative D of the gyroscopic forces of the
    rigid body. This is the implicit Euler method, which loses energy.
    """
    rx, ry, rz = lever
    wx, wy, wz = b[TWIST], b[TWIST + 1], b[TWIST + 2]
    ax, ay, az = b[RATE], b[RATE + 1], b[RATE + 2]
    hx, hy, hz = multiply_inertia(crb, wx, wy, wz)
    gx, gy, gz = multiply_inertia(crb, ax, ay, az)
    b[FORCE] += h * (ay * hz - az * hy + wy * gz - wz * gy)
    b[FORCE + 1] += h * (az * hx - ax * hz + wz * gx - wx * gz)
    b[FORCE + 2] += h * (ax * hy - ay * hx + wx * gy - wy * gx)
    # the centre of mass is at -lever from the origin, where the velocity is given
    vx, vy, vz = wz * ry - wy * rz, wx * rz - wz * rx, wy * rx - wx * ry
    ux, uy, uz = az * ry - ay * rz, ax * rz - az * rx, ay * rx - ax * ry
    b[FORCE + 3] += h * crb[9] * (ay * vz - az * vy + wy * uz - wz * uy)
    b[FORCE + 4] += h * crb[9] * (az * vx - ax * vz + wz * ux - wx * uz)
    b[FORCE + 5] += h * crb[9] * (ax * vy - ay * vx + wx * uy - wy * ux)


@njit_borrowed
def fill_motion(
    twist: Floats, water: Floats, lever: Three, work: Floats, base: int, b: Floats
) -> None:
    """Fill in the twist, momentum and force of one tree for `midpoint`, without rigid bodies.

    The numbers are in world axes, about the centre of mass of the tree, and relative to the water
    at its root body, which counts as uniform.

    Args:
        twist: the spatial velocity of the root body.
        water: the velocity [m/s] and acceleration [m/s2] of the water at the root body, (6,).
        lever: the lever of the root body.
        work: the array with wrench and momentum of the tree.
        base: the index of its row.
        b: the array to fill, which has `SUM` already.
    """
    rx, ry, rz = lever
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


@njit_borrowed
def add_rigid_body(
    row: Floats, twist: Six, bias: Six, gravity: Three, speed: Three, b: Floats
) -> None:
    """Add the momentum, the weight and the gyroscopic forces of a rigid body.

    Args:
        row: the row of the rigid body.
        twist: its spatial velocity.
        bias: its spatial acceleration without joint accelerations.
        gravity: the acceleration of gravity [m/s2].
        speed: the velocity of the water at the root body [m/s].
        b: the array to which they are added.
    """
    wx, wy, wz, vx, vy, vz = twist
    sx, sy, sz = speed
    hx, hy, hz, px, py, pz = rigid_momentum(row, wx, wy, wz, vx, vy, vz)
    ax, ay, az, fx, fy, fz = rigid_momentum(
        row, bias[0], bias[1], bias[2],
        bias[3] - gravity[0], bias[4] - gravity[1], bias[5] - gravity[2],
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


@njit_borrowed
def fill_inertia(crb: Floats, work: Floats, ff: int, drag: int, b: Floats) -> None:
    """Fill in the inertia of water and rigid bodies of a tree, without and with implicit drag.

    Args:
        crb: the row of the composite rigid body of the tree.
        work: the array with the inertia of the water in blocks (`fields`).
        ff: the index of the blocks of the water's inertia.
        drag: the index of the blocks of the implicit drag.
        b: the array to fill.
    """
    unpack_inertia(work, ff, b, SUM)
    b[SUM] += crb[0]
    b[SUM + 1] += crb[3]
    b[SUM + 2] += crb[4]
    b[SUM + 7] += crb[1]
    b[SUM + 8] += crb[5]
    b[SUM + 14] += crb[2]
    for i in range(21, 36, 7):
        b[SUM + i] += crb[9]
    unpack_inertia(work, drag, b, INERTIA)
    for i in range(6):
        for j in range(i, 6):
            b[INERTIA + 6 * i + j] = b[SUM + 6 * i + j] - b[INERTIA + 6 * i + j]
            b[INERTIA + 6 * j + i] = b[INERTIA + 6 * i + j]
            b[SUM + 6 * j + i] = b[SUM + 6 * i + j]


@njit_borrowed
def convert_rate(lever: Three, h: float, b: Floats) -> None:
    """Convert the solved rate to that of the twist in world axes, as MuJoCo integrates it.

    The rate of `midpoint` is that of the twist in body axes, which rotate in the step.
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
