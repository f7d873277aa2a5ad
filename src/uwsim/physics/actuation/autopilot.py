r"""Autopilot: the velocity, depth, heading and position loops of a vehicle.

A command is held until the next, of whatever kind; what it takes over begins at the present place.

*Velocity.* Each of surge, sway, heave and yaw has a loop on the velocity relative to the water
(what a vehicle without bottom lock can know), or to the ground:

.. math:: \tau = M (\dot\nu_r + k_v (\nu_r - \nu) + k_i \int (\nu_r - \nu)\,dt)
    + D(\nu_r) + v \times A v

with M the mass and added mass, D the drag and the last term against the Munk moment of the added
mass A. What is followed, :math:`\nu_r`, goes after what is wanted with a lag of :math:`2.5\,T` (a
reference model: Fossen, *Handbook of Marine Craft*, section 12.1), so that a step is not overshot;
T is the lag of the slowest thruster. The gains follow from it, too: :math:`k_v = 0.32/T`,
:math:`k_i = 0.032/T^2` give the loop :math:`T s^3 + s^2 + k_v s + k_i` the poles
:math:`0.2/T, 0.4/T, 0.4/T`: it does not swing. A faster loop swings by itself and, through a camera
that tilts with the hull, keeps a roll up that no thruster damps. Where the thrusters are at their
limits the integral does not grow (clamping). *Depth and heading* are held where the last command
left them: their loops wish for a heave or yaw rate in proportion to the error. *Position* hold
wishes for a surge and sway in proportion to the error as well, at most 0.5 m/s, over ground: who
knows where they are know how they move. *Wrench*: shared out, nothing is held. *Thrusters*: their
commands as they are. *Pitch* and, where thrusters reach it beside the other axes, *roll* are
righted: the angle is the integral of the rate, and pulls with :math:`k_i` as the others' integrals
do. Forces are shared out by least squares and turned into commands by the thrusters' own curves;
where they are not enough, surge and sway go short.

*Axes that the thrusters cannot drive* (`uwsim.physics.actuation.allocation`) are let go: nothing is
asked of thrusters for them, and their integrals stay 0. Where pitch is driven and heave is not,
depth is held by the angle :math:`\gamma` at which the vehicle goes ahead, with the climb c wished
for and the speed u

.. math:: \gamma = c\,u / (u^2 + u_0^2), \qquad |\gamma| \le 0.35

Where pitch is not driven, surge wished for fades out while the hull leans by `LEVEL` to `STEEP`, so
that what it cannot right does not take it to the surface or the floor.

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
from .allocation import ROLL, Allocation, allocate, curve
from .records import AUTOPILOT, AUTOPILOT_STATE, POSITION, THRUSTER, THRUSTERS, VELOCITY, WRENCH

USUAL = (0, 1, 2, 4, 5)
"""Surge, sway, heave, pitch and yaw: of a commanded wrench where thrusters do not reach roll."""
ALL = (0, 1, 2, 3, 4, 5)


@dataclass(frozen=True, kw_only=True)
class Gains:
    """Gains of the control loops."""

    depth: float = 0.4
    """Heave wished for per depth error [1/s]."""
    position: float = 0.4
    """Surge and sway wished for per position error [1/s]."""
    heading: float = 0.5
    """Yaw rate wished for per heading error [1/s]."""


MIN_LAG = 0.08
"""Thrusters are taken to lag by this at least: the autopilot thinks every 20 ms [s]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Seat:
    """Where the engine keeps what an autopilot reads and sets."""

    place: int
    """Of the base in ``qpos``."""
    dof: int
    """Of the base among the degrees of freedom."""
    body: int
    """The base."""
    controls: Sequence[int]
    """Of the thrusters in ``ctrl``."""
    is_over_ground: bool
    """Whether velocities are those over ground."""


@dataclass(slots=True)
class AutopilotState(Record):
    """What an autopilot does."""

    loops: npt.NDArray[np.void]
    """Its loops, (1,) of `records.AUTOPILOT_STATE`."""
    commands: Array
    """The commands of the thrusters that are passed on, (n,) [1]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class AutopilotModel:
    """What an autopilot knows of its vehicle; it does not change while a simulation runs."""

    reference: Array
    """What forces and moments are about, in the base's frame, (3,) [m]."""
    allocation: Allocation
    """The thrust allocation."""
    loops: npt.NDArray[np.void]
    """The parameters of its loops, (1,) of `records.AUTOPILOT`."""
    thrusters: npt.NDArray[np.void]
    """The parameters of its thrusters, (n,) of `records.THRUSTER`."""


