"""ROSOdomToPAT: commands for a vehicle as odometry: the pose or, if it is all zero, the twist."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from ..base.external_values import MAX_COMMAND
from ..base.message_fields import find_invalid_number
from ..bus import Remark
from ..messages import Odometry
from .interface import Interface, TopicWorld, VehicleTopicSpec
from .ros_pose_to_pat import PoseCommand, check_pose
from .ros_twist_to_pat import TWIST, Gap, GapState, TwistCommand


@dataclass(frozen=True, kw_only=True)
class ROSOdomToPATSpec(VehicleTopicSpec):
    """A subscription that moves a vehicle by nav_msgs/Odometry.

    A position or orientation that is not all zero sets the pose in L. Otherwise the vehicle moves
    by the twist, in its own axes, for the interval since the previous twist (1 s at most). Poses do
    not affect that interval.
    """

    subscribes: ClassVar[bool] = True

    messages: ClassVar[Mapping[str, type]] = {"topic": Odometry}

    def bind(self, world: TopicWorld) -> OdometryCommand:
        """Start to subscribe; raise UnknownName if there is no such vehicle."""
        vehicle = world.vehicle(self.vehicle_name)
        command = OdometryCommand(
            PoseCommand(vehicle, world.world_from_localized), TwistCommand(vehicle, Gap(world))
        )
        world.bus.subscribe(
            self.topic,
            Odometry,
            world.defer_to_next_step(command.apply_command),
            remark=check_odometry,
        )
        return command


def has_pose(odometry: Odometry) -> bool:
    """Return whether the position or orientation is not all zero; then the pose is applied."""
    p, q = odometry.pose.pose.position, odometry.pose.pose.orientation
    return any((p.x, p.y, p.z, q.x, q.y, q.z))


def check_odometry(odometry: Odometry) -> Remark | None:
    """Report an invalid number in the pose or the twist, whichever is applied."""
    if has_pose(odometry):
        return check_pose(odometry, "pose.pose.")
    return find_invalid_number(odometry, [f"twist.{path}" for path in TWIST], MAX_COMMAND)


class OdometryCommand(Interface):
    """The application of odometry: a vehicle's pose, or a motion by a twist."""

    def __init__(self, pose: PoseCommand, twist: TwistCommand) -> None:
        self._pose, self._twist = pose, twist
        self.state: GapState = twist.state

    def apply_command(self, odometry: Odometry) -> None:
        """Apply the pose, in L, or the twist, in the axes of the base."""
        if has_pose(odometry):
            self._pose.apply_command(odometry.pose.pose)
        else:
            self._twist.apply_command(odometry.twist.twist)
