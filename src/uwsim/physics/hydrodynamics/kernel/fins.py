r"""Fins: control surfaces with lift and drag as functions of the angle of attack.

A foil of the area S moves through the water with the velocity V, perpendicular to its span. The
angle of attack :math:`\alpha` is the angle from V to the chord. Lift acts perpendicular to V,
towards the side to which the leading edge points, and drag acts against V:

.. math:: L = \tfrac12 \rho S V^2 C_L(\alpha), \qquad D = \tfrac12 \rho S V^2 C_D(\alpha)

V is the velocity at the foil, which therefore damps rotations of the vehicle. The coefficients
follow from a table; or below the stall, with the lift slope a and the induced drag k, from

.. math:: C_L = a \alpha, \qquad C_D = C_{D0} + k C_L^2

Beyond the stall they change within `FADE_ANGLE` to those of an inclined plate (Hoerner,
*Fluid-Dynamic Drag*, ch. 3): :math:`C_L = C_N \sin\alpha \cos\alpha`,
:math:`C_D = C_{D0} + C_N \sin^2\alpha`.

A servo turns the fin to its commanded angle, with a lag and a greatest rate. The site of the
actuator is the frame of the foil at the angle 0: x along the chord, z along the span.

Not modelled: the moment about the span, added mass of a foil, hysteresis of the stall, the wake of
a fin or a propeller at another fin.
"""

from __future__ import annotations

import math

from ....base.numerics.jit import njit, njit_borrowed
from ....base.numerics.memory import (
    Floats,
    Ints64,
    read_double,
    read_int32,
    read_int64,
    view_doubles,
)
from .. import columns as c
from . import fields as f
from .flow import actuator_site, add_force, site_height, site_velocity, submersion, water_density
from .stratification import density_ratio
from .thrusters import lag_share

FADE_ANGLE = math.radians(10.0)
"""The angle beyond the stall from which a foil counts as a plate [rad]."""
_RK4 = 1  # mjINT_RK4


@njit
def add_fin(m: int, d: int, o: Ints64, i: int, table: Floats, dt: float, work: Floats) -> None:
    """Add the force of a fin with its angle after a time ``dt``, and set the rate of its angle.

    Args:
        m: the address of the model.
        d: the address of the data.
        o: the offsets of the fields.
        i: the actuator id of the fin.
        table: the row of the fin.
        dt: the time from now [s].
        work: the rows of the bodies.
    """
    nbody, step = read_int64(m + o[f.NBODY]), read_double(m + o[f.TIMESTEP])
    target = read_double(read_int64(d + o[f.USERDATA]) + 8 * (c.WATER_COLUMNS * nbody + i))
    angle = read_double(
        read_int64(d + o[f.ACT]) + 8 * read_int32(read_int64(m + o[f.ACTUATOR_ACT]) + 4 * i)
    )
    is_rate = read_int32(m + o[f.INTEGRATOR]) == _RK4  # its stages need the rate at their time
    speed = servo_speed(table, angle, target, step, is_rate)
    control = read_int32(read_int64(m + o[f.ACTUATOR_CTRL]) + 4 * i)
    view_doubles(read_int64(d + o[f.CTRL]) + 8 * control, 1)[0] = speed
    site, body = actuator_site(m, o, i)
    fraction = submersion(m, d, o, site, body, 0.5 * math.sqrt(table[c.AREA]))
    if fraction <= 0.0:
        return
    u, v, _ = site_velocity(m, d, o, site, body)
    density = water_density(m, o) * density_ratio(m, o, site_height(d, o, site))
    x, y = foil_force(table, angle + dt * speed, u, v, fraction * density)
    add_force(m, d, o, site, body, (x, y, 0.0), 0.0, work)


@njit_borrowed
def servo_speed(table: Floats, angle: float, target: float, step: float, is_rate: bool) -> float:
    """Return the angular velocity of a fin towards its target angle [rad/s].

    Args:
        table: the row of the fin.
        angle: the present angle [rad].
        target: the target angle [rad].
        step: the length of a step [s].
        is_rate: true for the present angular velocity, else its mean over the step. A lag shorter
            than a step then counts as a step, so that the angle does not overshoot.
    """
    target = min(max(target, table[c.MIN_ANGLE]), table[c.MAX_ANGLE])
    if is_rate:
        speed = (target - angle) / max(table[c.LAG], step)
    else:
        speed = lag_share(table[c.LAG], step) * (target - angle) / step
    limited_speed: float = min(max(speed, -table[c.RATE]), table[c.RATE])
    return limited_speed


@njit_borrowed
def foil_force(
    table: Floats, angle: float, u: float, v: float, density: float
) -> tuple[float, float]:
    """Return the force on a foil along the x and y axes of its site [N].

    Args:
        table: the row of the fin.
        angle: the angle of the fin [rad].
        u: the velocity through the water along x, the chord at the angle 0 [m/s].
        v: the velocity along y, to which the leading edge turns at positive angles [m/s].
        density: the density of the water [kg/m3].
    """
    speed = math.sqrt(u * u + v * v)
    if speed == 0.0:
        return 0.0, 0.0
    attack = angle - math.atan2(v, u)
    if abs(attack) > math.pi:
        attack -= math.copysign(2.0 * math.pi, attack)
    lift, drag = coefficients(table, attack)
    size = 0.5 * density * table[c.AREA] * speed
    return -size * (lift * v + drag * u), size * (lift * u - drag * v)


@njit_borrowed
def coefficients(table: Floats, angle: float) -> tuple[float, float]:
    """Return the coefficients of lift and drag at an angle of attack, from -pi to pi [rad]."""
    if table[c.N_COEFFICIENTS] > 0.0:
        return _interpolate(table, angle)
    size = abs(angle)
    attached_lift = table[c.SLOPE] * min(size, table[c.STALL])
    drag = table[c.DRAG] + table[c.INDUCED_DRAG] * attached_lift * attached_lift
    if size <= table[c.STALL]:
        return table[c.SLOPE] * angle, drag
    share = min((size - table[c.STALL]) / FADE_ANGLE, 1.0)
    sine, cosine = math.sin(size), math.cos(size)
    plate = table[c.PLATE] * sine
    lift = attached_lift + share * (plate * cosine - attached_lift)
    return (lift if angle > 0.0 else -lift), drag + share * (table[c.DRAG] + plate * sine - drag)


@njit_borrowed
def _interpolate(table: Floats, angle: float) -> tuple[float, float]:
    """Interpolate the coefficients in the table; beyond its ends they are constant."""
    is_even = table[c.IS_EVEN] != 0.0
    x = abs(angle) if is_even else angle
    n = int(table[c.N_COEFFICIENTS])
    k = 1
    while k < n - 1 and table[c.COEFFICIENTS + 3 * k] < x:
        k += 1
    i, j = c.COEFFICIENTS + 3 * (k - 1), c.COEFFICIENTS + 3 * k
    share = (x - table[i]) / (table[j] - table[i])
    share = min(max(share, 0.0), 1.0)
    lift = table[i + 1] + share * (table[j + 1] - table[i + 1])
    drag = table[i + 2] + share * (table[j + 2] - table[i + 2])
    return (-lift if is_even and angle < 0.0 else lift), drag
