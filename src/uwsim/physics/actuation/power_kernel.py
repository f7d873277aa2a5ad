"""Thrusts, efforts and electric power, compiled because evaluated at every step (`power`)."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.calls import address_of
from ...base.numerics.jit import njit
from ...base.numerics.memory import carray, pointer, view_doubles, view_int64s
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


POWERS = np.dtype(
    [
        *((name, np.int64) for name in ("tables", "n_terms", "rotors", "rotor_traits", "n_rotors")),
        *((name, np.int64) for name in ("curves", "n_curves", "curve_columns", "controls", "nu")),
        *((name, np.int64) for name in ("states", "na", "userdata", "n_userdata")),
        *((name, np.int64) for name in ("sites", "n_sites", "motors", "motor_traits", "n_motors")),
        *((name, np.int64) for name in ("gains", "gain_columns", "biases", "bias_columns")),
        *((name, np.int64) for name in ("qpos", "nq", "qvel", "applied", "nv")),
        ("still", np.float64),  # height of the still water's surface [m]
        ("timestep", np.float64),  # [s]
    ]
)
"""Addresses and lengths of the arrays that `powers` takes."""


def powers_record(tables: Array, thrusters: Rotors, joints: Motors) -> npt.NDArray[np.void]:
    """Return the record of `POWERS` of what `powers` takes, (1,); the arrays have to live on."""
    rotors, traits, curves, still, controls, states, userdata, sites = thrusters
    dt, motors, motor_traits, gains, biases, _, qpos, qvel, applied = joints
    row = np.zeros(1, POWERS)
    arrays = {
        "tables": tables, "rotors": rotors, "rotor_traits": traits, "curves": curves,
        "controls": controls, "states": states, "userdata": userdata, "sites": sites,
        "motors": motors, "motor_traits": motor_traits, "gains": gains, "biases": biases,
        "qpos": qpos, "qvel": qvel, "applied": applied,
    }  # fmt: skip
    for name, array in arrays.items():
        if not array.flags.c_contiguous:
            raise ValueError(f"{name} is not contiguous")
        row[name] = address_of(array)
    row["n_terms"], row["n_rotors"], row["n_motors"] = tables.shape[2], len(rotors), len(motors)
    row["n_curves"], row["curve_columns"] = curves.shape
    row["nu"], row["na"], row["n_userdata"] = len(controls), len(states), len(userdata)
    row["n_sites"], row["gain_columns"] = len(sites), gains.shape[1]
    row["bias_columns"], row["nq"], row["nv"] = biases.shape[1], len(qpos), len(qvel)
    row["still"], row["timestep"] = still, dt
    return row


def write_powers(parameters: int, values: int, time: float) -> None:
    """Write what `powers` returns; see `uwsim.base.numerics.calls`."""
    p = carray(pointer(parameters), (1,), POWERS)[0]
    n, m, controls = p.n_rotors, p.n_motors, view_doubles(p.controls, p.nu)
    rotors = (
        view_int64s(p.rotors, 7 * n).reshape((n, 7)),
        view_doubles(p.rotor_traits, 3 * n).reshape((n, 3)),
        view_doubles(p.curves, p.n_curves * p.curve_columns).reshape((p.n_curves, p.curve_columns)),
        p.still,
        controls,
        view_doubles(p.states, p.na),
        view_doubles(p.userdata, p.n_userdata),
        view_doubles(p.sites, 3 * p.n_sites).reshape((p.n_sites, 3)),
    )
    motors = (
        p.timestep,
        view_int64s(p.motors, 4 * m).reshape((m, 4)),
        view_doubles(p.motor_traits, 3 * m).reshape((m, 3)),
        view_doubles(p.gains, p.n_curves * p.gain_columns).reshape((p.n_curves, p.gain_columns)),
        view_doubles(p.biases, p.n_curves * p.bias_columns).reshape((p.n_curves, p.bias_columns)),
        controls,
        view_doubles(p.qpos, p.nq),
        view_doubles(p.qvel, p.nv),
        view_doubles(p.applied, p.nv),
    )
    tables = view_doubles(p.tables, 2 * n * p.n_terms).reshape((n, 2, p.n_terms))
    view_doubles(values, n + m)[:] = powers(tables, rotors, motors)
