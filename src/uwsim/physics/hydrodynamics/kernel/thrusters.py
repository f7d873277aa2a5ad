r"""Thrusters: static thrust curve, reduced by the inflow.

A propeller of diameter D that turns n times a second in water that comes at V gives

.. math:: T = \rho n^2 D^4 K_T(J), \qquad J = \frac{V}{n D}

(Carlton, *Marine Propellers and Propulsion*, ch. 6). The curve of the command is the thrust at
rest, :math:`T_0 = \rho n^2 D^4 K_T(0)`, from which n follows: the thrust is
:math:`T_0 K_T(J) / K_T(0)`. Water that comes from behind changes nothing. Backwards the
propeller has the same coefficients.

Not modelled: inflow across the propeller's axis, cavitation, the drag of a propeller that stands.
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
    ADVANCE,
    BACKWARD,
    CURVE_TERMS,
    DEAD_ZONE,
    FORWARD,
    LAG,
    MAX_THRUST,
    MIN_THRUST,
    N_ADVANCE,
    RADIUS,
    TORQUE,
    WAKE,
    WATER_COLUMNS,
)
from . import fields as f
from .flow import push_at, site_of, velocity_at, water_density, wet_share


@njit
def add_thrust(
    m: int, d: int, at: Ints64, i: int, table: Floats, ahead: float, work: Floats
) -> None:
    """Add the thrust of a thruster, by its rotor some time ahead.

    Args:
        m: address of the model.
        d: address of the data.
        at: offsets of the fields.
        i: number of the actuator.
        table: its row.
        ahead: the time [s].
        work: the rows of the bodies.
    """
    n, nbody = read_int64(m + at[f.NACTUATOR]), read_int64(m + at[f.NBODY])
    state = read_int32(read_int64(m + at[f.ACTUATOR_ACT]) + 4 * i)
    control = read_int32(read_int64(m + at[f.ACTUATOR_CTRL]) + 4 * i)
    limits = view_doubles(read_int64(m + at[f.ACTUATOR_RANGE]) + 16 * control, 2)
    command = min(max(read_double(read_int64(d + at[f.CTRL]) + 8 * control), limits[0]), limits[1])
    if state >= 0:  # MuJoCo clamps what it integrates the rotor with, too
        rotor = read_double(read_int64(d + at[f.ACT]) + 8 * state)
        command = rotor + share_of_lag(table[LAG], ahead) * (command - rotor)
    losses = view_doubles(read_int64(d + at[f.USERDATA]) + 8 * WATER_COLUMNS * nbody, 2 * n)
    thrust = (1.0 - losses[i]) * curve(table, command)
    site, body = site_of(m, at, i)
    if table[N_ADVANCE] > 0.0:
        speed = velocity_at(m, d, at, site, body)[0]
        losses[n + i] = inflow_loss(table, thrust, speed, water_density(m, at))
        thrust *= 1.0 - losses[n + i]
    thrust *= wet_share(m, d, at, site, body, table[RADIUS])
    push_at(m, d, at, site, body, (thrust, 0.0, 0.0), table[TORQUE], work)


@njit
def inflow_loss(table: Floats, thrust: float, speed: float, density: float) -> float:
    """Which share of its thrust at rest [N] a propeller loses at a speed along its axis [m/s]."""
    if thrust == 0.0:
        return 0.0
    inflow = (1.0 - table[WAKE]) * (speed if thrust > 0.0 else -speed)
    if inflow <= 0.0:
        return 0.0
    diameter = 2.0 * table[RADIUS]
    tip = math.sqrt(abs(thrust) / (density * table[ADVANCE + 1])) / diameter  # n D [m/s]
    lost: float = 1.0 - thrust_coefficient(table, inflow / tip) / table[ADVANCE + 1]
    return lost


@njit
def thrust_coefficient(table: Floats, advance: float) -> float:
    """KT at an advance ratio from 0 on: linear between the points and beyond the last."""
    n = int(table[N_ADVANCE])
    k = 1
    while k < n - 1 and table[ADVANCE + 2 * k] < advance:
        k += 1
    first, second = ADVANCE + 2 * (k - 1), ADVANCE + 2 * k
    share = (advance - table[first]) / (table[second] - table[first])
    found: float = table[first + 1] + share * (table[second + 1] - table[first + 1])
    return found


@njit
def share_of_lag(time_constant: float, time: float) -> float:
    """Share of a step that a first-order lag covers in a time, 0..1."""
    if time_constant <= 0.0:
        return 1.0
    x = time / time_constant
    if x < 0.01:
        return x * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x / 24.0)))  # quickly, to 1e-12
    return -math.expm1(-x)


@njit
def curve(table: Floats, command: float) -> float:
    """Thrust at rest [N] of a command: dead zone, polynomial of its sign, saturation."""
    x = abs(command) - table[DEAD_ZONE]
    if x <= 0.0:
        return 0.0
    first = FORWARD if command > 0.0 else BACKWARD
    thrust = 0.0
    for i in range(CURVE_TERMS - 1, -1, -1):
        thrust = (thrust + table[first + i]) * x
    if command < 0.0:
        thrust = -thrust
    limited: float = min(max(thrust, table[MIN_THRUST]), table[MAX_THRUST])
    return limited
