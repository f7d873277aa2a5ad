r"""Fossen's equations for one body, on plain numbers and arrays.

These functions do not depend on where the numbers are stored: the kernel, or another back end such
as a batch on a GPU, passes them in from its memory. The six components of a twist [m/s, rad/s],
wrench [N, N m] or momentum are in the order of the literature (surge, sway, heave, roll, pitch,
yaw), in body axes, about the body's reference point. MuJoCo's spatial vectors have the rotational
part first, in world axes, about the centre of mass of the tree of bodies.

``table`` is the row of the body (`columns`), ``axes`` the rotation ``world_from_body`` (9,) by
rows, and ``lever`` the vector from the centre of mass of the tree to the reference point, in world
axes [m].

After Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control (2011), chapters 6 and 8.
"""

from __future__ import annotations

import math

from ....base.numerics.jit import njit_borrowed
from ....base.numerics.memory import Floats
from .. import columns as c
from .submersion import compute_submersion

Three = tuple[float, float, float]
Six = tuple[float, float, float, float, float, float]


@njit_borrowed
def to_body(axes: Floats, x: float, y: float, z: float) -> Three:
    """Rotate a vector from world axes to body axes."""
    return (
        axes[0] * x + axes[3] * y + axes[6] * z,
        axes[1] * x + axes[4] * y + axes[7] * z,
        axes[2] * x + axes[5] * y + axes[8] * z,
    )


@njit_borrowed
def to_world(axes: Floats, x: float, y: float, z: float) -> Three:
    """Rotate a vector from body axes to world axes."""
    return (
        axes[0] * x + axes[1] * y + axes[2] * z,
        axes[3] * x + axes[4] * y + axes[5] * z,
        axes[6] * x + axes[7] * y + axes[8] * z,
    )


@njit_borrowed
def read_six(numbers: Floats, start: int) -> Six:
    """Return six numbers of an array, from the index ``start`` on."""
    return (
        numbers[start], numbers[start + 1], numbers[start + 2],
        numbers[start + 3], numbers[start + 4], numbers[start + 5],
    )  # fmt: skip


