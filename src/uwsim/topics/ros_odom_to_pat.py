"""ROSOdomToPAT: moves a vehicle by odometry: by its pose or, where that is all zero, its twist."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from ..base.external_values import MAX_COMMAND
from ..base.message_fields import find_invalid_number
from ..bus import Remark
from ..messages import Odometry
from .interface import Interface, TopicWorld, VehicleTopicSpec
from .ros_pose_to_pat import PoseCommand, odd_pose
from .ros_twist_to_pat import TWIST, Gap, GapState, TwistCommand


@dataclass(frozen=True, kw_only=True)
class ROSOdomToPATSpec(VehicleTopicSpec):
    """Moves a vehicle by nav_msgs/Odometry.

    A position or turn that is not all zero puts it there, in L; else it goes on by the twist, in
    its own axes, for the time since the twist before (1 s at most). A pose takes no time from a
    twist.
    """

    subscribes: ClassVar[bool] = True

    messages: ClassVar[Mapping[str, type]] = {"topic": Odometry}

    def bind(self, world: TopicWorld) -> OdometryCommand:
        """Listen from now on; raises UnknownName if there is no such vehicle."""
        vehicle = world.vehicle(self.vehicle_name)
        command = OdometryCommand(
            PoseCommand(vehicle, world.world_from_localized), TwistCommand(vehicle, Gap(world))
        )
        world.bus.subscribe(
            self.topic,
            Odometry,
            world.at_next_step(command.obey),
            remark=odd_odometry,
        )
        return command


def has_pose(odometry: Odometry) -> bool:
    """Whether its position or turn is not all zero: it is the pose that counts then."""
    p, q = odometry.pose.pose.position, odometry.pose.pose.orientation
    return any((p.x, p.y, p.z, q.x, q.y, q.z))


def odd_odometry(odometry: Odometry) -> Remark | None:
    """Report what is odd about the pose, or the twist, that counts."""
    if has_pose(odometry):
        return odd_pose(odometry, "pose.pose.")
    return find_invalid_number(odometry, [f"twist.{path}" for path in TWIST], MAX_COMMAND)


class OdometryCommand(Interface):
    """Sets the pose of a vehicle or moves it by a twist."""

    def __init__(self, pose: PoseCommand, twist: TwistCommand) -> None:
        self._pose, self._twist = pose, twist
        self.state: GapState = twist.state

    def obey(self, odometry: Odometry) -> None:
        """Take a pose in L, or a twist in the base's axes."""
        if has_pose(odometry):
            self._pose.obey(odometry.pose.pose)
        else:
            self._twist.obey(odometry.twist.twist)
