"""A vehicle that follows a ROS frame.

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
"""The name of the ROS frame that coincides with L."""
MAX_DEPTH = 100
"""The greatest number of transforms between a frame and the frame ``world``."""
EXPECTED = f"{EXPECTED_POSE}; it is left out"
"""The expected content of a transform, and what happens to an invalid one."""


@dataclass(frozen=True, kw_only=True)
class TfSpec(DeviceSpec):
    """A ``<tf>``: the vehicle follows a ROS frame, if ``/tf`` connects the frame with ``world``."""

    tf_id: str
    """The name of the ROS frame."""
    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position of the vehicle in that frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """The orientation of the vehicle in that frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> TfFollower:
        """Subscribe to ``/tf``."""
        frame_from_vehicle = Pose.from_rpy(self.position, self.orientation)
        frames = ReceivedFrames(world.bus)
        return TfFollower(
            vehicle, frames, self.tf_id, frame_from_vehicle, world.world_from_localized
        )


@dataclass(slots=True)
class HeardState(Record):
    """The transforms received on ``/tf``."""

    parents: dict[str, tuple[str, Pose]] = field(default_factory=dict)
    """The parent of each frame, and ``parent_from_frame``."""
    n_received: int = 0
    """The number of valid transforms received so far."""


@dataclass(slots=True)
class FollowerState(Record):
    """The state of a vehicle that follows a frame."""

    frames: HeardState
    """The transforms received on ``/tf``."""
    n_followed: int = 0
    """The number of received transforms up to which the vehicle's pose is updated."""


class ReceivedFrames:
    """The newest transform of each frame on ``/tf``; invalid transforms are left out."""

    def __init__(self, bus: Bus) -> None:
        self.state = HeardState()
        """The transforms received so far."""
        bus.subscribe("/tf", TFMessage, self._receive, remark=_check_transforms)

    def _receive(self, message: TFMessage) -> None:
        for transform in message.transforms:
            pose = _read_transform(transform)
            if pose is not None:
                parent = _strip_slash(transform.header.frame_id)
                self.state.parents[_strip_slash(transform.child_frame_id)] = parent, pose
                self.state.n_received += 1

    def find(self, frame: str, parent: str = WORLD) -> Pose | None:
        """Return ``parent_from_frame``; None if no chain of transforms connects the frames."""
        name, pose = _strip_slash(frame), Pose.identity()
        for _ in range(MAX_DEPTH):
            if name == parent:
                return pose
            if name not in self.state.parents:
                return None
            name, parent_from_child = self.state.parents[name]
            pose = parent_from_child @ pose
        return None


class TfFollower(Device):
    """The device that sets the pose of a vehicle from a ROS frame.

    A vehicle with dynamics moves to that pose by its autopilot.

    Args:
        vehicle: the vehicle.
        frames: the transforms received on ``/tf``.
        frame: the name of the ROS frame.
        frame_from_vehicle: the vehicle's pose in the frame.
        world_from_localized: the transform of W from L.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        frames: ReceivedFrames,
        frame: str,
        frame_from_vehicle: Pose,
        world_from_localized: Pose,
    ) -> None:
        self._vehicle, self._frames, self._frame = vehicle, frames, frame
        self._frame_from_vehicle = frame_from_vehicle
        self._world_from_localized = world_from_localized
        self.state: FollowerState = FollowerState(frames.state)

    def idle_until(self, time: float) -> float:
        """Return inf: the device acts only after a message."""
        return math.inf

    def step(self, time: float) -> None:
        """Apply the transforms received since the last step."""
        if self.state.n_followed == self._frames.state.n_received:
            return
        self.state.n_followed = self._frames.state.n_received
        localized_from_frame = self._frames.find(self._frame)
        if localized_from_frame is not None:
            localized_from_vehicle = localized_from_frame @ self._frame_from_vehicle
            go_or_place(self._vehicle, self._world_from_localized @ localized_from_vehicle)


def _read_transform(transform: TransformStamped) -> Pose | None:
    """Return ``parent_from_child`` of a transform; None if it is invalid."""
    position = read_position(transform.transform.translation)
    quaternion = read_quaternion(transform.transform.rotation)
    if position is None or quaternion is None:
        return None
    return Pose.from_quaternion(position, quaternion)


def _check_transforms(message: TFMessage) -> Remark | None:
    for index, transform in enumerate(message.transforms):
        if _read_transform(transform) is None:
            return f"transforms[{index}] (to {transform.child_frame_id!r:.60}) is invalid", EXPECTED
    return None


def _strip_slash(name: str) -> str:
    return name.strip().lstrip("/")
