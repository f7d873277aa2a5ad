"""The protocols through which topics and devices command and read a vehicle."""

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
    """The autopilot of a vehicle with dynamics; each command replaces the one before."""

    def go_to(self, world_from_base: Pose) -> None:
        """Move the base to a pose in W, and keep the pose."""

    def set_twist(self, linear: Sequence[float], angular: Sequence[float]) -> None:
        """Move at a linear velocity [m/s] and an angular velocity [rad/s], in base axes."""

    def set_wrench(self, force: Array, torque: Array) -> None:
        """Apply a force (3,) [N] and a torque (3,) [N m], in base axes, with the thrusters."""

    def set_thrusters(self, commands: Array) -> None:
        """Set the commands of the n thrusters, from -1 to 1, (n,) [1]."""


class Servos(Protocol):
    """The joint servos of a vehicle with dynamics; joints are indexed as in the joint vector."""

    @property
    def velocities(self) -> Array:
        """The velocities of the joints, (n,) [rad/s or m/s]."""

    @property
    def efforts(self) -> Array:
        """The torques or forces at the joints, (n,) [N m or N]."""

    def set_position_targets(self, joints: JointIndices, targets: Array) -> None:
        """Move joints to target positions (n,) [rad or m], and hold them there."""

    def set_velocity_targets(self, joints: JointIndices, speeds: Array) -> None:
        """Move the target positions of joints at velocities (n,) [rad/s or m/s]."""

    def set_efforts(self, joints: JointIndices, efforts: Array) -> None:
        """Apply efforts (n,) [N m or N] to joints."""


class Vehicle(Protocol):
    """A vehicle: with dynamics, an autopilot and servos; or kinematic, moved by commands alone."""

    @property
    def name(self) -> str:
        """The name in the scene."""

    @property
    def joint_names(self) -> Sequence[str]:
        """The names of the joints, in the order of the joint vector."""

    @property
    def thrusters(self) -> tuple[str, ...]:
        """The names of the thrusters in the hydrodynamics file; none on a kinematic vehicle."""

    @property
    def fins(self) -> tuple[str, ...]:
        """The names of the fins in the hydrodynamics file; none on a kinematic vehicle."""

    def turn_fins(self, angles: Array) -> None:
        """Turn the fins to angles (n,) [rad], and hold them there."""

    @property
    def autopilot(self) -> Autopilot | None:
        """The autopilot; None if the vehicle is kinematic."""

    @property
    def servos(self) -> Servos | None:
        """The joint servos; None if the vehicle is kinematic."""

    @property
    def world_from_base(self) -> Pose:
        """The present pose of the base in W."""

    @property
    def velocity(self) -> Array:
        """The linear [m/s] and angular [rad/s] velocity of the base over ground, in base axes."""

    @property
    def joints(self) -> Array:
        """A copy of the joint vector, (n,) [rad or m]."""

    @property
    def compiled_vehicle(self) -> CompiledVehicle:
        """The interface of the vehicle for compiled code."""

    def place(self, world_from_base: Pose) -> None:
        """Set the pose of the base in W, at rest, from which later displacements count."""

    def set_joints(self, values: Array) -> None:
        """Set the joint vector (n,) [rad or m], clamped to the joint limits."""

    def displacer(self, axis: int) -> Callable[[float], None]:
        """Return a function that sets a displacement of the vehicle from its rest pose.

        The rest pose is that of the last `place`, or of the scene file. The displacements of all
        returned functions add up; the vehicle moves when the function returned last is called.

        Args:
            axis: 0 to 2: x, y, z of L [m]; 3 to 5: roll, pitch, yaw of the orientation [rad].
        """

    def loss_setter(self, thruster: str) -> Callable[[float], None]:
        """Return a function that sets the fraction of the thrust that a thruster loses [0..1].

        If several functions set losses of one thruster, the greatest loss applies.

        Raises:
            UnknownName: the vehicle has no such thruster.
        """


def go_or_place(vehicle: Vehicle, world_from_base: Pose) -> None:
    """Move a vehicle with dynamics to a pose by its autopilot; place a kinematic one there."""
    if (autopilot := vehicle.autopilot) is not None:
        autopilot.go_to(world_from_base)
    else:
        vehicle.place(world_from_base)
