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
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..bus import Bus
from ..geometry import Pose
from ..messages import TFMessage
from ..schema import MAX_DISTANCE, element
from ..vehicle import MAX_COMMAND, Vehicle, go_or_place
from ..world import Stage
from .device import Device, DeviceSpec, DeviceVehicle

WORLD = "world"
"""The frame of ROS that is L."""
MAX_DEPTH = 100
"""Frames hang on one another at most so deep."""


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

    def bind(self, stage: Stage, vehicle: DeviceVehicle) -> TfFollower:
        """Listen to ``/tf`` from now on."""
        frame_from_vehicle = Pose.from_rpy(self.position, self.orientation)
        frames = HeardFrames(stage.bus)
        return TfFollower(
            vehicle, frames, self.tf_id, frame_from_vehicle, stage.world_from_localized
        )


class HeardFrames:
    """The newest transform to each frame that was on ``/tf``; what is no transform is left out."""

    STATE: ClassVar[tuple[str, ...]] = ("_parents", "n_heard")
    """Names of the attributes that change as time goes by."""

    def __init__(self, bus: Bus) -> None:
        self._parents: dict[str, tuple[str, Pose]] = {}
        self.n_heard = 0
        """So many transforms have come so far."""
        bus.subscribe("/tf", TFMessage, self._hear)

    def _hear(self, message: TFMessage) -> None:
        for each in message.transforms:
            t, q = each.transform.translation, each.transform.rotation
            wxyz = np.array([q.w, q.x, q.y, q.z])
            position = np.array([t.x, t.y, t.z])
            length = float(np.abs(wxyz).max())
            is_sound = 0.0 < length < np.inf and bool(np.isfinite(position).all())
            if is_sound and float(np.abs(position).max()) <= MAX_COMMAND:
                pose = Pose.from_quaternion(position, wxyz / length)
                self._parents[_plain(each.child_frame_id)] = (_plain(each.header.frame_id), pose)
                self.n_heard += 1

    def find(self, frame: str, parent: str = WORLD) -> Pose | None:
        """Return ``parent_from_frame``; None where no chain of transforms leads there."""
        name, pose = _plain(frame), Pose.identity()
        for _ in range(MAX_DEPTH):
            if name == parent:
                return pose
            if name not in self._parents:
                return None
            name, parent_from_child = self._parents[name]
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

    STATE = ("_frames", "_n_followed")

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
        self._n_followed = 0

    def rests_until(self, time: float) -> float:
        """Return inf: it does something only where a message has been delivered."""
        return math.inf

    def step(self, time: float) -> None:
        """Follow what has come since the last step."""
        if self._n_followed == self._frames.n_heard:
            return
        self._n_followed = self._frames.n_heard
        localized_from_frame = self._frames.find(self._frame)
        if localized_from_frame is not None:
            localized_from_vehicle = localized_from_frame @ self._frame_from_vehicle
            go_or_place(self._vehicle, self._world_from_localized @ localized_from_vehicle)


def _plain(name: str) -> str:
    return name.strip().lstrip("/")
