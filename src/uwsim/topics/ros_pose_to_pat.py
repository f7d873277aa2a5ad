"""ROSPoseToPAT: commands for the pose of a vehicle.

The pose is in L, the frame of the scene. A vehicle with ``u:dynamics`` travels there: the pose is
the setpoint of its autopilot. Another vehicle is placed there at once.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..base.external_values import MAX_COMMAND, read_quaternion
from ..base.geometry import Pose
from ..base.message_fields import find_invalid_number
from ..bus import Remark
from ..messages import Pose as PoseMessage
from ..vehicle import Vehicle, go_or_place
from .interface import Interface, TopicWorld, VehicleTopicSpec

MAX_VALUE = sys.float_info.max
"""The greatest element of a quaternion: any finite one, as quaternions are normalized."""


@dataclass(frozen=True, kw_only=True)
class ROSPoseToPATSpec(VehicleTopicSpec):
    """A subscription that moves a vehicle by geometry_msgs/Pose."""

    subscribes: ClassVar[bool] = True

    messages: ClassVar[Mapping[str, type]] = {"topic": PoseMessage}

    def bind(self, world: TopicWorld) -> PoseCommand:
        """Start to subscribe; raise UnknownName if there is no such vehicle."""
        command = PoseCommand(world.vehicle(self.vehicle_name), world.world_from_localized)
        world.bus.subscribe(
            self.topic,
            PoseMessage,
            world.defer_to_next_step(command.apply_command),
            remark=check_pose,
        )
        return command


class PoseCommand(Interface):
    """The application of poses to a vehicle or its autopilot."""

    def __init__(self, vehicle: Vehicle, world_from_localized: Pose) -> None:
        self._vehicle, self._world_from_localized = vehicle, world_from_localized

    def apply_command(self, pose: PoseMessage) -> None:
        """Apply a pose, in L; an invalid quaternion counts as no rotation."""
        localized_from_base = pose_in_localized(pose)
        if localized_from_base is not None:
            go_or_place(self._vehicle, self._world_from_localized @ localized_from_base)


def check_pose(message: object, prefix: str = "") -> Remark | None:
    """Report an invalid position, or an orientation that is not finite.

    Args:
        message: the message with the pose.
        prefix: the path to the pose in the message, with a dot at its end: ``pose.pose.``.
    """
    positions = [f"{prefix}position.{axis}" for axis in "xyz"]
    remark = find_invalid_number(message, positions, MAX_COMMAND)
    if remark is None:
        elements = [f"{prefix}orientation.{axis}" for axis in "xyzw"]
        remark = find_invalid_number(message, elements, MAX_VALUE)
        remark = remark and (remark[0], "a finite number; it counts as no rotation")
    return remark


def pose_in_localized(pose: PoseMessage) -> Pose | None:
    """Return a message's pose, in L; None if its position is not finite.

    An invalid quaternion counts as no rotation.
    """
    quaternion = read_quaternion(pose.orientation)
    if quaternion is None:
        quaternion = np.array([1.0, 0.0, 0.0, 0.0])
    position = np.array([pose.position.x, pose.position.y, pose.position.z])
    if not np.isfinite(position).all():
        return None
    return Pose.from_quaternion(np.clip(position, -MAX_COMMAND, MAX_COMMAND), quaternion)
