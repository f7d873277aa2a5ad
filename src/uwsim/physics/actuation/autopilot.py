r"""Autopilot of a vehicle: control loops of velocity, depth, heading and position.

Each command is in effect until the next command of any kind. A new command takes the present depth
and heading as setpoints.

*Velocity.* Surge, sway, heave and yaw each have a loop that controls the velocity :math:`\nu`
through the water (as a vehicle without bottom lock measures it), or over ground:

.. math:: \tau = M (\dot\nu_r + k_v (\nu_r - \nu) + k_i \int (\nu_r - \nu)\,dt)
    + D(\nu_r) + v \times A v

M is the mass and added mass, D the drag, and the last term cancels the Munk moment of the added
mass A; v is the linear velocity. The reference :math:`\nu_r` follows the desired twist
:math:`\nu_d` with the time constant :math:`2.5\,T` (a reference model: Fossen, *Handbook of Marine
Craft*, section 12.1), which avoids overshoot. T is the time constant of the slowest thruster. With
the gains :math:`k_v = 0.32/T` and :math:`k_i = 0.032/T^2` the characteristic polynomial
:math:`T s^3 + s^2 + k_v s + k_i` has the poles :math:`-0.2/T, -0.4/T, -0.4/T`, so the loop does not
oscillate. A faster loop would. If its error came from a camera that tilts with the hull, it would
also excite a roll that no thruster damps. While thrusters are at their limits the integral does not
grow (clamping).

*Depth and heading* are held at their setpoints: the desired heave and yaw rate are proportional to
the error. *Position* hold also makes the desired surge and sway proportional to the error, at most
0.5 m/s, and controls the velocity over ground. A commanded *wrench* is allocated to the thrusters
without any control loop. *Thruster* commands are passed on unchanged. *Pitch*, and *roll* where the
thrusters drive it, are kept level: the angle is the integral of the angular rate, and has the gain
:math:`k_i`. Forces are allocated to the thrusters by least squares and converted to commands by the
thrust curves. If thrusts exceed their limits, surge and sway are reduced.

*Axes that are not driven* (`uwsim.physics.actuation.allocation`) have no force, and their integrals
are 0. If pitch is driven and heave is not, depth is controlled by pitch. With the desired climb
rate c and the forward speed u, the desired pitch is

.. math:: \gamma = c\,u / (u^2 + u_0^2), \qquad |\gamma| \le 0.35

If pitch is not driven, the desired surge decreases to 0 as the tilt grows from `FADE_START` to
`FADE_END`, so that a tilted vehicle does not reach the surface or the floor.

The autopilot receives the true state. Not modelled: noise and delay of its sensors.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...base.external_values import MAX_COMMAND
from ...base.geometry import Array, Pose
from ...base.numerics.linear import pseudo_inverse
from ...base.record import Record
from ...scene.hydrodynamics.spec import ThrusterSpec, VehicleHydrodynamics, matrix
from .allocation import ROLL, Allocation, allocate, thrust_curve
from .records import AUTOPILOT, AUTOPILOT_STATE, POSITION, THRUSTER, THRUSTERS, VELOCITY, WRENCH

WRENCH_AXES_WITHOUT_ROLL = (0, 1, 2, 4, 5)
"""The axes of a commanded wrench that are allocated if the thrusters do not drive roll."""
WRENCH_AXES = (0, 1, 2, 3, 4, 5)
"""The axes of a commanded wrench that are allocated if the thrusters drive roll."""


@dataclass(frozen=True, kw_only=True)
class Gains:
    """The gains of the outer control loops."""

    depth: float = 0.4
    """The desired climb rate per depth error [1/s]."""
    position: float = 0.4
    """The desired surge and sway velocity per position error [1/s]."""
    heading: float = 0.5
    """The desired yaw rate per heading error [1/s]."""


MIN_LAG = 0.08
"""The minimum time constant that the gains assume for thrusters, as the autopilot runs every 20 ms
[s]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class BaseAddresses:
    """The indices of a vehicle's base and thrusters in the engine's arrays."""

    qpos_address: int
    """The index of the base's pose in ``qpos``."""
    dof_address: int
    """The index of the first degree of freedom of the base."""
    body: int
    """The index of the base among the engine's bodies."""
    ctrl_addresses: Sequence[int]
    """The indices of the thrusters' commands in ``ctrl``."""
    is_over_ground: bool
    """True if the velocity loops control the velocity over ground, else through the water."""


