"""Thrusts, efforts and electric power, compiled for evaluation in every step; see `power`."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.calls import address_of
from ...base.numerics.jit import njit
from ...base.numerics.memory import carray, pointer, view_doubles, view_int64s
from ..hydrodynamics.columns import ELEVATION, WATER_COLUMNS
from ..hydrodynamics.kernel.thrusters import static_thrust

STATE, CONTROL, SITE, BODY, LOSS, INFLOW, ACTUATOR = range(7)
"""The columns of the rotors' indices: in ``act`` (below 0 without a state), in ``ctrl``, of the
site and its body, of thrust loss and inflow loss in ``userdata``, and of the actuator."""
MIN_COMMAND, MAX_COMMAND, RADIUS = range(3)
"""The columns of the rotors' properties: command limits [1], radius [m]."""
POSITION, DOF, CONTROL_INPUT, SERVO = range(4)
"""The columns of the motors' indices: in ``qpos``, in ``qvel``, in ``ctrl``, of the actuator."""
MAX_EFFORT, EFFICIENCY, COPPER = range(3)
"""The columns of the motors' properties: effort limit [N m or N], efficiency [1], copper loss
[W/(N m)2 or W/N2]."""

Ints = npt.NDArray[np.int64]
Rotors = tuple[Ints, Array, Array, float, Array, Array, Array, Array]
"""The arguments of `thrusts`."""
Motors = tuple[float, Ints, Array, Array, Array, Array, Array, Array, Array]
"""The arguments of `efforts`."""


@njit
def thruster_power(table: Array, thrust: float) -> float:
    """Return the electric power of a thruster [W].

    Args:
        table: a row for forward and a row for backward thrust, (2, 1 + n): the factor of the
            momentum theory [W/N^1.5], then the coefficients of the polynomial [W/N, W/N2, ...];
            the part that is not used is 0 (`power.power_table`).
        thrust: the present thrust [N].
    """
    size = abs(thrust)
    row = 0 if thrust >= 0.0 else 1
    power = 0.0
    for i in range(table.shape[1] - 1, 0, -1):
        power = (power + table[row, i]) * size
    electric_power: float = max(power + table[row, 0] * size * math.sqrt(size), 0.0)
    return electric_power


@njit
def joint_power(efficiency: float, copper_loss: float, effort: float, speed: float) -> float:
    """Return the electric power of a joint's motor [W].

    Args:
        efficiency: the efficiency of motor and gear [1].
        copper_loss: the copper loss [W/(N m)2 or W/N2].
        effort: the effort of the motor [N m or N].
        speed: the velocity of the joint [rad/s or m/s].
    """
    return max(0.0, effort * speed) / efficiency + copper_loss * effort**2


@njit
def thrusts(
    rotors: Ints,
    properties: Array,
    curves: Array,
    surface_height: float,
    controls: Array,
    states: Array,
    userdata: Array,
    sites: Array,
) -> Array:
    """Return the thrusts along the thrusters' directions in the present water, (n,) [N].

    The inflow into the thrusters is that of the engine's last evaluation of forces.

    Args:
        rotors: the indices of the rotors, with the columns `STATE` to `ACTUATOR`, (n, 7).
        properties: the properties of the rotors, (n, 3).
        curves: the engine's ``actuator_user``.
        surface_height: the height of the still water's surface [m].
        controls: the engine's ``ctrl``.
        states: the engine's ``act``.
        userdata: the engine's ``userdata``.
        sites: the engine's ``site_xpos``.
    """
    rotor_thrusts = np.empty(len(rotors))
    for i in range(len(rotors)):
        state, control, site, body, loss, inflow, actuator = rotors[i]
        command = controls[control] if state < 0 else states[state]
        surface = surface_height + userdata[WATER_COLUMNS * body + ELEVATION]
        submerged_fraction = 0.5 + 0.5 * (surface - sites[site, 2]) / properties[i, RADIUS]
        command = min(max(command, properties[i, MIN_COMMAND]), properties[i, MAX_COMMAND])
        thrust = (1.0 - userdata[loss]) * static_thrust(curves[actuator], command)
        thrust *= 1.0 - userdata[inflow]
        rotor_thrusts[i] = thrust * min(max(submerged_fraction, 0.0), 1.0)
    return rotor_thrusts


@njit
def efforts(
    dt: float,
    motors: Ints,
    properties: Array,
    gains: Array,
    biases: Array,
    controls: Array,
    qpos: Array,
    qvel: Array,
    applied: Array,
) -> Array:
    """Return the efforts that acted on the joints in the last step, (m,) [N m or N].

    With the integrator ``implicitfast``, the engine computes the spring force from the position
    before the step, and the damping from the velocity after it. With ``RK4``, the efforts are
    approximations.

    Args:
        dt: the length of the step [s].
        motors: the indices of the motors, with the columns `POSITION` to `SERVO`, (m, 4).
        properties: the properties of the motors, (m, 3).
        gains: the engine's ``actuator_gainprm``.
        biases: the engine's ``actuator_biasprm``.
        controls: the engine's ``ctrl``.
        qpos: the engine's ``qpos``.
        qvel: the engine's ``qvel``.
        applied: the engine's ``qfrc_applied``.
    """
    joint_efforts = np.empty(len(motors))
    for i in range(len(motors)):
        position, dof, control, servo = motors[i]
        start_position = qpos[position] - qvel[dof] * dt
        effort = gains[servo, 0] * controls[control]
        effort += biases[servo, 1] * start_position + biases[servo, 2] * qvel[dof]
        max_effort = properties[i, MAX_EFFORT]
        joint_efforts[i] = min(max(effort, -max_effort), max_effort) + applied[dof]
    return joint_efforts


