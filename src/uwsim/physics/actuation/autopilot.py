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

The autopilot knows the true state. Not modelled: noise and delay of its sensors.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ...geometry import Array, Pose
from ...linear import pseudo_inverse
from ...vehicle import MAX_COMMAND
from ..hydrodynamics.spec import ThrusterSpec, VehicleHydrodynamics, matrix
from .allocation import N_POINTS, ROLL, allocate, curve

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
Mode = Literal["velocity", "position", "wrench", "thrusters"]


class Autopilot:
    """The autopilot of one vehicle: velocity loops; depth, heading and position hold."""

    STATE = (
        "_wanted",
        "_model",
        "_integral",
        "_mode",
        "has_news",
        "_takes_over",
        "_target",
        "_heading",
        "_wrench",
        "_commands",
    )
    """What of it changes as time goes by."""

    def __init__(
        self,
        vehicle: VehicleHydrodynamics,
        link: str,
        mass: float,
        gains: Gains | None = None,
        *,
        stiffness: float = math.inf,
        thrusters: Sequence[ThrusterSpec] | None = None,
    ) -> None:
        """Prepare the loops of a vehicle.

        Args:
            vehicle: its hydrodynamics.
            link: its base.
            mass: of the whole vehicle with its arm [kg].
            gains: how hard the loops pull.
            stiffness: with which the hull rights itself [N m/rad].
            thrusters: in the base's frame; without those of the set, all on the base.
        """
        from . import autopilot_kernel

        self._law = autopilot_kernel
        body = vehicle.body(link)
        gains = gains or Gains()
        lag = max([MIN_LAG, *(thruster.time_constant for thruster in vehicle.thrusters)])
        held = [gains.depth, gains.position, gains.heading]
        self._lag = 2.5 * lag
        self._gains = np.array([*held, 0.32 / lag, 0.032 / lag**2])  # the last in [1/s], [1/s2]
        added = matrix(body.added_mass) if body else np.zeros((6, 6))
        own = [mass, mass, mass, *(body.inertia[:3] if body and body.inertia else (1.0,) * 3)]
        self._reference = np.array(body.reference if body else (0.0, 0.0, 0.0))
        self._traits = (
            np.array(own) + np.diag(added),  # (6,) [kg, kg m2]
            np.diag(added).copy(),
            np.diag(matrix(body.linear_damping)).copy() if body else np.zeros(6),
            np.diag(matrix(body.quadratic_damping)).copy() if body else np.zeros(6),
            self._reference,
        )
        thrusters = vehicle.thrusters if thrusters is None else thrusters
        self.allocation = allocate(thrusters, self._reference, stiffness)
        """What the thrusters can do."""
        found = self.allocation
        self._axes = np.array(found.axes, dtype=np.int64)
        self._reached, self._share = found.reached, found.share  # (k, n), (n, k)
        self._drives, self._most = found.drives, found.most  # (6,)
        self._least, self._greatest = found.least, found.greatest  # (n,) [N]
        # a wrench that is commanded is given as nearly as thrusters can, whatever comes with it
        asked = ALL if ROLL in found.axes else USUAL
        self._asked = np.array(asked, dtype=np.int64)
        rows = np.ascontiguousarray(found.wrenches[list(asked)])
        self._nearest = np.ascontiguousarray(pseudo_inverse(rows, rcond=1e-6))  # (n, k)
        curves = [curve(thruster) for thruster in thrusters]
        self._curves = (
            np.array([thrusts for thrusts, _ in curves]).reshape(-1, N_POINTS),
            np.array([commands for _, commands in curves]).reshape(-1, N_POINTS),
        )
        self._wanted = np.zeros(6)  # [m/s, rad/s]
        self._model = np.zeros(6)  # the velocity that is followed [m/s, rad/s]
        self._integral = np.zeros(6)
        self._mode: Mode = "velocity"
        self.has_news = False
        """Whether forces or thrusts were commanded that it has not given yet."""
        self._takes_over = False  # whether depth and heading are still to be taken from the pose
        self._target = np.zeros(3)  # position and height to hold, W [m]
        self._heading = np.eye(3)  # world_from_base whose yaw is to be held
        self._wrench = np.zeros(6)  # force and moment about the reference [N, N m]
        self._commands = np.zeros(len(vehicle.thrusters))

    @property
    def is_over_ground(self) -> bool:
        """Whether it needs the velocity over ground now."""
        return self._mode == "position"

    def hold(self, world_from_base: Pose) -> None:
        """Hold the present depth and heading, at rest, and reset the loops."""
        self._mode, self._takes_over = "velocity", False
        self._wanted[:] = 0.0
        self._model[:] = 0.0
        self._integral[:] = 0.0
        self._target[2] = world_from_base.position[2]
        self._heading = world_from_base.rotation.copy()

    def command(self, linear: Sequence[float], angular: Sequence[float]) -> None:
        """Take a twist [m/s, rad/s] in the base frame; it is held until the next."""
        if self._mode != "velocity":
            self._mode, self._takes_over = "velocity", True
            self._integral[:] = 0.0
        self._wanted[:] = np.clip([*linear, *angular], -MAX_COMMAND, MAX_COMMAND)

    def go_to(self, world_from_base: Pose) -> None:
        """Go to a place and its heading, and stay there; roll and pitch are not followed."""
        if self._mode != "position":
            self._mode = "position"
            self._integral[:] = 0.0
        self._takes_over = False
        self._wanted[:] = 0.0
        self._target = np.clip(world_from_base.position, -MAX_COMMAND, MAX_COMMAND)
        self._heading = world_from_base.rotation.copy()

    def push(self, force: Array, torque: Array) -> None:
        """Allocate a force [N] and a torque about the base's origin [N m], base axes."""
        self._mode, self.has_news = "wrench", True
        force, torque = np.clip([force, torque], -MAX_COMMAND, MAX_COMMAND)
        self._wrench = np.concatenate([force, torque - np.cross(self._reference, force)])

    def set_thrusters(self, commands: Array) -> None:
        """Pass the commands of the thrusters on, (n,) [1]."""
        self._mode, self.has_news = "thrusters", True
        self._commands = commands.copy()

    def commands(self, world_from_base: Pose, velocity: Array, dt: float) -> Array:
        """Return the commands of the thrusters, (n,) [1].

        Args:
            world_from_base: where the base is.
            velocity: of the base, relative to water or ground, base axes, (6,) [m/s, rad/s].
            dt: time since the last call [s].
        """
        self.has_news = False
        if self._mode == "thrusters":
            return self._commands
        if self._mode == "wrench":
            forces = self._law.shared(self._wrench, self._asked, self._nearest)
            return self._law.commands(forces, *self._curves)
        if self._takes_over:
            self._takes_over = False
            self._model[:] = velocity
            self._target[2] = world_from_base.position[2]
            self._heading = world_from_base.rotation.copy()
        forces = self._law.loops(
            dt,
            self._lag,
            self._mode == "position",
            self._gains,
            world_from_base.position,
            world_from_base.rotation,
            velocity,
            self._wanted,
            self._target,
            self._heading,
            *self._traits,
            self._axes,
            self._share,
            self._reached,
            self._least,
            self._greatest,
            self._drives,
            self._most,
            self._model,
            self._integral,
        )
        return self._law.commands(forces, *self._curves)