def autopilot_model(
    vehicle: VehicleHydrodynamics,
    link: str,
    mass: float,
    seat: Seat,
    *,
    stiffness: float,
    thrusters: Sequence[ThrusterSpec],
) -> AutopilotModel:
    """Prepare the loops of a vehicle.

    Args:
        vehicle: its hydrodynamics.
        link: its base.
        mass: of the whole vehicle with its arm [kg].
        seat: where the engine keeps it.
        stiffness: with which the hull rights itself [N m/rad].
        thrusters: in the base's frame.
    """
    body = vehicle.body(link)
    reference = np.array(body.reference if body else (0.0, 0.0, 0.0))
    allocation = allocate(thrusters, reference, stiffness)
    loops = _autopilot_record(vehicle, link, mass, Gains(), allocation)
    for name in ("place", "dof", "body", "is_over_ground"):
        loops[name] = getattr(seat, name)
    records = _thruster_records(thrusters, allocation, loops)
    records["control"] = seat.controls
    loops.flags.writeable = records.flags.writeable = False
    return AutopilotModel(
        reference=reference, allocation=allocation, loops=loops, thrusters=records
    )


class Autopilot:
    """The autopilot of one vehicle: velocity loops; depth, heading and position hold.

    It takes the commands; `autopilot_kernel.steer` does what they ask for.

    Args:
        model: what it knows of the vehicle.
    """

    def __init__(self, model: AutopilotModel) -> None:
        self._model = model
        self._state = np.zeros(1, AUTOPILOT_STATE)
        self._state["heading"] = np.eye(3)
        self._mode: Array = self._state["mode"]
        self._wanted: Array = self._state["wanted"][0]
        self._integral: Array = self._state["integral"]
        self._commands = np.zeros(len(model.thrusters))
        self.state = AutopilotState(self._state, self._commands)
        """What it does."""

    @property
    def addresses(self) -> tuple[int, int, int, int, int]:
        """Of its records: what it knows, its state, its thrusters, its commands; how many."""
        records = (self._model.loops, self._state, self._model.thrusters, self._commands)
        knows, state, thrusters, commands = (each.ctypes.data for each in records)
        return knows, state, thrusters, commands, len(self._commands)

    def hold(self, world_from_base: Pose) -> None:
        """Hold the present depth and heading, at rest, and reset the loops."""
        state = self._state
        state["mode"], state["takes_over"] = VELOCITY, False
        for name in ("wanted", "model", "integral"):
            state[name] = 0.0
        state["target"][:, 2] = world_from_base.position[2]
        state["heading"] = world_from_base.rotation

    def command(self, linear: Sequence[float], angular: Sequence[float]) -> None:
        """Take a twist [m/s, rad/s] in the base frame; it is held until the next."""
        self._change_to(VELOCITY, takes_over=True)
        self._wanted[:] = [min(max(x, -MAX_COMMAND), MAX_COMMAND) for x in (*linear, *angular)]

    def go_to(self, world_from_base: Pose) -> None:
        """Go to a place and its heading, and stay there; roll and pitch are not followed."""
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
        """Pass the commands of the thrusters on, (n,) [1]."""
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
    """The parameters of a vehicle's loops, (1,)."""
    body = vehicle.body(link)
    lag = max([MIN_LAG, *(thruster.time_constant for thruster in vehicle.thrusters)])
    added = matrix(body.added_mass) if body else np.zeros((6, 6))
    own = [mass, mass, mass, *(body.inertia[:3] if body and body.inertia else (1.0,) * 3)]
    # a wrench that is commanded is given as nearly as thrusters can, whatever comes with it
    asked = ALL if ROLL in allocation.axes else USUAL
    found = np.zeros(1, AUTOPILOT)
    found["lag"] = 2.5 * lag
    found["depth"], found["position"] = gains.depth, gains.position
    found["heading"] = gains.heading
    found["velocity"], found["integral"] = 0.32 / lag, 0.032 / lag**2
    found["mass"] = np.array(own) + np.diag(added)
    found["added"] = np.diag(added)
    if body:
        found["linear"] = np.diag(matrix(body.linear_damping))
        found["quadratic"] = np.diag(matrix(body.quadratic_damping))
        found["reference"] = body.reference
    for name, axes in (("axes", allocation.axes), ("asked", asked)):
        found[f"n_{name}"] = len(axes)
        found[name][0, : len(axes)] = axes
    found["drives"], found["max_force"] = allocation.drives, allocation.most
    return found


def _thruster_records(
    thrusters: Sequence[ThrusterSpec], allocation: Allocation, autopilot: npt.NDArray[np.void]
) -> npt.NDArray[np.void]:
    """The parameters of the thrusters, (n,)."""
    n_axes, asked = len(allocation.axes), autopilot["asked"][0, : autopilot["n_asked"][0]].tolist()
    rows = np.ascontiguousarray(allocation.wrenches[asked])
    found = np.zeros(len(thrusters), THRUSTER)
    found["min_thrust"], found["max_thrust"] = allocation.least, allocation.greatest
    found["share"][:, :n_axes] = allocation.share
    found["reached"][:, :n_axes] = allocation.reached.T
    found["nearest"][:, : len(asked)] = pseudo_inverse(rows, rcond=1e-6)
    for record, thruster in zip(found, thrusters, strict=True):
        record["thrusts"], record["commands"] = curve(thruster)
    return found