@njit_borrowed
def subtract(a: Six, b: Six) -> Six:
    """Return the difference of two wrenches."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3], a[4] - b[4], a[5] - b[5]


@njit_borrowed
def reference_point(table: Floats, xpos: Floats, axes: Floats, com: Floats) -> tuple[float, Three]:
    """Return the height of the reference point in the world, and the lever to it [m].

    Args:
        table: the row of the body.
        xpos: the body's origin in the world [m].
        axes: ``world_from_body``.
        com: the centre of mass of the tree in the world [m].
    """
    rx, ry, rz = table[c.REFERENCE], table[c.REFERENCE + 1], table[c.REFERENCE + 2]
    height = xpos[2] + axes[6] * rx + axes[7] * ry + axes[8] * rz
    return height, (
        xpos[0] - com[0] + axes[0] * rx + axes[1] * ry + axes[2] * rz,
        xpos[1] - com[1] + axes[3] * rx + axes[4] * ry + axes[5] * rz,
        height - com[2],
    )


@njit_borrowed
def surface_plane(
    table: Floats, axes: Floats, height: float, surface: float, water: Floats
) -> tuple[Three, float]:
    """Return the plane that approximates the water surface at a body.

    Args:
        table: the row of the body.
        axes: ``world_from_body``.
        height: the height of the reference point in the world [m].
        surface: the height of the still water in the world [m].
        water: the row of the water at the body in ``userdata``.

    Returns:
        The upward unit normal of the plane in body axes, which is vertical for a level surface, and
        the depth of the reference point below the plane [m].
    """
    a, b = water[c.SLOPE_X], water[c.SLOPE_Y]
    if a == 0.0 and b == 0.0:
        return (axes[6], axes[7], axes[8]), surface + water[c.ELEVATION] - height
    size = math.sqrt(1.0 + a * a + b * b)
    up = to_body(axes, -a / size, -b / size, 1.0 / size)
    x, y, z = table[c.CENTRE], table[c.CENTRE + 1], table[c.CENTRE + 2]
    centre_height = height + axes[6] * x + axes[7] * y + axes[8] * z
    depth = (surface + water[c.ELEVATION] - centre_height) / size  # of the centre of buoyancy
    return up, depth + (up[0] * x + up[1] * y + up[2] * z)


@njit_borrowed
def submerged_part(table: Floats, up: Three, depth: float, memory: Floats) -> tuple[float, Three]:
    """Return the submerged fraction of a body, and the centre of the submerged part.

    The centre is relative to the reference point, in body axes [m].

    Args:
        table: the row of the body.
        up: the upward unit normal of the surface in body axes.
        depth: the depth of the reference point below the surface [m].
        memory: scratch memory, (`submersion.MEMORY`,).
    """
    x, y, z = table[c.CENTRE], table[c.CENTRE + 1], table[c.CENTRE + 2]
    depth = depth - (up[0] * x + up[1] * y + up[2] * z)
    if depth >= table[c.REACH]:
        return 1.0, (x, y, z)
    fraction, cx, cy, cz = compute_submersion(
        table[c.SHAPE], table[c.SIZE], table[c.SIZE + 1], table[c.SIZE + 2],
        up[0], up[1], up[2], depth, memory,
    )  # fmt: skip
    return fraction, (x + cx, y + cy, z + cz)


@njit_borrowed
def entered_share(
    table: Floats,
    up: Three,
    depth: float,
    fraction: float,
    nu: Six,
    step: float,
    memory: Floats,
) -> float:
    """Return the fraction of the submerged part that has entered the water within a step.

    Args:
        table: the row of the body.
        up: the upward unit normal of the surface in body axes.
        depth: the depth of the reference point below the surface [m].
        fraction: the submerged fraction of the body.
        nu: the twist relative to the water during the step.
        step: the length of the step [s].
        memory: scratch memory, (`submersion.MEMORY`,).
    """
    a, b, c = up
    u, v, w, p, q, r = nu
    x, y, z = a - step * (b * r - c * q), b - step * (c * p - a * r), c - step * (a * q - b * p)
    size = math.sqrt(x * x + y * y + z * z)
    previous_fraction, _ = submerged_part(
        table, (x / size, y / size, z / size), depth + step * (a * u + b * v + c * w), memory
    )
    return max(fraction - previous_fraction, 0.0) / fraction


@njit_borrowed
def subtract_momentum_rate(force: Six, momentum: Six, rate: float) -> Six:
    """Return a wrench minus a momentum times the relative growth rate of the added mass [1/s]."""
    return (
        force[0] - rate * momentum[0], force[1] - rate * momentum[1],
        force[2] - rate * momentum[2], force[3] - rate * momentum[3],
        force[4] - rate * momentum[4], force[5] - rate * momentum[5],
    )  # fmt: skip


@njit_borrowed
def relative_twist(axes: Floats, lever: Three, twist: Floats, water: Floats) -> Six:
    r"""Return the twist :math:`\nu_r` relative to the water.

    Args:
        axes: ``world_from_body``.
        lever: the lever to the reference point.
        twist: MuJoCo's spatial velocity of the body (``cvel``).
        water: the row of the water at the body in ``userdata``.
    """
    rx, ry, rz = lever
    wx, wy, wz = twist[0], twist[1], twist[2]
    u, v, w = to_body(
        axes,
        twist[3] + wy * rz - wz * ry - water[0],
        twist[4] + wz * rx - wx * rz - water[1],
        twist[5] + wx * ry - wy * rx - water[2],
    )
    p, q, r = to_body(axes, wx - water[c.OMEGA], wy - water[c.OMEGA + 1], wz - water[c.OMEGA + 2])
    return u, v, w, p, q, r


@njit_borrowed
def bias_acceleration(axes: Floats, lever: Three, bias: Six, water: Floats, omega: Three) -> Six:
    r"""Return the part of :math:`\dot\nu_r` that does not depend on the solution of the step.

    .. math:: R^T (\dot J\dot q - \dot v_c) + \omega \times R^T v_c

    Here R is ``world_from_body``, :math:`\omega` the angular velocity of the body, and :math:`v_c`
    the twist of the water, whose angular part counts as constant.

    Args:
        axes: ``world_from_body``.
        lever: the lever to the reference point.
        bias: :math:`\dot J\dot q` as a spatial acceleration of MuJoCo.
        water: the row of the water at the body in ``userdata``.
        omega: the angular velocity of the body in body axes [rad/s].
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
    tx, ty, tz = to_body(axes, water[c.OMEGA], water[c.OMEGA + 1], water[c.OMEGA + 2])
    p, q, r = omega
    dp, dq, dr = to_body(axes, ax, ay, az)
    return (
        x + q * cz - r * cy, y + r * cx - p * cz, z + p * cy - q * cx,
        dp + q * tz - r * ty, dq + r * tx - p * tz, dr + p * ty - q * tx,
    )  # fmt: skip


