"""Protocols of a vehicle for topics and devices."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np
import numpy.typing as npt

from .base.geometry import Array, Pose
from .world import CompiledVehicle

JointIndices = npt.NDArray[np.int64]
"""The indices of joints in the joint vector, each at most once, (n,)."""


class Autopilot(Protocol):
    """The autopilot of a simulated vehicle; a command is active until the next of any kind."""

    def go_to(self, world_from_base: Pose) -> None:
        """Move to a pose and keep it."""

    def command(self, linear: Sequence[float], angular: Sequence[float]) -> None:
        """Move at a twist in base axes [m/s], [rad/s]."""

    def push(self, force: Array, torque: Array) -> None:
        """Apply a wrench with the thrusters in base axes, (3,) [N], (3,) [N m]."""

    def set_thrusters(self, commands: Array) -> None:
        """Set the commands of the thrusters, (n,) [1]."""


class Servos(Protocol):
    """The joint servos of a simulated vehicle; joints have their index in the joint vector."""

    @property
    def velocities(self) -> Array:
        """The velocities of the joints, (n,) [rad/s or m/s]."""

    @property
    def efforts(self) -> Array:
        """The torques or forces at the joints, (n,) [N m or N]."""

    def aim(self, joints: JointIndices, targets: Array) -> None:
        """Move joints to target positions, (n,) [rad or m], and hold these."""

    def drive(self, joints: JointIndices, speeds: Array) -> None:
        """Move the target positions of joints at speeds, (n,) [rad/s or m/s]."""

    def push(self, joints: JointIndices, efforts: Array) -> None:
        """Apply efforts to joints, (n,) [N m or N]."""


class Vehicle(Protocol):
    """A vehicle of the scene: simulated, with autopilot and servos, or moved by commands alone."""

    @property
    def name(self) -> str:
        """The name in the scene."""

    @property
    def joint_names(self) -> Sequence[str]:
        """The names of the joints of the joint vector."""

    @property
    def thrusters(self) -> tuple[str, ...]:
        """The names of the thrusters in the hydrodynamics file; empty if it is not simulated."""

    @property
    def fins(self) -> tuple[str, ...]:
        """The names of the fins in the hydrodynamics file; empty if it is not simulated."""

    def turn_fins(self, angles: Array) -> None:
        """Turn the fins to angles and hold these, (n,) [rad]."""

    @property
    def autopilot(self) -> Autopilot | None:
        """The autopilot; None if the vehicle is not simulated."""

    @property
    def servos(self) -> Servos | None:
        """The joint servos; None if the vehicle is not simulated."""

    @property
    def world_from_base(self) -> Pose:
        """The pose of the base."""

    @property
    def velocity(self) -> Array:
        """The twist of the base over ground in base axes, (6,) [m/s, rad/s]."""

    @property
    def joints(self) -> Array:
        """A copy of the joint vector, (n,) [rad or m]."""

    @property
    def compiled_vehicle(self) -> CompiledVehicle:
        """The vehicle for compiled code."""

    def place(self, world_from_base: Pose) -> None:
        """Set the pose, at rest; later displacements are relative to this pose."""

    def set_joints(self, values: Array) -> None:
        """Set the joint vector, (n,) [rad or m]; clamped to the limits."""

    def displacer(self, axis: int) -> Callable[[float], None]:
        """Return a function that displaces the vehicle, at rest, from its last placed pose.

        Before `place` this is the pose in the file. ``axis`` 0 to 2: x, y, z of L [m]; 3 to 5:
        roll, pitch, yaw of its orientation [rad]. The displacements of several functions add up;
        the vehicle moves when the last of them is set.
        """

    def loss_setter(self, thruster: str) -> Callable[[float], None]:
        """Return a function that sets the share of the thrust that a thruster loses [0..1].

        Of several functions for one thruster the greatest loss counts.

        Raises:
            UnknownName: the vehicle has no such thruster.
        """


def go_or_place(vehicle: Vehicle, world_from_base: Pose) -> None:
    """Place a vehicle at a pose, at rest; a simulated vehicle moves there by its autopilot."""
    if (autopilot := vehicle.autopilot) is not None:
        autopilot.go_to(world_from_base)
    else:
        vehicle.place(world_from_base)
