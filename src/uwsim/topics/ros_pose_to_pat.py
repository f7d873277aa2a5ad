"""ROSPoseToPAT: sets the pose of a vehicle; a simulated one moves there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..geometry import Pose, rotation_from_quaternion
from ..messages import Pose as PoseMessage
from ..vehicle import MAX_COMMAND, Vehicle, go_or_place
from .interface import Interface, TopicWorld, VehicleTopicSpec


@dataclass(frozen=True, kw_only=True)
class ROSPoseToPATSpec(VehicleTopicSpec):
    """Moves a vehicle by geometry_msgs/Pose."""

    subscribes: ClassVar[bool] = True

    messages: ClassVar[Mapping[str, type]] = {"topic": PoseMessage}

    def bind(self, world: TopicWorld) -> PoseCommand:
        """Listen from now on; raises UnknownName if there is no such vehicle."""
        command = PoseCommand(world.vehicle(self.vehicle_name), world.world_from_localized)
        world.bus.subscribe(self.topic, PoseMessage, lambda m: world.at_next_step(command.obey, m))
        return command


class PoseCommand(Interface):
    """Sets the pose of a vehicle, or the goal of its autopilot."""

    def __init__(self, vehicle: Vehicle, world_from_localized: Pose) -> None:
        self._vehicle, self._world_from_localized = vehicle, world_from_localized

    def obey(self, pose: PoseMessage) -> None:
        """Take a pose in L; an invalid quaternion counts as no rotation."""
        localized_from_base = pose_in_localized(pose)
        if localized_from_base is not None:
            go_or_place(self._vehicle, self._world_from_localized @ localized_from_base)


def pose_in_localized(pose: PoseMessage) -> Pose | None:
    """Return a message's pose, in L; None if its position is no place.

    An invalid quaternion counts as no rotation.
    """
    p, q = pose.position, pose.orientation
    wxyz = np.array([q.w, q.x, q.y, q.z])
    largest = float(np.abs(wxyz).max())
    if not 0.0 < largest < np.inf:
        wxyz, largest = np.array([1.0, 0.0, 0.0, 0.0]), 1.0
    position = np.array([p.x, p.y, p.z])
    if not np.isfinite(position).all():
        return None
    return Pose(
        np.clip(position, -MAX_COMMAND, MAX_COMMAND), rotation_from_quaternion(wxyz / largest)
    )
