"""The common parts of custom and acoustic communication devices."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ...base.geometry import Pose
from ...errors import BadMessage
from ...messages import (
    Float64,
    MultiArrayDimension,
    MultiArrayLayout,
    Point,
    Quaternion,
    UInt8MultiArray,
)
from ...messages import Pose as PoseMessage
from ...network import (
    BROADCAST_ADDRESS,
    Channel,
    Mac,
    Modem,
    ModemSettings,
    Packet,
    Path,
    mac_kind,
    nanoseconds,
)
from ...schema import MAX_DISTANCE, REQUIRED_BY_DTD, Original, Spec, element
from ...sensors.sensor import MountedPart
from ...world import Body, DeviceWorld
from ..device import Device, DeviceTopic, DeviceVehicle

SLOT_PACKET_SIZE = 64
"""The size of the largest packet that fits in a slot, unless the file sets the slot [byte]."""
MIN_SLOT = 1_000_000
"""The shortest slot [ns]."""
ENERGY_RATE = 1.0
"""The rate at which the remaining energy is published [Hz]."""


@dataclass(frozen=True, kw_only=True)
class MacProtocolSpec(Spec):
    """A ``<macProtocol>``: the medium access protocol."""

    name: str = element(default="", original=REQUIRED_BY_DTD)
    """The name of the protocol: ALOHA, slottedALOHA or CSMA; empty: ALOHA."""
    max_distance: float = element(
        default=0.0, original=Original(allows_trailing_text=True), minimum=0, maximum=MAX_DISTANCE
    )
    """The longest distance between two devices, for the length of a slot [m]."""
    max_backoff_slots: int = element(default=4, minimum=0, maximum=1_000_000)
    """The longest waiting time of CSMA while the channel is busy, at least 1 [slots]."""
    slot: float | None = element(namespaced=True, default=None, minimum=0.001, maximum=1e6)
    """The length of a slot [s]; by default the travel time over ``maxDistance`` plus the time of a
    packet of 64 bytes, at least 1 ms."""

    def bind(self, channel: Channel, airtime: Callable[[int], int]) -> Mac:
        """Create the protocol; an unknown name gives ALOHA.

        Args:
            channel: the channel on which the device sends.
            airtime: a function that returns the duration [ns] of a packet by its size [byte].
        """
        if self.slot is not None:
            slot = nanoseconds(self.slot)
        else:
            propagation_delay = channel.delay(Path(distance=self.max_distance, depth=0.0))
            slot = nanoseconds(propagation_delay) + airtime(SLOT_PACKET_SIZE)
        kind = mac_kind(self.name) or "aloha"
        return Mac(kind=kind, slot=max(slot, MIN_SLOT), max_backoff=self.max_backoff_slots)


@dataclass(frozen=True, kw_only=True)
class PacketBuilderSpec(Spec):
    """A ``<txPacketBuilder>`` or ``<rxPacketBuilder>``, which is read but not used."""

    class_name: str
    """The name of the C++ class that builds packets."""
    lib_path: str = ""
    """The library that contains the class."""


@dataclass(frozen=True, kw_only=True)
class MeshSpec(Spec):
    """A ``<mesh>`` that shows a device; it has no collision shape."""

    path: str
    """The mesh file."""
    scale_factor: tuple[float, float, float] = (1.0, 1.0, 1.0)
    """The scale along x, y, z [1]."""


class CommsSpec(MountedPart, Protocol):
    """The spec of a custom or acoustic device."""

    @property
    def dccomms_id(self) -> str:
        """The name of the device."""

    @property
    def tf_id(self) -> str:
        """The name of the device's frame."""

    @property
    def relative_tf_id(self) -> str:
        """The name of the link's frame."""


@dataclass(frozen=True, kw_only=True)
class _LinkOrigin:
    """The origin of a link."""

    relative_to: str
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    orientation: tuple[float, float, float] = (0.0, 0.0, 0.0)