@dataclass(slots=True)
class AutopilotState(Record):
    """The state of an autopilot."""

    loops: npt.NDArray[np.void]
    """The state of the control loops, a record of `records.AUTOPILOT_STATE`, (1,)."""
    commands: Array
    """The last thruster commands that were set directly, (n,) [1]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class AutopilotModel:
    """The parameters of an autopilot, which do not change while a simulation runs."""

    reference: Array
    """The point about which moments are computed, in the base's frame, (3,) [m]."""
    allocation: Allocation
    """The thrust allocation of the vehicle."""
    loops: npt.NDArray[np.void]
    """The parameters of the control loops, a record of `records.AUTOPILOT`, (1,)."""
    thrusters: npt.NDArray[np.void]
    """The parameters of the thrusters, records of `records.THRUSTER`, (n,)."""


def autopilot_model(
    vehicle: VehicleHydrodynamics,
    link: str,
    mass: float,
    addresses: BaseAddresses,
    *,
    stiffness: float,
    thrusters: Sequence[ThrusterSpec],
) -> AutopilotModel:
    """Compute the parameters of a vehicle's autopilot.

    Args:
        vehicle: the vehicle's hydrodynamics.
        link: the name of the base link.
        mass: the mass of the whole vehicle with its arm [kg].
        addresses: the indices of the base and the thrusters in the engine.
        stiffness: the righting stiffness of the hull [N m/rad].
        thrusters: the thrusters in the base's frame.
    """
    body = vehicle.body(link)
    reference = np.array(body.reference if body else (0.0, 0.0, 0.0))
    allocation = allocate(thrusters, reference, stiffness)
    loops = _autopilot_record(vehicle, link, mass, Gains(), allocation)
    for name in ("qpos_address", "dof_address", "body", "is_over_ground"):
        loops[name] = getattr(addresses, name)
    records = _thruster_records(thrusters, allocation, loops)
    records["ctrl_address"] = addresses.ctrl_addresses
    loops.flags.writeable = records.flags.writeable = False
    return AutopilotModel(
        reference=reference, allocation=allocation, loops=loops, thrusters=records
    )


class Autopilot:
    """The autopilot of one vehicle.

    This class stores commands in the state; `autopilot_kernel.steer` executes them.

    Args:
        model: the parameters of the autopilot.
    """

    def __init__(self, model: AutopilotModel) -> None:
        self._model = model
        self._state = np.zeros(1, AUTOPILOT_STATE)
        self._state["heading_setpoint"] = np.eye(3)
        self._mode: Array = self._state["mode"]
        self._twist: Array = self._state["commanded_twist"][0]
        self._integral: Array = self._state["integral"]
        self._commands = np.zeros(len(model.thrusters))
        self.state = AutopilotState(self._state, self._commands)
        """The state of the control loops, and the last thruster commands."""

    @property
    def addresses(self) -> tuple[int, int, int, int, int]:
        """The memory addresses of parameters, state, thrusters and commands; their number n."""
        records = (self._model.loops, self._state, self._model.thrusters, self._commands)
        parameters, state, thrusters, commands = (record.ctypes.data for record in records)
        return parameters, state, thrusters, commands, len(self._commands)

    def hold(self, world_from_base: Pose) -> None:
        """Reset the loops, and hold the depth and heading of a pose at zero velocity."""
        state = self._state
        state["mode"], state["needs_setpoints"] = VELOCITY, False
        for name in ("commanded_twist", "reference_twist", "integral"):
            state[name] = 0.0
        state["position_setpoint"][:, 2] = world_from_base.position[2]
        state["heading_setpoint"] = world_from_base.rotation

    def set_twist(self, linear: Sequence[float], angular: Sequence[float]) -> None:
        """Set the desired linear [m/s] and angular [rad/s] velocity in base axes."""
        self._change_to(VELOCITY, resets_setpoints=True)
        self._twist[:] = [min(max(x, -MAX_COMMAND), MAX_COMMAND) for x in (*linear, *angular)]

    def go_to(self, world_from_base: Pose) -> None:
        """Set the position and the heading to hold; roll and pitch of the pose have no effect."""
        self._change_to(POSITION, resets_setpoints=False)
        self._state["needs_setpoints"] = False
        self._state["commanded_twist"] = 0.0
        self._state["position_setpoint"] = np.clip(
            world_from_base.position, -MAX_COMMAND, MAX_COMMAND
        )
        self._state["heading_setpoint"] = world_from_base.rotation

    def set_wrench(self, force: Array, torque: Array) -> None:
        """Set the force [N] and the torque about the base's origin [N m] to exert, in base axes."""
        self._state["mode"], self._state["has_new_command"] = WRENCH, True
        force, torque = np.clip([force, torque], -MAX_COMMAND, MAX_COMMAND)
        moment = torque - np.cross(self._model.reference, force)
        self._state["commanded_wrench"] = np.concatenate([force, moment])

    def set_thrusters(self, commands: Array) -> None:
        """Set the commands of the thrusters directly, (n,) [1]."""
        self._state["mode"], self._state["has_new_command"] = THRUSTERS, True
        self._commands[:] = commands

    def _change_to(self, mode: int, *, resets_setpoints: bool) -> None:
        if self._mode[0] != mode:
            self._mode[0] = mode
            if resets_setpoints:
                self._state["needs_setpoints"] = True
            self._integral[:] = 0.0


