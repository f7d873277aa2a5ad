"""Thrusts, efforts and electric power, compiled because evaluated at every step (`power`)."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.jit import njit
from ..hydrodynamics.columns import WATER_COLUMNS
from ..hydrodynamics.kernel.thrusters import curve

STATE, CONTROL, SITE, BODY, LOSS, INFLOW, ACTUATOR = range(7)
"""Columns of the rotors' addresses in the engine; a state below 0 is none."""
MIN_COMMAND, MAX_COMMAND, RADIUS = range(3)
"""Columns of the rotors' traits: ends of the command [1], radius [m]."""
PLACE, DOF, INPUT, SERVO = range(4)
"""Columns of the motors' addresses in the engine."""
MAX_EFFORT, EFFICIENCY, COPPER = range(3)
"""Columns of the motors' traits: greatest effort [N m or N], efficiency [1], copper loss."""

Ints = npt.NDArray[np.int64]
Rotors = tuple[Ints, Array, Array, float, Array, Array, Array, Array]
"""What `thrusts` takes."""
Motors = tuple[float, Ints, Array, Array, Array, Array, Array, Array, Array]
"""What `efforts` takes."""


@njit
def thruster_power(table: Array, thrust: float) -> float:
    """Return the electric power of a thruster at a thrust [N], in watts.

    Args:
        table: forward and backward (2, 1 + n): scale of the law [W/N^1.5], coefficients of the
            polynomial [W/N, W/N2, ...]; one of them is 0 (`power.power_table`).
        thrust: given [N].
    """
    size = abs(thrust)
    row = 0 if thrust >= 0.0 else 1
    power = 0.0
    for i in range(table.shape[1] - 1, 0, -1):
        power = (power + table[row, i]) * size
    drawn: float = max(power + table[row, 0] * size * math.sqrt(size), 0.0)
    return drawn


@njit
def joint_power(efficiency: float, copper_loss: float, effort: float, speed: float) -> float:
    """Return the electric power of a joint's motor [W] at [N m or N] and [rad/s or m/s]."""
    return max(0.0, effort * speed) / efficiency + copper_loss * effort**2


@njit
def thrusts(
    rotors: Ints,
    traits: Array,
    curves: Array,
    still: float,
    controls: Array,
    states: Array,
    userdata: Array,
    sites: Array,
) -> Array:
    """Return the thrusts along the thrusters' directions, as the water has it, (n,) [N].

    Args:
        rotors: addresses, (n, 7).
        traits: (n, 3).
        curves: the engine's ``actuator_user``.
        still: height of the still water's surface [m].
        controls: its ``ctrl``.
        states: its ``act``.
        userdata: its ``userdata``.
        sites: its ``site_xpos``.
    """
    given = np.empty(len(rotors))
    for i in range(len(rotors)):
        state, control, site, body, loss, inflow, actuator = rotors[i]
        command = controls[control] if state < 0 else states[state]
        surface = still + userdata[WATER_COLUMNS * body + 6]
        wet = 0.5 + 0.5 * (surface - sites[site, 2]) / traits[i, RADIUS]
        command = min(max(command, traits[i, MIN_COMMAND]), traits[i, MAX_COMMAND])
        thrust = (1.0 - userdata[loss]) * curve(curves[actuator], command)
        thrust *= 1.0 - userdata[inflow]
        given[i] = thrust * min(max(wet, 0.0), 1.0)
    return given


@njit
def efforts(
    dt: float,
    motors: Ints,
    traits: Array,
    gains: Array,
    biases: Array,
    controls: Array,
    qpos: Array,
    qvel: Array,
    applied: Array,
) -> Array:
    """Return the efforts that acted on the joints in the last step, (m,) [N m or N].

    The engine pulls towards the target from where the joint was, and damps the speed that it has
    after the step.

    Args:
        dt: length of the step [s].
        motors: addresses, (m, 4).
        traits: (m, 3).
        gains: the engine's ``actuator_gainprm``.
        biases: its ``actuator_biasprm``.
        controls: its ``ctrl``.
        qpos: its positions.
        qvel: its velocities.
        applied: its ``qfrc_applied``.
    """
    acted = np.empty(len(motors))
    for i in range(len(motors)):
        place, dof, control, servo = motors[i]
        before = qpos[place] - qvel[dof] * dt
        pull = gains[servo, 0] * controls[control]
        pull += biases[servo, 1] * before + biases[servo, 2] * qvel[dof]
        strongest = traits[i, MAX_EFFORT]
        acted[i] = min(max(pull, -strongest), strongest) + applied[dof]
    return acted


@njit
def powers(tables: Array, thrusters: Rotors, joints: Motors) -> Array:
    """Return the electric power of the thrusters, then of the joints, (n + m,) [W].

    Args:
        tables: of `thruster_power`, (n, 2, 1 + k).
        thrusters: what `thrusts` takes.
        joints: what `efforts` takes.
    """
    given, acted = thrusts(*thrusters), efforts(*joints)
    _, motors, traits, _, _, _, _, qvel, _ = joints
    n = len(given)
    drawn = np.empty(n + len(acted))
    for i in range(n):
        drawn[i] = thruster_power(tables[i], given[i])
    for i in range(len(acted)):
        speed = qvel[motors[i, DOF]]
        drawn[n + i] = joint_power(traits[i, EFFICIENCY], traits[i, COPPER], acted[i], speed)
    return drawn
