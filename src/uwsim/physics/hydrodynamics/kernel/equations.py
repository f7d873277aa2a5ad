r"""Fossen's equations for one body, on plain numbers and arrays.

Nothing here depends on where the numbers are stored: the kernel, and any other back end (a batch on
a GPU), reads them from its own memory and passes them in. Six numbers of a twist or a force are in
the literature's order (surge, sway, heave, roll, pitch, yaw) and in the axes of the body, about its
reference point; ``table`` is a row of the body's table (`columns`), ``axes`` the nine numbers of
world_from_body row by row, ``lever`` leads from the origin of the sums to the reference point, in
world axes [m].

After Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control (2011), chapters 6 and 8.
"""

from __future__ import annotations

import math

from ....numerics.jit import njit
from ..columns import (
    ABOUT_X,
    ABOUT_Y,
    ABOUT_Z,
    ADDED,
    BY_SPEED,
    CENTRE,
    LAW,
    LIFT,
    LINEAR,
    QUADRATIC,
    REACH,
    REFERENCE,
    SHAPE,
    SIZE,
    TURN,
)
from .memory import Floats
from .submersion import submerged

Three = tuple[float, float, float]
Six = tuple[float, float, float, float, float, float]


@njit
def to_body(axes: Floats, x: float, y: float, z: float) -> Three:
    """Turn a vector of the world into the axes of the body."""
    return (
        axes[0] * x + axes[3] * y + axes[6] * z,
        axes[1] * x + axes[4] * y + axes[7] * z,
        axes[2] * x + axes[5] * y + axes[8] * z,
    )


@njit
def to_world(axes: Floats, x: float, y: float, z: float) -> Three:
    """Turn a vector of the body into the axes of the world."""
    return (
        axes[0] * x + axes[1] * y + axes[2] * z,
        axes[3] * x + axes[4] * y + axes[5] * z,
        axes[6] * x + axes[7] * y + axes[8] * z,
    )


@njit
def six(numbers: Floats, at: int) -> Six:
    """Six numbers of an array, from ``at`` on."""
    return (
        numbers[at], numbers[at + 1], numbers[at + 2],
        numbers[at + 3], numbers[at + 4], numbers[at + 5],
    )  # fmt: skip


