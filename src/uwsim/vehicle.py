"""Protocols of a vehicle as topics and devices see it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np
import numpy.typing as npt

from .base.geometry import Array, Pose
from .world import CompiledVehicle

Numbers = npt.NDArray[np.int64]
"""Of joints in the joint vector, each at most once, (n,)."""


class Autopilot(Protocol):
    """The autopilot of a simulated vehicle; each command holds until the next of any kind."""

    def go_to(self, world_from_base: Pose) -> None:
        """Go to a place and stay there."""

    def command(self, linear: Sequence[float], angular: Sequence[float]) -> None:
        """Move at a twist, base axes [m/s], [rad/s]."""

    def push(self, force: Array, torque: Array) -> None:
        """Push with the thrusters, base axes (3,) [N], (3,) [N m]."""

    def set_thrusters(self, commands: Array) -> None:
        """Set the commands of the thrusters, (n,) [1]."""


class Servos(Protocol):
    """The joint servos of a simulated vehicle; joints by their number in the joint vector."""

    @property
    def velocities(self) -> Array:
        """How fast the joints move, (n,) [rad/s or m/s]."""

    @property
    def efforts(self) -> Array:
        """Forces and torques at the joints, (n,) [N m or N]."""

    def aim(self, joints: Numbers, targets: Array) -> None:
        """Bring these joints to targets, (n,) [rad or m], and hold them there."""

    def drive(self, joints: Numbers, speeds: Array) -> None:
        """Move the targets of these joints at speeds, (n,) [rad/s or m/s]."""

    def push(self, joints: Numbers, efforts: Array) -> None:
        """Act on these joints with efforts, (n,) [N m or N]."""


class Vehicle(Protocol):
    """A vehicle of the scene: simulated, with autopilot and servos, or moved by commands alone."""

    @property
    def name(self) -> str:
        """Its name in the scene."""

    @property
    def joint_names(self) -> Sequence[str]:
        """Names of the joints of the joint vector."""

    @property
    def thrusters(self) -> tuple[str, ...]:
        """Names of its thrusters as in its hydrodynamics file; none if it is not simulated."""

    @property
    def fins(self) -> tuple[str, ...]:
        """Names of its fins as in its hydrodynamics file; none if it is not simulated."""

    def turn_fins(self, angles: Array) -> None:
        """Let its fins turn to these angles and stay there, (n,) [rad]."""

    @property
    def autopilot(self) -> Autopilot | None:
        """Its autopilot; None if it is not simulated."""

    @property
    def servos(self) -> Servos | None:
        """Its joint servos; None if it is not simulated."""

    @property
    def world_from_base(self) -> Pose:
        """Where its base is now."""

    @property
    def velocity(self) -> Array:
        """Twist of its base over ground, base axes, (6,) [m/s, rad/s]."""

    @property
    def joints(self) -> Array:
        """A copy of its joint vector, (n,) [rad or m]."""

    @property
    def compiled(self) -> CompiledVehicle:
        """The vehicle as compiled code reads it."""

    def place(self, world_from_base: Pose) -> None:
        """Set its pose, at rest; it is displaced from there from now on."""

    def set_joints(self, values: Array) -> None:
        """Set its joint vector, (n,) [rad or m]; clamped to the limits."""

    def displacer(self, axis: int) -> Callable[[float], None]:
        """Return a function that displaces it, at rest, from its place.

        That is its place in the file, or where it was put last.

        Along x, y, z of L [m] or about roll, pitch, yaw of its orientation [rad], by the number of
        the ``axis``. Several add up; it moves when the last of them is set.
        """

    def loss_setter(self, thruster: str) -> Callable[[float], None]:
        """Return a function that sets the share of its thrust that a thruster loses [0..1].

        Of several setters of one thruster the greatest loss counts.

        Raises:
            UnknownName: it has no such thruster.
        """


def go_or_place(vehicle: Vehicle, world_from_base: Pose) -> None:
    """Put a vehicle somewhere, at rest; a simulated one has its autopilot bring it there."""
    if (autopilot := vehicle.autopilot) is not None:
        autopilot.go_to(world_from_base)
    else:
        vehicle.place(world_from_base)
