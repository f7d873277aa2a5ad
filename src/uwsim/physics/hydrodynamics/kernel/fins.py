r"""Fins: control surfaces, with lift and drag over the angle of attack.

A foil of the area S moves through the water at V, seen along its span; its leading edge is turned
by :math:`\alpha` out of V. Across V, to the side of the leading edge, and against V it feels

.. math:: L = \tfrac12 \rho S V^2 C_L(\alpha), \qquad D = \tfrac12 \rho S V^2 C_D(\alpha)

with the velocity of its own place, so that it damps a vehicle's turns by itself. The coefficients
are a table, or below the stall

.. math:: C_L = a \alpha, \qquad C_D = C_{D0} + k C_L^2

and beyond it, over `FADE`, those of a plate that stands across the flow (Hoerner, *Fluid-Dynamic
Drag*, ch. 3): :math:`C_L = C_N \sin\alpha \cos\alpha`, :math:`C_D = C_{D0} + C_N \sin^2\alpha`.

Its servo turns it towards the angle that is wanted, with a lag and no faster than its rate. The
site of the actuator is the foil at the angle 0: x along the chord, z along the span.

Not modelled: the moment about the span, added mass of a foil, hysteresis of the stall, the wake of
one fin or of a propeller on another.
"""

from __future__ import annotations

import math

from ....base.numerics.jit import njit
from ....base.numerics.memory import (
    Floats,
    Ints64,
    read_double,
    read_int32,
    read_int64,
    view_doubles,
)
from ..columns import (
    AREA,
    COEFFICIENTS,
    DRAG,
    INDUCED,
    IS_EVEN,
    LAG,
    MAX_ANGLE,
    MIN_ANGLE,
    N_COEFFICIENTS,
    PLATE,
    RATE,
    SLOPE,
    STALL,
    WATER_COLUMNS,
)
from . import fields as f
from .flow import height_of, push_at, site_of, velocity_at, water_density, wet_share
from .stratification import density_ratio
from .thrusters import share_of_lag

FADE = math.radians(10.0)
"""From the stall until a foil is but a plate [rad]."""
_RK4 = 1  # mjINT_RK4


@njit
def add_fin(m: int, d: int, at: Ints64, i: int, table: Floats, ahead: float, work: Floats) -> None:
    """Add the force of a fin, by its angle some time ahead, and set the speed of its servo.

    Args:
        m: address of the model.
        d: address of the data.
        at: offsets of the fields.
        i: number of the actuator.
        table: its row.
        ahead: the time [s].
        work: the rows of the bodies.
    """
    nbody, step = read_int64(m + at[f.NBODY]), read_double(m + at[f.TIMESTEP])
    wanted = read_double(read_int64(d + at[f.USERDATA]) + 8 * (WATER_COLUMNS * nbody + i))
    angle = read_double(
        read_int64(d + at[f.ACT]) + 8 * read_int32(read_int64(m + at[f.ACTUATOR_ACT]) + 4 * i)
    )
    is_rate = read_int32(m + at[f.INTEGRATOR]) == _RK4  # its stages integrate the rate of a time
    speed = servo_speed(table, angle, wanted, step, is_rate)
    control = read_int32(read_int64(m + at[f.ACTUATOR_CTRL]) + 4 * i)
    view_doubles(read_int64(d + at[f.CTRL]) + 8 * control, 1)[0] = speed
    site, body = site_of(m, at, i)
    wet = wet_share(m, d, at, site, body, 0.5 * math.sqrt(table[AREA]))
    if wet <= 0.0:
        return
    u, v, _ = velocity_at(m, d, at, site, body)
    density = water_density(m, at) * density_ratio(m, at, height_of(d, at, site))
    x, y = foil_force(table, angle + ahead * speed, u, v, wet * density)
    push_at(m, d, at, site, body, (x, y, 0.0), 0.0, work)


@njit
def servo_speed(table: Floats, angle: float, wanted: float, step: float, is_rate: bool) -> float:
    """Compute how fast a fin turns towards the angle that is wanted [rad/s].

    Args:
        table: the fin's row.
        angle: its present angle [rad].
        wanted: the angle that is wanted [rad].
        step: length of a step [s].
        is_rate: whether the speed is that of the moment, not the mean of the step; a lag shorter
            than a step then counts as a step, else the angle would overshoot.
    """
    wanted = min(max(wanted, table[MIN_ANGLE]), table[MAX_ANGLE])
    if is_rate:
        speed = (wanted - angle) / max(table[LAG], step)
    else:
        speed = share_of_lag(table[LAG], step) * (wanted - angle) / step
    limited: float = min(max(speed, -table[RATE]), table[RATE])
    return limited


@njit
def foil_force(
    table: Floats, angle: float, u: float, v: float, density: float
) -> tuple[float, float]:
    """Force on a foil along its chord at the angle 0 and across it [N].

    Args:
        table: the fin's row.
        angle: of the fin [rad].
        u: its velocity through the water along that chord [m/s].
        v: across it, to where the leading edge turns [m/s].
        density: of the water [kg/m3].
    """
    speed = math.sqrt(u * u + v * v)
    if speed == 0.0:
        return 0.0, 0.0
    attack = angle - math.atan2(v, u)
    if abs(attack) > math.pi:
        attack -= math.copysign(2.0 * math.pi, attack)
    lift, drag = coefficients(table, attack)
    size = 0.5 * density * table[AREA] * speed
    return -size * (lift * v + drag * u), size * (lift * u - drag * v)


@njit
def coefficients(table: Floats, angle: float) -> tuple[float, float]:
    """Coefficients of lift and drag at an angle of attack from -pi to pi."""
    if table[N_COEFFICIENTS] > 0.0:
        return _from_table(table, angle)
    size = abs(angle)
    attached = table[SLOPE] * min(size, table[STALL])
    drag = table[DRAG] + table[INDUCED] * attached * attached
    if size <= table[STALL]:
        return table[SLOPE] * angle, drag
    share = min((size - table[STALL]) / FADE, 1.0)
    across, along = math.sin(size), math.cos(size)
    plate = table[PLATE] * across
    lift = attached + share * (plate * along - attached)
    return (lift if angle > 0.0 else -lift), drag + share * (table[DRAG] + plate * across - drag)


@njit
def _from_table(table: Floats, angle: float) -> tuple[float, float]:
    """Linear between the rows, and as the last row beyond it."""
    is_even = table[IS_EVEN] != 0.0
    x = abs(angle) if is_even else angle
    n = int(table[N_COEFFICIENTS])
    k = 1
    while k < n - 1 and table[COEFFICIENTS + 3 * k] < x:
        k += 1
    first, second = COEFFICIENTS + 3 * (k - 1), COEFFICIENTS + 3 * k
    share = (x - table[first]) / (table[second] - table[first])
    share = min(max(share, 0.0), 1.0)
    lift = table[first + 1] + share * (table[second + 1] - table[first + 1])
    drag = table[first + 2] + share * (table[second + 2] - table[first + 2])
    return (-lift if is_even and angle < 0.0 else lift), drag
