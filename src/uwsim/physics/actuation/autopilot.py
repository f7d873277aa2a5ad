r"""Autopilot: the velocity, depth, heading and position loops of a vehicle.

A command holds until the next of any kind. Its loops start at the present depth and heading.

*Velocity.* Each of surge, sway, heave and yaw has a loop on the velocity :math:`\nu` relative to
the water (which a vehicle without bottom lock measures), or to the ground:

.. math:: \tau = M (\dot\nu_r + k_v (\nu_r - \nu) + k_i \int (\nu_r - \nu)\,dt)
    + D(\nu_r) + v \times A v

M is the mass and added mass, D the drag, and the last term cancels the Munk moment of the added
mass A. The reference :math:`\nu_r` follows the desired twist :math:`\nu_d` with the time constant
:math:`2.5\,T` (a reference model: Fossen, *Handbook of Marine Craft*, section 12.1), which avoids
overshoot. T is the time constant of the slowest thruster. The gains :math:`k_v = 0.32/T` and
:math:`k_i = 0.032/T^2` give the loop :math:`T s^3 + s^2 + k_v s + k_i` the poles
:math:`0.2/T, 0.4/T, 0.4/T`: it does not oscillate. A faster loop oscillates. Through a camera that
tilts with the hull it also excites a roll that no thruster damps. Where the thrusters are at their
limits the integral does not grow (clamping).

*Depth and heading* are held where the last command left them: heave and yaw rate are proportional
to the error. *Position* hold also makes surge and sway proportional to the error, at most 0.5 m/s,
over ground: a vehicle with a position has its velocity over ground. *Wrench*: it is allocated, and
nothing is held. *Thrusters*: their commands are passed on. *Pitch* and, where thrusters drive it
beside the other axes, *roll* are levelled: the angle is the integral of the rate, with the gain
:math:`k_i`. Forces are allocated by least squares and converted to commands by the thrusters'
curves. Where they exceed the limits, surge and sway are reduced.

*Axes that are not driven* (`uwsim.physics.actuation.allocation`) get no force, and their integrals
stay 0. Where pitch is driven and heave is not, depth is held by the pitch :math:`\gamma` of a
vehicle with the desired climb rate c and the speed u

.. math:: \gamma = c\,u / (u^2 + u_0^2), \qquad |\gamma| \le 0.35

Where pitch is not driven, the desired surge fades out while the tilt grows from `FADE_START` to
`FADE_END`, so that a tilted vehicle does not reach the surface or the floor.

The autopilot reads the true state. Not modelled: noise and delay of its sensors.
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
"""The axes of a commanded wrench where the thrusters do not drive roll."""
WRENCH_AXES = (0, 1, 2, 3, 4, 5)
"""The axes of a commanded wrench."""


@dataclass(frozen=True, kw_only=True)
class Gains:
    """The gains of the control loops."""

    depth: float = 0.4
    """The desired heave per depth error [1/s]."""
    position: float = 0.4
    """The desired surge and sway per position error [1/s]."""
    heading: float = 0.5
    """The desired yaw rate per heading error [1/s]."""


MIN_LAG = 0.08
"""The least time constant assumed for thrusters: the autopilot runs every 20 ms [s]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class BaseAddresses:
    """The addresses in the engine of a vehicle's base and thrusters."""

    qpos_address: int
    """The address of the base's pose in ``qpos``."""
    dof_address: int
    """The first degree of freedom of the base."""
    body: int
    """The engine's number of the base."""
    ctrl_addresses: Sequence[int]
    """The addresses of the thrusters' commands in ``ctrl``."""
    is_over_ground: bool
    """True if the velocity loops use the velocity over ground, not that through the water."""