@njit
def subtract(a: Six, b: Six) -> Six:
    """The difference of two wrenches."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3], a[4] - b[4], a[5] - b[5]


@njit
def reference_point(table: Floats, place: Floats, axes: Floats, com: Floats) -> tuple[float, Three]:
    """Height of the reference point in W, and the lever to it from the origin of the sums [m].

    Args:
        table: the body's.
        place: of the body's origin, in W.
        axes: world_from_body.
        com: the origin of the sums, in W.
    """
    bx, by, bz = table[REFERENCE], table[REFERENCE + 1], table[REFERENCE + 2]
    height = place[2] + axes[6] * bx + axes[7] * by + axes[8] * bz
    return height, (
        place[0] - com[0] + axes[0] * bx + axes[1] * by + axes[2] * bz,
        place[1] - com[1] + axes[3] * bx + axes[4] * by + axes[5] * bz,
        height - com[2],
    )


@njit
def wet_part(table: Floats, axes: Floats, depth: float) -> tuple[float, Three]:
    """The submerged share of a body, and the centre of that part from the reference point [m].

    Args:
        table: the body's.
        axes: world_from_body.
        depth: of the reference point below the surface [m].
    """
    x, y, z = table[CENTRE], table[CENTRE + 1], table[CENTRE + 2]
    depth = depth - (axes[6] * x + axes[7] * y + axes[8] * z)
    if depth >= table[REACH]:
        return 1.0, (x, y, z)
    wet, cx, cy, cz = submerged(
        table[SHAPE], table[SIZE], table[SIZE + 1], table[SIZE + 2],
        axes[6], axes[7], axes[8], depth,
    )  # fmt: skip
    return wet, (x + cx, y + cy, z + cz)


@njit
def relative_twist(axes: Floats, lever: Three, twist: Floats, water: Floats) -> Six:
    r"""The twist :math:`\nu_r` relative to the water.

    Args:
        axes: world_from_body.
        lever: of the reference point.
        twist: rotational, then translational part at the origin of the sums, world axes.
        water: the body's row of the water.
    """
    rx, ry, rz = lever
    wx, wy, wz = twist[0], twist[1], twist[2]
    u, v, w = to_body(
        axes,
        twist[3] + wy * rz - wz * ry - water[0],
        twist[4] + wz * rx - wx * rz - water[1],
        twist[5] + wx * ry - wy * rx - water[2],
    )
    p, q, r = to_body(axes, wx - water[TURN], wy - water[TURN + 1], wz - water[TURN + 2])
    return u, v, w, p, q, r


@njit
def known_rate(axes: Floats, lever: Three, bias: Six, water: Floats, omega: Three) -> Six:
    r"""The part of :math:`\dot\nu_r` that is known before the step is solved.

    .. math:: R^T (\dot J\dot q - \dot v_c) + \omega \times R^T v_c

    with the water's rotation, which counts as steady, in :math:`v_c`.

    Args:
        axes: world_from_body.
        lever: of the reference point.
        bias: :math:`\dot J\dot q` at the origin of the sums, rotational part first, world axes.
        water: the body's row of the water.
        omega: the body's own rotation, in its axes.
    """
    rx, ry, rz = lever
    ax, ay, az = bias[0], bias[1], bias[2]
    x, y, z = to_body(
        axes,
        bias[3] + ay * rz - az * ry - water[3],
        bias[4] + az * rx - ax * rz - water[4],
        bias[5] + ax * ry - ay * rx - water[5],
    )
    cx, cy, cz = to_body(axes, water[0], water[1], water[2])
    tx, ty, tz = to_body(axes, water[TURN], water[TURN + 1], water[TURN + 2])
    p, q, r = omega
    dp, dq, dr = to_body(axes, ax, ay, az)
    return (
        x + q * cz - r * cy, y + r * cx - p * cz, z + p * cy - q * cx,
        dp + q * tz - r * ty, dq + r * tx - p * tz, dr + p * ty - q * tx,
    )  # fmt: skip


@njit
def diagonal_momentum(table: Floats, nu: Six) -> Six:
    """The momentum of the added mass, of a body whose matrices are diagonal."""
    return (
        table[ADDED] * nu[0], table[ADDED + 7] * nu[1], table[ADDED + 14] * nu[2],
        table[ADDED + 21] * nu[3], table[ADDED + 28] * nu[4], table[ADDED + 35] * nu[5],
    )  # fmt: skip


@njit
def paces(table: Floats, nu: Six) -> Six:
    """The speeds that go with each component in the quadratic drag; see `BodyHydrodynamics`."""
    u, v, w, p, q, r = nu
    law = table[LAW]
    if law == BY_SPEED:
        speed, spin = math.sqrt(u * u + v * v + w * w), math.sqrt(p * p + q * q + r * r)
        return speed, speed, speed, spin, spin, spin
    a, b, c, d, e, f = abs(u), abs(v), abs(w), abs(p), abs(q), abs(r)
    if law == ABOUT_X:
        b, e = math.sqrt(v * v + w * w), math.sqrt(q * q + r * r)
        return a, b, b, d, e, e
    if law == ABOUT_Y:
        a, d = math.sqrt(u * u + w * w), math.sqrt(p * p + r * r)
        return a, b, a, d, e, d
    if law == ABOUT_Z:
        a, d = math.sqrt(u * u + v * v), math.sqrt(p * p + q * q)
        return a, a, c, d, d, f
    return a, b, c, d, e, f


@njit
def _slope(table: Floats, i: int, speed: float, pace: float) -> float:
    """Derivative of the drag of a component: linear + quadratic (s + u^2 / s)."""
    own = abs(speed)
    grows = 2.0 * own if pace == own else pace + own * own / pace
    slope: float = table[LINEAR + 7 * i] + table[QUADRATIC + 7 * i] * grows
    return slope


@njit
def slopes(table: Floats, nu: Six, pace: Six) -> Six:
    """Derivative of the drag of each component."""
    return (
        _slope(table, 0, nu[0], pace[0]), _slope(table, 1, nu[1], pace[1]),
        _slope(table, 2, nu[2], pace[2]), _slope(table, 3, nu[3], pace[3]),
        _slope(table, 4, nu[4], pace[4]), _slope(table, 5, nu[5], pace[5]),
    )  # fmt: skip


@njit
def diagonal_force(table: Floats, nu: Six, rate: Six, pace: Six, slope: Six, step: float) -> Six:
    r"""Force of diagonal added mass and drag: :math:`-(M_A + h D')\dot\nu - D(\nu)\,\nu`.

    Drag is linear over a step, so that it answers to what is known of the rate as to the rest.
    """
    return (
        _axis_force(table, 0, nu[0], rate[0], pace[0], step * slope[0]),
        _axis_force(table, 1, nu[1], rate[1], pace[1], step * slope[1]),
        _axis_force(table, 2, nu[2], rate[2], pace[2], step * slope[2]),
        _axis_force(table, 3, nu[3], rate[3], pace[3], step * slope[3]),
        _axis_force(table, 4, nu[4], rate[4], pace[4], step * slope[4]),
        _axis_force(table, 5, nu[5], rate[5], pace[5], step * slope[5]),
    )


@njit
def _axis_force(
    table: Floats, i: int, speed: float, rate: float, pace: float, change: float
) -> float:
    drag = (table[LINEAR + 7 * i] + table[QUADRATIC + 7 * i] * pace) * speed
    force: float = -(table[ADDED + 7 * i] + change) * rate - drag
    return force


@njit
def full_force(
    table: Floats, nu: Six, rate: Six, step: float, work: Floats, at: int
) -> tuple[Six, Six]:
    """The same of a body with full matrices: force, and momentum of the added mass.

    Leaves added mass + step times the slope of the drag (its symmetric part), (6, 6), in ``work``
    from ``at`` on.
    """
    surge = abs(nu[0])
    for i in range(6):
        force, momentum = 0.0, 0.0
        for j in range(6):
            added = table[ADDED + 6 * i + j]
            linear = table[LINEAR + 6 * i + j] + table[LIFT + 6 * i + j] * surge
            steep = table[QUADRATIC + 6 * i + j] * abs(nu[j])
            mirrored = table[LINEAR + 6 * j + i] + table[LIFT + 6 * j + i] * surge
            mirrored += 2.0 * table[QUADRATIC + 6 * j + i] * abs(nu[i])
            slope = 0.5 * (linear + 2.0 * steep + mirrored)
            work[at + 6 * i + j] = added + step * slope
            momentum += added * nu[j]
            force -= work[at + 6 * i + j] * rate[j] + (linear + steep) * nu[j]
        work[at + 36 + i], work[at + 42 + i] = force, momentum
    f, m = at + 36, at + 42
    return (
        (work[f], work[f + 1], work[f + 2], work[f + 3], work[f + 4], work[f + 5]),
        (work[m], work[m + 1], work[m + 2], work[m + 3], work[m + 4], work[m + 5]),
    )


@njit
def coriolis(nu: Six, omega: Three, momentum: Six) -> Six:
    r"""Coriolis force of the added mass, :math:`C_A(\nu)\,\nu` (Kirchhoff).

    The axes turn with the body's own rotation :math:`\omega`, in still water that of the twist.

    With the momentum (p, h): force :math:`\omega \times p`, torque
    :math:`\omega \times h + v \times p`.
    """
    u, v, w = nu[0], nu[1], nu[2]
    p, q, r = omega
    px, py, pz, hx, hy, hz = momentum
    return (
        q * pz - r * py,
        r * px - p * pz,
        p * py - q * px,
        q * hz - r * hy + v * pz - w * py,
        r * hx - p * hz + w * px - u * pz,
        p * hy - q * hx + u * py - v * px,
    )


@njit
def buoyancy(displaced: float, water: Floats, gravity: Floats, weight: float) -> Three:
    """The pressure of still and of accelerating water on a displaced mass [N], world axes."""
    return (
        displaced * (water[3] - weight * gravity[0]),
        displaced * (water[4] - weight * gravity[1]),
        displaced * (water[5] - weight * gravity[2]),
    )


@njit
def diagonal_inertia(table: Floats, slope: Six, wet: float, step: float) -> Six:
    """Added mass + step times the slope of the drag, of which a part is wet."""
    h = wet * step
    return (
        wet * table[ADDED] + h * slope[0], wet * table[ADDED + 7] + h * slope[1],
        wet * table[ADDED + 14] + h * slope[2], wet * table[ADDED + 21] + h * slope[3],
        wet * table[ADDED + 28] + h * slope[4], wet * table[ADDED + 35] + h * slope[5],
    )  # fmt: skip


@njit
def move_wrench(axes: Floats, lever: Three, wet: float, force: Six) -> Six:
    """A wrench of the body at the origin of the sums: torque, then force, world axes."""
    rx, ry, rz = lever
    x, y, z = to_world(axes, force[0], force[1], force[2])
    tx, ty, tz = to_world(axes, force[3], force[4], force[5])
    x, y, z = wet * x, wet * y, wet * z
    return (
        wet * tx + ry * z - rz * y,
        wet * ty + rz * x - rx * z,
        wet * tz + rx * y - ry * x,
        x,
        y,
        z,
    )


@njit
def add_lift(
    axes: Floats, lever: Three, centre: Three, wrench: Six, lift: Three, out: Floats, to: int
) -> None:
    """Add a wrench and a force at ``centre`` (from the reference point) to ``out``."""
    x, y, z = centre
    fx, fy, fz = lift
    cx = lever[0] + axes[0] * x + axes[1] * y + axes[2] * z
    cy = lever[1] + axes[3] * x + axes[4] * y + axes[5] * z
    cz = lever[2] + axes[6] * x + axes[7] * y + axes[8] * z
    out[to] += wrench[0] + cy * fz - cz * fy
    out[to + 1] += wrench[1] + cz * fx - cx * fz
    out[to + 2] += wrench[2] + cx * fy - cy * fx
    out[to + 3] += wrench[3] + fx
    out[to + 4] += wrench[4] + fy
    out[to + 5] += wrench[5] + fz


@njit
def move_diagonal_inertia(
    axes: Floats, lever: Three, inertia: Six, out: Floats, ff: int, ft: int, tt: int
) -> None:
    """A diagonal inertia at the origin of the sums, in world axes.

    Args:
        axes: world_from_body.
        lever: of the reference point.
        inertia: the diagonal.
        out: receives
        ff: from here on force by velocity, symmetric (xx xy xz yy yz zz),
        ft: from here on force by rotation (3, 3), row by row,
        tt: from here on torque by rotation, symmetric.
    """
    r00, r01, r02 = axes[0], axes[1], axes[2]
    r10, r11, r12 = axes[3], axes[4], axes[5]
    r20, r21, r22 = axes[6], axes[7], axes[8]
    rx, ry, rz = lever
    a, b, c = inertia[0], inertia[1], inertia[2]
    xx = a * r00 * r00 + b * r01 * r01 + c * r02 * r02
    xy = a * r00 * r10 + b * r01 * r11 + c * r02 * r12
    xz = a * r00 * r20 + b * r01 * r21 + c * r02 * r22
    yy = a * r10 * r10 + b * r11 * r11 + c * r12 * r12
    yz = a * r10 * r20 + b * r11 * r21 + c * r12 * r22
    zz = a * r20 * r20 + b * r21 * r21 + c * r22 * r22
    a, b, c = inertia[3], inertia[4], inertia[5]
    out[ff], out[ff + 1], out[ff + 2] = xx, xy, xz
    out[ff + 3], out[ff + 4], out[ff + 5] = yy, yz, zz
    # force by rotation: -B11 S(r)
    f0, f1, f2 = xz * ry - xy * rz, xx * rz - xz * rx, xy * rx - xx * ry
    f3, f4, f5 = yz * ry - yy * rz, xy * rz - yz * rx, yy * rx - xy * ry
    f6, f7, f8 = zz * ry - yz * rz, xz * rz - zz * rx, yz * rx - xz * ry
    out[ft], out[ft + 1], out[ft + 2] = f0, f1, f2
    out[ft + 3], out[ft + 4], out[ft + 5] = f3, f4, f5
    out[ft + 6], out[ft + 7], out[ft + 8] = f6, f7, f8
    # torque by rotation: B22 + S(r) (force by rotation)
    out[tt] = a * r00 * r00 + b * r01 * r01 + c * r02 * r02 + ry * f6 - rz * f3
    out[tt + 1] = a * r00 * r10 + b * r01 * r11 + c * r02 * r12 + ry * f7 - rz * f4
    out[tt + 2] = a * r00 * r20 + b * r01 * r21 + c * r02 * r22 + ry * f8 - rz * f5
    out[tt + 3] = a * r10 * r10 + b * r11 * r11 + c * r12 * r12 + rz * f1 - rx * f7
    out[tt + 4] = a * r10 * r20 + b * r11 * r21 + c * r12 * r22 + rz * f2 - rx * f8
    out[tt + 5] = a * r20 * r20 + b * r21 * r21 + c * r22 * r22 + rx * f5 - ry * f2


@njit
def _turn(axes: Floats, work: Floats, block: int, to: int) -> None:
    """One 3x3 block, at ``block`` in rows of 6, into world axes: R B R^T, in rows of 3."""
    for j in range(3):
        x, y, z = axes[3 * j], axes[3 * j + 1], axes[3 * j + 2]
        a = work[block] * x + work[block + 1] * y + work[block + 2] * z
        b = work[block + 6] * x + work[block + 7] * y + work[block + 8] * z
        c = work[block + 12] * x + work[block + 13] * y + work[block + 14] * z
        work[to + j] = axes[0] * a + axes[1] * b + axes[2] * c
        work[to + 3 + j] = axes[3] * a + axes[4] * b + axes[5] * c
        work[to + 6 + j] = axes[6] * a + axes[7] * b + axes[8] * c


@njit
def move_full_inertia(
    axes: Floats, lever: Three, wet: float, out: Floats, full: int, ff: int, ft: int, tt: int
) -> None:
    """The same of a full inertia (6, 6), which lies in ``out`` from ``full`` on; 9 more follow."""
    rx, ry, rz = lever
    to = full + 36
    _turn(axes, out, full, to)
    xx, xy, xz = wet * out[to], wet * out[to + 1], wet * out[to + 2]
    yy, yz, zz = wet * out[to + 4], wet * out[to + 5], wet * out[to + 8]
    out[ff], out[ff + 1], out[ff + 2] = xx, xy, xz
    out[ff + 3], out[ff + 4], out[ff + 5] = yy, yz, zz
    # force by rotation: B12 - B11 S(r)
    _turn(axes, out, full + 3, to)
    a, b, c = wet * out[to], wet * out[to + 1], wet * out[to + 2]
    d, e, f = wet * out[to + 3], wet * out[to + 4], wet * out[to + 5]
    g, h, i = wet * out[to + 6], wet * out[to + 7], wet * out[to + 8]
    f0, f1, f2 = a - xy * rz + xz * ry, b - xz * rx + xx * rz, c - xx * ry + xy * rx
    f3, f4, f5 = d - yy * rz + yz * ry, e - yz * rx + xy * rz, f - xy * ry + yy * rx
    f6, f7, f8 = g - yz * rz + zz * ry, h - zz * rx + xz * rz, i - xz * ry + yz * rx
    out[ft], out[ft + 1], out[ft + 2] = f0, f1, f2
    out[ft + 3], out[ft + 4], out[ft + 5] = f3, f4, f5
    out[ft + 6], out[ft + 7], out[ft + 8] = f6, f7, f8
    # torque by rotation: B22 + S(r) (force by rotation) - B12^T S(r)
    _turn(axes, out, full + 21, to)
    out[tt] = wet * out[to] + ry * f6 - rz * f3 - (d * rz - g * ry)
    out[tt + 1] = wet * out[to + 1] + ry * f7 - rz * f4 - (g * rx - a * rz)
    out[tt + 2] = wet * out[to + 2] + ry * f8 - rz * f5 - (a * ry - d * rx)
    out[tt + 3] = wet * out[to + 4] + rz * f1 - rx * f7 - (h * rx - b * rz)
    out[tt + 4] = wet * out[to + 5] + rz * f2 - rx * f8 - (b * ry - e * rx)
    out[tt + 5] = wet * out[to + 8] + rx * f5 - ry * f2 - (c * ry - f * rx)
