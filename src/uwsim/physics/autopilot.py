r"""Autopilot: what a vehicle's own electronics do with a command.

A command is held until the next, of whatever kind; what it takes over begins at the present place.

*Velocity.* Each of surge, sway, heave and yaw has a loop on the velocity relative to the water
(what a vehicle without bottom lock can know), or to the ground:

.. math:: \tau = M k_v (\nu_d - \nu) + k_i \int (\nu_d - \nu)\,dt + D(\nu_d)

with M the mass and added mass and D the drag at the wanted velocity. The gains follow from the lag
:math:`T` of the slowest thruster: :math:`k_v = 0.32/T`, :math:`k_i = 0.032/T^2` give the loop
:math:`T s^3 + s^2 + k_v s + k_i` the poles :math:`0.2/T, 0.4/T, 0.4/T`: it does not swing. A
faster loop swings by itself and, through a camera that tilts with the hull, keeps a roll up that no
thruster damps. Where the thrusters are at their limits the integral does not grow (clamping).
*Depth and heading* are held where the last command left them: their loops wish for a heave or yaw
rate in proportion to the error. *Position* hold wishes for a surge and sway in proportion to the
error as well, at most 0.5 m/s, over ground: who knows where they are know how they move. *Wrench*:
shared out, nothing is held. *Thrusters*: their commands as they are. *Pitch and roll* are damped
and righted as far as the thrusters reach. Forces are shared out by least squares and turned into
commands by the thrusters' own curves.

The autopilot knows the true state. Not modelled: noise and delay of its sensors.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..geometry import Array, Pose
from .hydrodynamics.spec import ThrusterSpec, VehicleHydrodynamics, matrix

AXES = (0, 1, 2, 4, 5)
"""Surge, sway, heave, pitch and yaw: what thrusters usually reach."""


@dataclass(frozen=True, kw_only=True)
class Gains:
    """How hard the loops pull."""

    depth: float = 0.4
    """Heave wished for per depth error [1/s]."""
    position: float = 0.4
    """Surge and sway wished for per position error [1/s]."""
    heading: float = 0.5
    """Yaw rate wished for per heading error [1/s]."""
    righting: float = 4.0
    """Angular acceleration per pitch angle [1/s2]."""


LEAST_LAG = 0.08
"""Thrusters are taken to lag by this at least: the autopilot thinks every 20 ms [s]."""
FASTEST = 0.5
"""What position hold wishes for at most [m/s]."""
LARGEST = 1e6
"""A number of a command is taken as at most this: no vehicle gets there [m, m/s, rad/s, N, N m]."""
Mode = Literal["velocity", "position", "wrench", "thrusters"]


class Autopilot:
    """Velocity loops, holding of depth, heading and position of one vehicle."""

    def __init__(
        self, vehicle: VehicleHydrodynamics, link: str, mass: float, gains: Gains | None = None
    ) -> None:
        """Prepare the loops of a vehicle.

        Args:
            vehicle: its hydrodynamics.
            link: its base.
            mass: of the whole vehicle with its arm [kg].
            gains: how hard the loops pull.
        """
        body = vehicle.body(link)
        self._gains = gains or Gains()
        lag = max([LEAST_LAG, *(thruster.time_constant for thruster in vehicle.thrusters)])
        self._velocity_gain, self._integral_gain = 0.32 / lag, 0.032 / lag**2  # [1/s], [1/s2]
        added = matrix(body.added_mass) if body else np.zeros((6, 6))
        own = [mass, mass, mass, *(body.inertia[:3] if body and body.inertia else (1.0,) * 3)]
        self._mass = np.array(own) + np.diag(added)  # (6,) [kg, kg m2]
        self._linear = np.diag(matrix(body.linear_damping)) if body else np.zeros(6)
        self._quadratic = np.diag(matrix(body.quadratic_damping)) if body else np.zeros(6)
        self._reference = np.array(body.reference if body else (0.0, 0.0, 0.0))
        columns = [_column(thruster, self._reference) for thruster in vehicle.thrusters]
        reached = np.array(columns).reshape(-1, 6).T[list(AXES)]  # (5, n): N, N m per N
        self._reached = reached
        self._share = np.linalg.pinv(reached, rcond=1e-6)  # (n, 5): [N per N or N m]
        self._curves = [_curve(thruster) for thruster in vehicle.thrusters]
        ends = [(thrusts[0], thrusts[-1]) for thrusts, _ in self._curves]
        self._least, self._greatest = np.array(ends).reshape(-1, 2).T  # (n,) [N]
        self._wanted = np.zeros(6)  # [m/s, rad/s]
        self._integral = np.zeros(6)
        self._mode: Mode = "velocity"
        self._takes_over = False  # whether depth and heading are still to be taken from the pose
        self._target = np.zeros(3)  # position to hold, W [m]
        self._wrench = np.zeros(6)  # force and moment about the reference [N, N m]
        self._commands = np.zeros(len(vehicle.thrusters))

    @property
    def is_over_ground(self) -> bool:
        """Whether it wants the velocity over ground now, whatever its loop."""
        return self._mode == "position"

    def hold(self, world_from_base: Pose) -> None:
        """Hold depth and heading here, at rest, and forget the past."""
        self._mode, self._takes_over = "velocity", False
        self._wanted[:] = 0.0
        self._integral[:] = 0.0
        self._height = float(world_from_base.position[2])
        self._heading = world_from_base.rotation.copy()

    def command(self, linear: Sequence[float], angular: Sequence[float]) -> None:
        """Take a twist [m/s, rad/s] in the base frame; it is held until the next."""
        if self._mode != "velocity":
            self._mode, self._takes_over = "velocity", True
            self._integral[:] = 0.0
        self._wanted[:] = np.clip([*linear, *angular], -LARGEST, LARGEST)

    def go_to(self, world_from_base: Pose) -> None:
        """Go to a place and its heading, and stay there; roll and pitch are not followed."""
        if self._mode != "position":
            self._mode = "position"
            self._integral[:] = 0.0
        self._takes_over = False
        self._wanted[:] = 0.0
        self._target = np.clip(world_from_base.position, -LARGEST, LARGEST)
        self._height = float(self._target[2])
        self._heading = world_from_base.rotation.copy()

    def push(self, force: Array, torque: Array) -> None:
        """Share out a force [N] and a torque about the base's origin [N m], base axes."""
        self._mode = "wrench"
        force, torque = np.clip([force, torque], -LARGEST, LARGEST)
        self._wrench = np.concatenate([force, torque - np.cross(self._reference, force)])

    def set_thrusters(self, commands: Array) -> None:
        """Pass the commands of the thrusters on, (n,) [1]."""
        self._mode = "thrusters"
        self._commands = commands.copy()

    def thrust(self, world_from_base: Pose, velocity: Array, dt: float) -> Array:
        """Return the commands of the thrusters, (n,) [1].

        Args:
            world_from_base: where the base is.
            velocity: of the base, relative to water or ground, base axes, (6,) [m/s, rad/s].
            dt: time since the last call [s].
        """
        if self._mode == "thrusters":
            return self._commands
        if self._mode == "wrench":
            return self._commanding(self._forces(self._wrench))
        if self._takes_over:
            self._takes_over = False
            self._height = float(world_from_base.position[2])
            self._heading = world_from_base.rotation.copy()
        base_from_world = world_from_base.rotation.T
        wanted = self._wanted.copy()
        if self._mode == "position":
            way = base_from_world @ (self._target - world_from_base.position)  # (3,) [m]
            way[2] = 0.0
            wish = self._gains.position * way
            wanted[:3] += wish * min(1.0, FASTEST / max(float(np.linalg.norm(wish)), 1e-9))
        self._steer(world_from_base, wanted, base_from_world, dt)
        lever = np.cross(velocity[3:], self._reference)
        error = wanted - np.concatenate([velocity[:3] + lever, velocity[3:]])
        error[3:5] = -velocity[3:5]
        before = self._integral.copy()
        self._integral += error * dt
        self._integral[3:5] = 0.0
        tau = self._mass * (self._velocity_gain * error + self._integral_gain * self._integral)
        tau += self._linear * wanted + self._quadratic * np.abs(wanted) * wanted
        up = base_from_world[:, 2]  # W's z in base axes
        tilt = math.atan2(up[0], -up[2]) if up[2] < 0.0 else -math.atan2(up[0], up[2])
        tau[4] += self._mass[4] * self._gains.righting * tilt
        forces = self._forces(tau)
        lacking = np.zeros(6)  # force and moment beyond the thrusters' limits
        lacking[list(AXES)] = self._reached @ (
            forces - np.clip(forces, self._least, self._greatest)
        )
        self._integral = np.where(lacking * error > 0.0, before, self._integral)
        return self._commanding(forces)

    def _forces(self, tau: Array) -> Array:
        """The thrusts that come nearest to a force and moment, beyond limits too, (n,) [N]."""
        forces: Array = self._share @ tau[list(AXES)]
        return forces

    def _commanding(self, forces: Array) -> Array:
        """The thrusters' commands for these thrusts, as far as they reach, (n,) [1]."""
        return np.array(
            [
                np.interp(force, thrusts, commands)
                for force, (thrusts, commands) in zip(forces, self._curves, strict=True)
            ]
        )

    def _steer(
        self, world_from_base: Pose, wanted: Array, base_from_world: Array, dt: float
    ) -> None:
        """Add the heave and yaw rate that lead back to depth and heading; move those if asked."""
        up = base_from_world[2, 2]  # how much of W's z lies along the base's z: +-1 when level
        self._height += self._wanted[2] * up * dt
        rate = self._wanted[5] * dt
        turn = np.array(
            [
                [math.cos(rate), -math.sin(rate), 0.0],
                [math.sin(rate), math.cos(rate), 0.0],
                [0.0, 0.0, 1.0],
            ]
        )
        self._heading = self._heading @ turn
        climb = self._gains.depth * (self._height - float(world_from_base.position[2]))
        wanted[2] += min(max(climb, -0.3), 0.3) * up
        off = base_from_world @ self._heading  # base_from_wanted
        wanted[5] += self._gains.heading * math.atan2(off[1, 0], off[0, 0])


def _column(thruster: ThrusterSpec, reference: Array) -> Array:
    """Force and moment about the reference of one newton of a thruster, (6,)."""
    direction = np.array(thruster.direction, dtype=np.float64)
    direction /= np.linalg.norm(direction)
    arm = np.array(thruster.position) - reference
    return np.concatenate([direction, np.cross(arm, direction)])


def _curve(thruster: ThrusterSpec) -> tuple[Array, Array]:
    """Thrust [N] and the command that gives it [1], both rising."""
    commands = np.linspace(*thruster.limits, 401)
    backward = thruster.forward if thruster.backward is None else thruster.backward
    thrusts = []
    for command in commands:
        size = max(0.0, abs(command) - thruster.dead_zone)
        numbers = thruster.forward if command > 0.0 else backward
        force = sum(c * size ** (i + 1) for i, c in enumerate(numbers))
        thrusts.append(math.copysign(force, command))
    return np.maximum.accumulate(np.array(thrusts)), commands
