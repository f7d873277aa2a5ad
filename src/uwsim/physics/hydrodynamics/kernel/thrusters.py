r"""Thrusters: a static thrust curve, reduced by the inflow.

A propeller of diameter D with n revolutions per second in an inflow of the speed V has the thrust

.. math:: T = \rho n^2 D^4 K_T(J), \qquad J = \frac{V}{n D}

(Carlton, *Marine Propellers and Propulsion*, ch. 6), with the advance ratio J. The thrust curve
states the static thrust :math:`T_0 = \rho n^2 D^4 K_T(0)` for a command, which determines n; the
thrust is :math:`T_0 K_T(J) / K_T(0)`. Inflow from behind has no effect. The coefficients are the
same for backward thrust.

Not modelled: inflow across the propeller's axis, cavitation, the drag of a stopped propeller.
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
from .flow import actuator_site, add_force, site_velocity, submersion, water_density


@njit
def add_thrust(m: int, d: int, o: Ints64, i: int, table: Floats, dt: float, work: Floats) -> None:
    """Add the thrust of a thruster with its rotor state after a time ``dt``.

    Args:
        m: the address of the model.
        d: the address of the data.
        o: the offsets of the fields.
        i: the actuator id of the thruster.
        table: the row of the thruster.
        dt: the time from now [s].
        work: the rows of the bodies.
    """
    n, nbody = read_int64(m + o[f.NACTUATOR]), read_int64(m + o[f.NBODY])
    state = read_int32(read_int64(m + o[f.ACTUATOR_ACT]) + 4 * i)
    control = read_int32(read_int64(m + o[f.ACTUATOR_CTRL]) + 4 * i)
    limits = view_doubles(read_int64(m + o[f.ACTUATOR_RANGE]) + 16 * control, 2)
    command = min(max(read_double(read_int64(d + o[f.CTRL]) + 8 * control), limits[0]), limits[1])
    if state >= 0:  # MuJoCo also clamps the command of the rotor
        rotor = read_double(read_int64(d + o[f.ACT]) + 8 * state)
        command = rotor + lag_share(table[c.LAG], dt) * (command - rotor)
    losses = view_doubles(read_int64(d + o[f.USERDATA]) + 8 * c.WATER_COLUMNS * nbody, 2 * n)
    thrust = (1.0 - losses[i]) * static_thrust(table, command)
    site, body = actuator_site(m, o, i)
    if table[c.N_ADVANCE] > 0.0:
        speed = site_velocity(m, d, o, site, body)[0]
        losses[n + i] = inflow_loss(table, thrust, speed, water_density(m, o))
        thrust *= 1.0 - losses[n + i]
    thrust *= submersion(m, d, o, site, body, table[c.RADIUS])
    add_force(m, d, o, site, body, (thrust, 0.0, 0.0), table[c.TORQUE], work)


@njit_borrowed
def inflow_loss(table: Floats, thrust: float, speed: float, density: float) -> float:
    """Return the fraction of its static thrust that a propeller loses by inflow.

    Args:
        table: the row of the thruster.
        thrust: the static thrust [N].
        speed: the velocity through the water along the direction of thrust [m/s].
        density: the density of the water [kg/m3].
    """
    if thrust == 0.0:
        return 0.0
    inflow = (1.0 - table[c.WAKE]) * (speed if thrust > 0.0 else -speed)
    if inflow <= 0.0:
        return 0.0
    diameter = 2.0 * table[c.RADIUS]
    tip = math.sqrt(abs(thrust) / (density * table[c.ADVANCE + 1])) / diameter  # n D [m/s]
    loss: float = 1.0 - thrust_coefficient(table, inflow / tip) / table[c.ADVANCE + 1]
    return loss


@njit_borrowed
def thrust_coefficient(table: Floats, advance: float) -> float:
    """Return KT at an advance ratio, linear between the points and extrapolated beyond the last."""
    n = int(table[c.N_ADVANCE])
    k = 1
    while k < n - 1 and table[c.ADVANCE + 2 * k] < advance:
        k += 1
    i, j = c.ADVANCE + 2 * (k - 1), c.ADVANCE + 2 * k
    share = (advance - table[i]) / (table[j] - table[i])
    coefficient: float = table[i + 1] + share * (table[j + 1] - table[i + 1])
    return coefficient


@njit_borrowed
def lag_share(time_constant: float, time: float) -> float:
    """Return the fraction of a step input that a first-order lag reaches after a time [s], 0..1."""
    if time_constant <= 0.0:
        return 1.0
    x = time / time_constant
    if x < 0.01:
        return x * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x / 24.0)))  # a fast series, exact to 1e-12
    return -math.expm1(-x)


@njit_borrowed
def static_thrust(table: Floats, command: float) -> float:
    """Return the static thrust for a command [N], with dead zone, thrust curve and saturation."""
    x = abs(command) - table[c.DEAD_ZONE]
    if x <= 0.0:
        return 0.0
    start = c.FORWARD if command > 0.0 else c.BACKWARD
    thrust = 0.0
    for i in range(c.CURVE_TERMS - 1, -1, -1):
        thrust = (thrust + table[start + i]) * x
    if command < 0.0:
        thrust = -thrust
    limited_thrust: float = min(max(thrust, table[c.MIN_THRUST]), table[c.MAX_THRUST])
    return limited_thrust