def _autopilot_record(
    vehicle: VehicleHydrodynamics, link: str, mass: float, gains: Gains, allocation: Allocation
) -> npt.NDArray[np.void]:
    """Return the parameters of a vehicle's control loops, (1,)."""
    body = vehicle.body(link)
    lag = max([MIN_LAG, *(thruster.time_constant for thruster in vehicle.thrusters)])
    added_mass = matrix(body.added_mass) if body else np.zeros((6, 6))
    inertia = body.inertia[:3] if body and body.inertia else (1.0,) * 3
    # a commanded wrench is allocated with least error over these axes, driven or not
    wrench_axes = WRENCH_AXES if ROLL in allocation.axes else WRENCH_AXES_WITHOUT_ROLL
    record = np.zeros(1, AUTOPILOT)
    record["time_constant"] = 2.5 * lag
    record["depth_gain"], record["position_gain"] = gains.depth, gains.position
    record["heading_gain"] = gains.heading
    record["velocity_gain"], record["integral_gain"] = 0.32 / lag, 0.032 / lag**2
    record["mass"] = np.array([mass, mass, mass, *inertia]) + np.diag(added_mass)
    record["added_mass"] = np.diag(added_mass)
    if body:
        record["linear_damping"] = np.diag(matrix(body.linear_damping))
        record["quadratic_damping"] = np.diag(matrix(body.quadratic_damping))
        record["reference_point"] = body.reference
    for name, axes in (("axes", allocation.axes), ("wrench_axes", wrench_axes)):
        record[f"n_{name}"] = len(axes)
        record[name][0, : len(axes)] = axes
    record["driven_mask"], record["max_forces"] = allocation.driven_mask, allocation.max_forces
    return record


def _thruster_records(
    thrusters: Sequence[ThrusterSpec], allocation: Allocation, autopilot: npt.NDArray[np.void]
) -> npt.NDArray[np.void]:
    n_axes = len(allocation.axes)
    wrench_axes = autopilot["wrench_axes"][0, : autopilot["n_wrench_axes"][0]].tolist()
    rows = np.ascontiguousarray(allocation.wrenches[wrench_axes])
    records = np.zeros(len(thrusters), THRUSTER)
    records["min_thrust"], records["max_thrust"] = allocation.min_thrusts, allocation.max_thrusts
    records["allocation"][:, :n_axes] = allocation.inverse_allocation_matrix
    records["wrench"][:, :n_axes] = allocation.driven_wrenches.T
    records["wrench_allocation"][:, : len(wrench_axes)] = pseudo_inverse(rows, rcond=1e-6)
    for record, thruster in zip(records, thrusters, strict=True):
        record["thrusts"], record["commands"] = thrust_curve(thruster)
    return records