@njit
def powers(tables: Array, thrusters: Rotors, joints: Motors) -> Array:
    """Return the electric power of the thrusters, then of the joints, (n + m,) [W].

    Args:
        tables: the tables of `thruster_power`, (n, 2, 1 + k).
        thrusters: the arguments of `thrusts`.
        joints: the arguments of `efforts`.
    """
    rotor_thrusts, joint_efforts = thrusts(*thrusters), efforts(*joints)
    _, motors, properties, _, _, _, _, qvel, _ = joints
    n = len(rotor_thrusts)
    watts = np.empty(n + len(joint_efforts))
    for i in range(n):
        watts[i] = thruster_power(tables[i], rotor_thrusts[i])
    for i in range(len(joint_efforts)):
        speed = qvel[motors[i, DOF]]
        efficiency, copper_loss = properties[i, EFFICIENCY], properties[i, COPPER]
        watts[n + i] = joint_power(efficiency, copper_loss, joint_efforts[i], speed)
    return watts


POWERS = np.dtype(
    [
        *((name, np.int64) for name in ("tables", "n_table_columns", "rotors", "rotor_properties")),
        *((name, np.int64) for name in ("n_rotors", "curves", "n_actuators", "curve_columns")),
        *((name, np.int64) for name in ("controls", "nu", "states", "na", "userdata")),
        *((name, np.int64) for name in ("n_userdata", "sites", "n_sites", "motors")),
        *((name, np.int64) for name in ("motor_properties", "n_motors")),
        *((name, np.int64) for name in ("gains", "gain_columns", "biases", "bias_columns")),
        *((name, np.int64) for name in ("qpos", "nq", "qvel", "applied", "nv")),
        ("surface_height", np.float64),  # the height of the still water's surface [m]
        ("timestep", np.float64),  # [s]
    ]
)
"""The addresses and lengths of the arrays among the arguments of `powers`, and the values of the
numbers among them."""


def powers_record(tables: Array, thrusters: Rotors, joints: Motors) -> npt.NDArray[np.void]:
    """Return a record of `POWERS`, (1,), for the arguments of `powers`, which must outlive it."""
    rotors, rotor_properties, curves, surface_height, controls, states, userdata, sites = thrusters
    dt, motors, motor_properties, gains, biases, _, qpos, qvel, applied = joints
    row = np.zeros(1, POWERS)
    arrays = {
        "tables": tables, "rotors": rotors, "rotor_properties": rotor_properties, "curves": curves,
        "controls": controls, "states": states, "userdata": userdata, "sites": sites,
        "motors": motors, "motor_properties": motor_properties, "gains": gains, "biases": biases,
        "qpos": qpos, "qvel": qvel, "applied": applied,
    }  # fmt: skip
    for name, array in arrays.items():
        if not array.flags.c_contiguous:
            raise ValueError(f"{name} is not contiguous")
        row[name] = address_of(array)
    row["n_table_columns"], row["n_rotors"], row["n_motors"] = (
        tables.shape[2],
        len(rotors),
        len(motors),
    )
    row["n_actuators"], row["curve_columns"] = curves.shape
    row["nu"], row["na"], row["n_userdata"] = len(controls), len(states), len(userdata)
    row["n_sites"], row["gain_columns"] = len(sites), gains.shape[1]
    row["bias_columns"], row["nq"], row["nv"] = biases.shape[1], len(qpos), len(qvel)
    row["surface_height"], row["timestep"] = surface_height, dt
    return row


def write_powers(record_address: int, values_address: int, time: float) -> None:
    """Write the values of `powers`; see `uwsim.base.numerics.calls`."""
    p = carray(pointer(record_address), (1,), POWERS)[0]
    n, m, controls = p.n_rotors, p.n_motors, view_doubles(p.controls, p.nu)
    rotors = (
        view_int64s(p.rotors, 7 * n).reshape((n, 7)),
        view_doubles(p.rotor_properties, 3 * n).reshape((n, 3)),
        view_doubles(p.curves, p.n_actuators * p.curve_columns).reshape(
            (p.n_actuators, p.curve_columns)
        ),
        p.surface_height,
        controls,
        view_doubles(p.states, p.na),
        view_doubles(p.userdata, p.n_userdata),
        view_doubles(p.sites, 3 * p.n_sites).reshape((p.n_sites, 3)),
    )
    motors = (
        p.timestep,
        view_int64s(p.motors, 4 * m).reshape((m, 4)),
        view_doubles(p.motor_properties, 3 * m).reshape((m, 3)),
        view_doubles(p.gains, p.n_actuators * p.gain_columns).reshape(
            (p.n_actuators, p.gain_columns)
        ),
        view_doubles(p.biases, p.n_actuators * p.bias_columns).reshape(
            (p.n_actuators, p.bias_columns)
        ),
        controls,
        view_doubles(p.qpos, p.nq),
        view_doubles(p.qvel, p.nv),
        view_doubles(p.applied, p.nv),
    )
    tables = view_doubles(p.tables, 2 * n * p.n_table_columns).reshape((n, 2, p.n_table_columns))
    view_doubles(values_address, n + m)[:] = powers(tables, rotors, motors)
