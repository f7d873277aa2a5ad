"""A vehicle follows a frame of ROS.

.. code-block:: xml

    <tf>
      <tfId>bluerov2/base_link</tfId>
      <position> <x>0</x> <y>0</y> <z>0.1</z> </position>
      <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
    </tf>
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from ..base.external_values import EXPECTED_POSE, read_position, read_quaternion
from ..base.geometry import Pose
from ..base.record import Record
from ..bus import Bus, Remark
from ..messages import TFMessage, TransformStamped
from ..schema import MAX_DISTANCE, element
from ..vehicle import Vehicle, go_or_place
from ..world import DeviceWorld
from .device import Device, DeviceSpec, DeviceVehicle

WORLD = "world"
"""The frame of ROS that is L."""
MAX_DEPTH = 100
"""Frames hang on one another at most so deep."""
EXPECTED = f"{EXPECTED_POSE}; it is left out"
"""What a transform has."""


@dataclass(frozen=True, kw_only=True)
class TfSpec(DeviceSpec):
    """A ``<tf>``: the vehicle follows a ROS frame, as far as ``/tf`` leads from it to ``world``."""

    tf_id: str
    """The frame it follows."""
    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """Position of the vehicle in that frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Orientation of the vehicle in that frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> TfFollower:
        """Listen to ``/tf`` from now on."""
        frame_from_vehicle = Pose.from_rpy(self.position, self.orientation)
        frames = HeardFrames(world.bus)
        return TfFollower(
            vehicle, frames, self.tf_id, frame_from_vehicle, world.world_from_localized
        )


@dataclass(slots=True)
class HeardState(Record):
    """What has been on ``/tf``."""

    parents: dict[str, tuple[str, Pose]] = field(default_factory=dict)
    """The parent of each frame, and ``parent_from_frame``."""
    n_heard: int = 0
    """The transforms so far."""


@dataclass(slots=True)
class FollowerState(Record):
    """What a vehicle has followed."""

    frames: HeardState
    """What has been on ``/tf``."""
    n_followed: int = 0
    """The transforms that it has followed."""


class HeardFrames:
    """The newest transform to each frame that was on ``/tf``; what is no transform is left out."""

    def __init__(self, bus: Bus) -> None:
        self.state = HeardState()
        """What has been there."""
        bus.subscribe("/tf", TFMessage, self._hear, remark=_odd_transform)

    def _hear(self, message: TFMessage) -> None:
        for each in message.transforms:
            pose = _pose_of(each)
            if pose is not None:
                parent = _plain(each.header.frame_id)
                self.state.parents[_plain(each.child_frame_id)] = parent, pose
                self.state.n_heard += 1

    def find(self, frame: str, parent: str = WORLD) -> Pose | None:
        """Return ``parent_from_frame``; None where no chain of transforms leads there."""
        name, pose = _plain(frame), Pose.identity()
        for _ in range(MAX_DEPTH):
            if name == parent:
                return pose
            if name not in self.state.parents:
                return None
            name, parent_from_child = self.state.parents[name]
            pose = parent_from_child @ pose
        return None


class TfFollower(Device):
    """Puts a vehicle where a frame is; one that is simulated goes there.

    Args:
        vehicle: the vehicle.
        frames: what has been on ``/tf``.
        frame: the frame it follows.
        frame_from_vehicle: where it is in that frame.
        world_from_localized: W from L.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        frames: HeardFrames,
        frame: str,
        frame_from_vehicle: Pose,
        world_from_localized: Pose,
    ) -> None:
        self._vehicle, self._frames, self._frame = vehicle, frames, frame
        self._frame_from_vehicle = frame_from_vehicle
        self._world_from_localized = world_from_localized
        self.state: FollowerState = FollowerState(frames.state)

    def rests_until(self, time: float) -> float:
        """Return inf: it does something only where a message has been delivered."""
        return math.inf

    def step(self, time: float) -> None:
        """Follow what has come since the last step."""
        if self.state.n_followed == self._frames.state.n_heard:
            return
        self.state.n_followed = self._frames.state.n_heard
        localized_from_frame = self._frames.find(self._frame)
        if localized_from_frame is not None:
            localized_from_vehicle = localized_from_frame @ self._frame_from_vehicle
            go_or_place(self._vehicle, self._world_from_localized @ localized_from_vehicle)


def _pose_of(each: TransformStamped) -> Pose | None:
    """``parent_from_child`` of a transform; None where it is none."""
    position = read_position(each.transform.translation)
    quaternion = read_quaternion(each.transform.rotation)
    if position is None or quaternion is None:
        return None
    return Pose.from_quaternion(position, quaternion)


def _odd_transform(message: TFMessage) -> Remark | None:
    """Report a transform that is left out."""
    for index, each in enumerate(message.transforms):
        if _pose_of(each) is None:
            return f"transforms[{index}] (to {each.child_frame_id!r:.60}) is none", EXPECTED
    return None


def _plain(name: str) -> str:
    return name.strip().lstrip("/")
