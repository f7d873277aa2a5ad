"""A vehicle that a flight dynamics model moves by UDP datagrams, FlightGear's ``net_fdm``.

.. code-block:: xml

    <nedOrigin> <lat>41.775</lat> <lon>3.033</lon> </nedOrigin>
    <vehicle> <name>bluerov2</name> <file>bluerov2.urdf</file> <fdm>5503</fdm> </vehicle>

A datagram begins with these big-endian fields; the rest is not read:

======  ========  =========  ===================================
offset  type      field      meaning
======  ========  =========  ===================================
0       uint32    version    24
4       uint32    padding    not read
8       float64   longitude  [rad]
16      float64   latitude   [rad]
24      float64   altitude   above the ellipsoid [m]
32      float32   agl        above ground, not read [m]
36      float32   phi        roll [rad]
40      float32   theta      pitch [rad]
44      float32   psi        yaw [rad]
======  ========  =========  ===================================
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..base.external_values import MAX_COMMAND
from ..base.geodesy import Geodetic
from ..base.geometry import Pose, rotation_from_rpy
from ..base.record import Record
from ..vehicle import Vehicle, go_or_place
from ..world import DeviceWorld
from .device import Device, DeviceSpec, DeviceVehicle
from .tf import HeardState, ReceivedFrames

LAYOUT = struct.Struct(">II3d4f")
VERSION = 24
"""The value of FlightGear's ``FG_NET_FDM_VERSION``."""
NED_FRAME = "local_origin_ned"
"""The ROS frame of the NED axes, if it is on ``/tf``."""
WORLD_FROM_NED = Pose(np.zeros(3), np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]]))
"""The default pose of the NED frame: north, east and down are y, x and -z of W."""


@dataclass(frozen=True, kw_only=True)
class FdmSpec(DeviceSpec):
    """A ``<fdm>``: the UDP port of a vehicle."""

    port: int
    """The UDP port."""

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> FdmInput:
        """Create the input; it receives datagrams from now on, if the simulation does."""
        return FdmInput(
            vehicle,
            world.datagrams(self.port),
            world.ned_origin,
            ReceivedFrames(world.bus),
            world.world_from_localized,
        )


def read_datagram(data: bytes, origin: Geodetic) -> Pose | None:
    """Return ``ned_from_vehicle`` of a datagram; None if size, version or values are invalid."""
    if len(data) < LAYOUT.size:
        return None
    version, _, longitude, latitude, altitude, _, roll, pitch, yaw = LAYOUT.unpack_from(data)
    numbers = (longitude, latitude, altitude, roll, pitch, yaw)
    if version != VERSION or not all(map(math.isfinite, numbers)):
        return None
    if abs(latitude) > math.pi / 2 or abs(longitude) > 2.0 * math.pi or abs(altitude) > MAX_COMMAND:
        return None
    if max(abs(roll), abs(pitch), abs(yaw)) > 4.0 * math.pi:
        return None
    geodetic = Geodetic(latitude=latitude, longitude=longitude, altitude=altitude)
    position = origin.north_east_down(geodetic)
    if float(np.abs(position).max()) > MAX_COMMAND:
        return None
    return Pose(position, rotation_from_rpy(roll, pitch, yaw))


@dataclass(slots=True)
class FdmState(Record):
    """The state of the input of a flight dynamics model."""

    frames: HeardState
    """The transforms received on ``/tf``."""
    n_valid: int = 0
    """The number of valid datagrams so far."""
    n_invalid: int = 0
    """The number of invalid datagrams so far."""


class FdmInput(Device):
    """The input that sets the pose of a vehicle from the newest datagram.

    A vehicle with dynamics moves to that pose by its autopilot.

    Args:
        vehicle: the vehicle.
        receive: a function that returns the datagrams received since its last call, oldest first;
            None: the simulation receives none.
        origin: the origin of the NED frame on Earth.
        frames: the transforms received on ``/tf``.
        world_from_localized: the transform of W from L.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        receive: Callable[[], Sequence[bytes]] | None,
        origin: Geodetic,
        frames: ReceivedFrames,
        world_from_localized: Pose,
    ) -> None:
        self._vehicle, self._receive, self._origin = vehicle, receive, origin
        self._frames, self._world_from_localized = frames, world_from_localized
        self.state: FdmState = FdmState(frames.state)

    def idle_until(self, time: float) -> float:
        """Return the time of the next check for datagrams: the next step, or never."""
        return math.inf if self._receive is None else time

    def step(self, time: float) -> None:
        """Apply the datagrams received since the last step."""
        if self._receive is None:
            return
        poses = [read_datagram(data, self._origin) for data in self._receive()]
        valid_poses = [pose for pose in poses if pose is not None]
        self.state.n_valid += len(valid_poses)
        self.state.n_invalid += len(poses) - len(valid_poses)
        if valid_poses:
            ned_from_vehicle = valid_poses[-1]
            go_or_place(self._vehicle, self._world_from_ned() @ ned_from_vehicle)

    def _world_from_ned(self) -> Pose:
        localized_from_ned = self._frames.find(NED_FRAME)
        if localized_from_ned is None:
            return WORLD_FROM_NED
        return self._world_from_localized @ localized_from_ned