@njit_borrowed
def diagonal_momentum(table: Floats, nu: Six) -> Six:
    """Return the momentum of the added mass of a body with diagonal matrices."""
    return (
        table[c.M_A] * nu[0], table[c.M_A + 7] * nu[1], table[c.M_A + 14] * nu[2],
        table[c.M_A + 21] * nu[3], table[c.M_A + 28] * nu[4], table[c.M_A + 35] * nu[5],
    )  # fmt: skip


@njit_borrowed
def drag_speeds(table: Floats, nu: Six) -> Six:
    """Return the speed s of each component in the quadratic drag; see `BodyHydrodynamics`.

    The drag of a component u is (linear + quadratic s) u; s depends on the drag law of the body.
    """
    u, v, w, p, q, r = nu
    law = table[c.LAW]
    if law == c.DRAG_BY_SPEED:
        speed, spin = math.sqrt(u * u + v * v + w * w), math.sqrt(p * p + q * q + r * r)
        return speed, speed, speed, spin, spin, spin
    x, y, z, d, e, f = abs(u), abs(v), abs(w), abs(p), abs(q), abs(r)
    if law == c.DRAG_ABOUT_X:
        y, e = math.sqrt(v * v + w * w), math.sqrt(q * q + r * r)
        return x, y, y, d, e, e
    if law == c.DRAG_ABOUT_Y:
        x, d = math.sqrt(u * u + w * w), math.sqrt(p * p + r * r)
        return x, y, x, d, e, d
    if law == c.DRAG_ABOUT_Z:
        x, d = math.sqrt(u * u + v * v), math.sqrt(p * p + q * q)
        return x, x, z, d, d, f
    return x, y, z, d, e, f


@njit_borrowed
def _drag_slope(table: Floats, i: int, nu_i: float, s: float) -> float:
    """Return the derivative of the drag of component i: linear + quadratic (s + u^2 / s)."""
    u = abs(nu_i)
    rise = 2.0 * u if s == u else s + u * u / s
    slope: float = table[c.LINEAR + 7 * i] + table[c.QUADRATIC + 7 * i] * rise
    return slope


@njit_borrowed
def drag_slopes(table: Floats, nu: Six, s: Six) -> Six:
    """Return the derivative of the drag of each component with respect to its speed."""
    return (
        _drag_slope(table, 0, nu[0], s[0]), _drag_slope(table, 1, nu[1], s[1]),
        _drag_slope(table, 2, nu[2], s[2]), _drag_slope(table, 3, nu[3], s[3]),
        _drag_slope(table, 4, nu[4], s[4]), _drag_slope(table, 5, nu[5], s[5]),
    )  # fmt: skip


@njit_borrowed
def diagonal_force(table: Floats, nu: Six, rate: Six, s: Six, slope: Six, step: float) -> Six:
    r"""Return the wrench :math:`-(M_A + h D')\dot\nu - D(\nu)\,\nu` of diagonal matrices.

    Args:
        table: the row of the body.
        nu: the twist relative to the water.
        rate: the known part of the rate of ``nu``; the unknown part is solved for by the engine.
        s: the speeds of `drag_speeds`.
        slope: the slopes :math:`D'` of `drag_slopes`.
        step: the step h over which drag is linearly implicit [s]; 0 for explicit drag.
    """
    return (
        _axis_force(table, 0, nu[0], rate[0], s[0], step * slope[0]),
        _axis_force(table, 1, nu[1], rate[1], s[1], step * slope[1]),
        _axis_force(table, 2, nu[2], rate[2], s[2], step * slope[2]),
        _axis_force(table, 3, nu[3], rate[3], s[3], step * slope[3]),
        _axis_force(table, 4, nu[4], rate[4], s[4], step * slope[4]),
        _axis_force(table, 5, nu[5], rate[5], s[5], step * slope[5]),
    )


@njit_borrowed
def _axis_force(table: Floats, i: int, nu_i: float, rate: float, s: float, change: float) -> float:
    drag = (table[c.LINEAR + 7 * i] + table[c.QUADRATIC + 7 * i] * s) * nu_i
    force: float = -(table[c.M_A + 7 * i] + change) * rate - drag
    return force


