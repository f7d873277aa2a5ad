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

from ....base.numerics.jit import njit
from ....base.numerics.memory import Floats
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
def wet_part(table: Floats, up: Three, depth: float) -> tuple[float, Three]:
    """The submerged share of a body, and the centre of that part from the reference point [m].

    Args:
        table: the body's.
        up: the vertical in the axes of the body.
        depth: of the reference point below the surface [m].
    """
    x, y, z = table[CENTRE], table[CENTRE + 1], table[CENTRE + 2]
    depth = depth - (up[0] * x + up[1] * y + up[2] * z)
    if depth >= table[REACH]:
        return 1.0, (x, y, z)
    wet, cx, cy, cz = submerged(
        table[SHAPE], table[SIZE], table[SIZE + 1], table[SIZE + 2], up[0], up[1], up[2], depth
    )
    return wet, (x + cx, y + cy, z + cz)


@njit
def entered(table: Floats, up: Three, depth: float, wet: float, nu: Six, step: float) -> float:
    """What share of the wet part has come into the water within a step.

    Args:
        table: the body's.
        up: the vertical in the axes of the body.
        depth: of the reference point below the surface [m].
        wet: the submerged share of the body.
        nu: its twist relative to the water, which carried it from where it was.
        step: the length of the step [s].
    """
    a, b, c = up
    u, v, w, p, q, r = nu
    x, y, z = a - step * (b * r - c * q), b - step * (c * p - a * r), c - step * (a * q - b * p)
    size = math.sqrt(x * x + y * y + z * z)
    before, _ = wet_part(
        table, (x / size, y / size, z / size), depth + step * (a * u + b * v + c * w)
    )
    return max(wet - before, 0.0) / wet


@njit
def take_along(force: Six, momentum: Six, rate: float) -> Six:
    """A force less that on a body whose added mass grows at a rate [1/s]."""
    return (
        force[0] - rate * momentum[0], force[1] - rate * momentum[1],
        force[2] - rate * momentum[2], force[3] - rate * momentum[3],
        force[4] - rate * momentum[4], force[5] - rate * momentum[5],
    )  # fmt: skip


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
