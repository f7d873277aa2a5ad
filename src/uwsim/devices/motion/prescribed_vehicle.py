"""A vehicle whose motion is prescribed: it is where it is placed, whatever forces act on it."""

from __future__ import annotations

from collections.abc import Collection
from typing import Literal, Protocol, runtime_checkable

from ...base.geometry import Array, Pose

MotionSource = Literal["base", "joints"]
"""A part of a vehicle whose motion may be prescribed."""


@runtime_checkable
class PrescribedVehicle(Protocol):
    """The interface of a vehicle for the devices that prescribe its motion."""

    @property
    def name(self) -> str:
        """The name in the scene."""

    @property
    def world_from_base(self) -> Pose:
        """The present pose of the base in W."""

    def start_prescribed_motion(self) -> None:
        """Compute velocities from the poses that are set, not from forces."""

    def set_configuration(
        self,
        world_from_base: Pose | None,
        joints: Array | None,
        starting_sources: Collection[MotionSource] = (),
    ) -> None:
        """Set the pose and the joint vector; a prescribed motion counts the change as movement.

        Args:
            world_from_base: the pose of the base in W; None: no change.
            joints: the joint vector, (n,) [rad or m]; None: no change.
            starting_sources: the quantities whose prescribed motion starts here, at rest.
        """


def move_vehicle(vehicle: PrescribedVehicle, world_from_base: Pose, *, is_start: bool) -> None:
    """Move a vehicle to a pose in W; at the start of a motion, it is at rest there."""
    vehicle.start_prescribed_motion()
    starting_sources: tuple[MotionSource, ...] = ("base",) if is_start else ()
    vehicle.set_configuration(world_from_base, None, starting_sources)