@njit_borrowed
def full_force(
    table: Floats, nu: Six, rate: Six, step: float, work: Floats, start: int
) -> tuple[Six, Six]:
    """Return the wrench, and the momentum of the added mass, of a body with full matrices.

    The added mass plus the symmetric part of ``step`` times the slope of the drag, (6, 6), is
    written to ``work`` from the index ``start`` on, where 48 numbers are needed. The slope lacks
    the derivative of the lift with respect to surge. See `diagonal_force` for the arguments.
    """
    surge = abs(nu[0])
    for i in range(6):
        force, momentum = 0.0, 0.0
        for j in range(6):
            added_mass = table[c.M_A + 6 * i + j]
            linear = table[c.LINEAR + 6 * i + j] + table[c.LIFT + 6 * i + j] * surge
            quadratic = table[c.QUADRATIC + 6 * i + j] * abs(nu[j])
            transpose = table[c.LINEAR + 6 * j + i] + table[c.LIFT + 6 * j + i] * surge
            transpose += 2.0 * table[c.QUADRATIC + 6 * j + i] * abs(nu[i])
            slope = 0.5 * (linear + 2.0 * quadratic + transpose)
            work[start + 6 * i + j] = added_mass + step * slope
            momentum += added_mass * nu[j]
            force -= work[start + 6 * i + j] * rate[j] + (linear + quadratic) * nu[j]
        work[start + 36 + i], work[start + 42 + i] = force, momentum
    f, m = start + 36, start + 42
    return (
        (work[f], work[f + 1], work[f + 2], work[f + 3], work[f + 4], work[f + 5]),
        (work[m], work[m + 1], work[m + 2], work[m + 3], work[m + 4], work[m + 5]),
    )


@njit_borrowed
def coriolis(nu: Six, omega: Three, momentum: Six) -> Six:
    r"""Return the Coriolis wrench of the added mass, :math:`C_A(\nu)\,\nu` (Kirchhoff).

    With the momentum (p, h) it is the force :math:`\omega \times p` and the torque
    :math:`\omega \times h + v \times p`. The angular velocity :math:`\omega` is that of the body
    axes; in still water it is the angular part of ``nu``.
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


@njit_borrowed
def buoyancy(mass: float, water: Floats, gravity: Floats, gravity_scale: float) -> Three:
    """Return the buoyancy with the pressure force of accelerating water [N], in world axes.

    Args:
        mass: the displaced mass [kg].
        water: the row of the water at the body in ``userdata``.
        gravity: the acceleration of gravity, (3,) [m/s2].
        gravity_scale: 1, or 0 without gravity.
    """
    return (
        mass * (water[3] - gravity_scale * gravity[0]),
        mass * (water[4] - gravity_scale * gravity[1]),
        mass * (water[5] - gravity_scale * gravity[2]),
    )


@njit_borrowed
def move_wrench(axes: Floats, lever: Three, fraction: float, force: Six) -> Six:
    """Return a fraction of a body's wrench as a spatial force of MuJoCo: torque, then force."""
    rx, ry, rz = lever
    x, y, z = to_world(axes, force[0], force[1], force[2])
    tx, ty, tz = to_world(axes, force[3], force[4], force[5])
    x, y, z = fraction * x, fraction * y, fraction * z
    return (
        fraction * tx + ry * z - rz * y,
        fraction * ty + rz * x - rx * z,
        fraction * tz + rx * y - ry * x,
        x,
        y,
        z,
    )


@njit_borrowed
def add_wrench(
    axes: Floats, lever: Three, centre: Three, wrench: Six, force: Three, out: Floats, k: int
) -> None:
    """Add a spatial force, and a force at a point of the body, to ``out`` from index k on.

    Args:
        axes: ``world_from_body``.
        lever: the lever to the reference point.
        centre: the point, relative to the reference point, in body axes [m].
        wrench: the spatial force of MuJoCo.
        force: the force at the point, in world axes [N].
        out: the array to which both are added as a spatial force.
        k: the index of its first component.
    """
    x, y, z = centre
    fx, fy, fz = force
    cx = lever[0] + axes[0] * x + axes[1] * y + axes[2] * z
    cy = lever[1] + axes[3] * x + axes[4] * y + axes[5] * z
    cz = lever[2] + axes[6] * x + axes[7] * y + axes[8] * z
    out[k] += wrench[0] + cy * fz - cz * fy
    out[k + 1] += wrench[1] + cz * fx - cx * fz
    out[k + 2] += wrench[2] + cx * fy - cy * fx
    out[k + 3] += wrench[3] + fx
    out[k + 4] += wrench[4] + fy
    out[k + 5] += wrench[5] + fz