@dataclass(slots=True)
class AutopilotState(Record):
    """The state of an autopilot."""

    loops: npt.NDArray[np.void]
    """The state of the control loops, (1,) of `records.AUTOPILOT_STATE`."""
    commands: Array
    """The commands that are passed on to the thrusters, (n,) [1]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class AutopilotModel:
    """The parameters of an autopilot, which do not change while a simulation runs."""

    reference: Array
    """The point that forces and moments are about, in the base's frame, (3,) [m]."""
    allocation: Allocation
    """The thrust allocation."""
    loops: npt.NDArray[np.void]
    """The parameters of the control loops, (1,) of `records.AUTOPILOT`."""
    thrusters: npt.NDArray[np.void]
    """The parameters of the thrusters, (n,) of `records.THRUSTER`."""


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
        link: the name of its base.
        mass: the mass of the whole vehicle with its arm [kg].
        addresses: the addresses in the engine.
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
    """The autopilot of one vehicle: velocity loops; depth, heading and position hold.

    It receives the commands; `autopilot_kernel.steer` carries them out.

    Args:
        model: its parameters.
    """

    def __init__(self, model: AutopilotModel) -> None:
        self._model = model
        self._state = np.zeros(1, AUTOPILOT_STATE)
        self._state["heading"] = np.eye(3)
        self._mode: Array = self._state["mode"]
        self._twist: Array = self._state["wanted"][0]
        self._integral: Array = self._state["integral"]
        self._commands = np.zeros(len(model.thrusters))
        self.state = AutopilotState(self._state, self._commands)
        """The state of the autopilot."""

    @property
    def addresses(self) -> tuple[int, int, int, int, int]:
        """The addresses of parameters, state, thrusters and commands; the number of thrusters."""
        records = (self._model.loops, self._state, self._model.thrusters, self._commands)
        parameters, state, thrusters, commands = (record.ctypes.data for record in records)
        return parameters, state, thrusters, commands, len(self._commands)

    def hold(self, world_from_base: Pose) -> None:
        """Hold the present depth and heading, at rest, and reset the loops."""
        state = self._state
        state["mode"], state["takes_over"] = VELOCITY, False
        for name in ("wanted", "model", "integral"):
            state[name] = 0.0
        state["target"][:, 2] = world_from_base.position[2]
        state["heading"] = world_from_base.rotation

    def command(self, linear: Sequence[float], angular: Sequence[float]) -> None:
        """Set the desired twist [m/s, rad/s] in the base frame, until the next command."""
        self._change_to(VELOCITY, takes_over=True)
        self._twist[:] = [min(max(x, -MAX_COMMAND), MAX_COMMAND) for x in (*linear, *angular)]

    def go_to(self, world_from_base: Pose) -> None:
        """Hold a position and its heading; roll and pitch of the pose have no effect."""
        self._change_to(POSITION, takes_over=False)
        self._state["takes_over"] = False
        self._state["wanted"] = 0.0
        self._state["target"] = np.clip(world_from_base.position, -MAX_COMMAND, MAX_COMMAND)
        self._state["heading"] = world_from_base.rotation

    def push(self, force: Array, torque: Array) -> None:
        """Allocate a force [N] and a torque about the base's origin [N m], base axes."""
        self._state["mode"], self._state["has_news"] = WRENCH, True
        force, torque = np.clip([force, torque], -MAX_COMMAND, MAX_COMMAND)
        moment = torque - np.cross(self._model.reference, force)
        self._state["wrench"] = np.concatenate([force, moment])

    def set_thrusters(self, commands: Array) -> None:
        """Pass commands on to the thrusters, (n,) [1]."""
        self._state["mode"], self._state["has_news"] = THRUSTERS, True
        self._commands[:] = commands

    def _change_to(self, mode: int, *, takes_over: bool) -> None:
        if self._mode[0] != mode:
            self._mode[0] = mode
            if takes_over:
                self._state["takes_over"] = True
            self._integral[:] = 0.0


def _autopilot_record(
    vehicle: VehicleHydrodynamics, link: str, mass: float, gains: Gains, allocation: Allocation
) -> npt.NDArray[np.void]:
    """Return the parameters of a vehicle's control loops, (1,)."""
    body = vehicle.body(link)
    lag = max([MIN_LAG, *(thruster.time_constant for thruster in vehicle.thrusters)])
    added_mass = matrix(body.added_mass) if body else np.zeros((6, 6))
    inertia = body.inertia[:3] if body and body.inertia else (1.0,) * 3
    # a commanded wrench gets the thrusts of least error, whatever undriven axes add
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
    records["allocation"][:, :n_axes] = allocation.allocation_matrix
    records["wrench"][:, :n_axes] = allocation.driven_wrenches.T
    records["wrench_allocation"][:, : len(wrench_axes)] = pseudo_inverse(rows, rcond=1e-6)
    for record, thruster in zip(records, thrusters, strict=True):
        record["thrusts"], record["commands"] = thrust_curve(thruster)
    return records