def packet_topics(name: str, *, has_energy: bool = False) -> tuple[DeviceTopic, ...]:
    """Return the topics of a device."""
    packets = (
        DeviceTopic(name=f"{name}/tx", is_subscribed=True, message_type=UInt8MultiArray),
        DeviceTopic(name=f"{name}/rx", message_type=UInt8MultiArray),
    )
    energy = DeviceTopic(name=f"{name}/energy", rate=ENERGY_RATE, message_type=Float64)
    return (*packets, energy) if has_energy else packets


class CommsDevice(Device):
    """A device on a link that sends the bytes of ``<id>/tx`` and publishes received bytes.

    Args:
        spec: the spec of the device.
        world: the scene.
        vehicle: the vehicle on which the device is mounted.
        settings: the settings of the modem; None: the device does not take part in the network.
    """

    def __init__(
        self,
        spec: CommsSpec,
        world: DeviceWorld,
        vehicle: DeviceVehicle,
        settings: ModemSettings | None,
    ) -> None:
        self._mount = vehicle.mount(spec)
        self._link = vehicle.mount(_LinkOrigin(relative_to=spec.relative_to))
        self._visual = vehicle.mount(_LinkOrigin(relative_to=spec.relative_to), visual=True)
        self.frame = spec.tf_id or f"{vehicle.name}/{spec.dccomms_id}"
        """The name of the device's frame."""
        self.parent_frame = spec.relative_tf_id or f"{vehicle.name}/{spec.relative_to}"
        """The name of the link's frame."""
        if settings is not None:
            self._join(spec.dccomms_id, world, settings)

    def _join(self, name: str, world: DeviceWorld, settings: ModemSettings) -> None:
        bus = world.bus
        publish = bus.publisher(f"{name}/rx", UInt8MultiArray)
        modem = Modem(
            settings,
            lambda: _body_position(self._mount),
            lambda packet, _: publish(_packet_message(packet)),
        )
        send = world.network.join(modem)

        def send_message(message: UInt8MultiArray) -> None:
            send(message.data.tobytes(), _read_destination(message))

        bus.subscribe(f"{name}/tx", UInt8MultiArray, send_message, check=_check_bytes)
        if settings.energy is not None:
            publish_energy = bus.publisher(f"{name}/energy", Float64)

            def publish_remaining_energy() -> None:
                publish_energy(Float64(data=modem.energy(world.network.now) or 0.0))

            world.create_timer(ENERGY_RATE, publish_remaining_energy)

    @property
    def parent_from_device(self) -> Pose:
        """The present pose of the device in the frame of its link."""
        return self._link.world_from_body.inverse() @ self._mount.world_from_body

    def sample(self, time: float) -> PoseMessage:
        """Return the pose of the link's visual frame in W, as the original UWSim does."""
        pose = self._visual.world_from_body
        x, y, z = pose.position.tolist()
        qw, qx, qy, qz = pose.quaternion.tolist()
        return PoseMessage(
            position=Point(x=x, y=y, z=z), orientation=Quaternion(x=qx, y=qy, z=qz, w=qw)
        )


def _body_position(body: Body) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return body.world_from_body.position


def _check_bytes(message: UInt8MultiArray) -> None:
    if message.data.dtype != np.uint8:
        raise BadMessage(f"The data of a packet is {message.data.dtype}; expected bytes (uint8).")


def _read_destination(message: UInt8MultiArray) -> int:
    """Return the size of the dimension ``destination``, which is an address; or broadcast."""
    sizes = [dimension.size for dimension in message.layout.dim if dimension.label == "destination"]
    return sizes[0] if sizes else BROADCAST_ADDRESS


def _packet_message(packet: Packet) -> UInt8MultiArray:
    """Return a packet as a message, with its source and, unless it is broadcast, destination."""
    dimensions = [MultiArrayDimension(label="source", size=packet.source)]
    if packet.destination != BROADCAST_ADDRESS:
        dimensions.append(MultiArrayDimension(label="destination", size=packet.destination))
    return UInt8MultiArray(
        layout=MultiArrayLayout(dim=[*dimensions]), data=np.frombuffer(packet.data, np.uint8)
    )
