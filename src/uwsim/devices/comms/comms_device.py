"""What custom and acoustic communication devices have in common."""

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
    EVERYONE,
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
from ...sensors.sensor import Mounted
from ...world import Body, DeviceWorld
from ..device import Device, DeviceTopic, DeviceVehicle

SLOT_BYTES = 64
"""A slot of a protocol is long enough for a packet of this size, unless the file says otherwise."""
MIN_SLOT = 1_000_000
"""Shortest slot [ns]."""
ENERGY_RATE = 1.0
"""How often what is left of the energy is published [Hz]."""


@dataclass(frozen=True, kw_only=True)
class MacProtocolSpec(Spec):
    """A ``<macProtocol>``: who may send when."""

    name: str = element(default="", original=REQUIRED_BY_DTD)
    """ALOHA, slottedALOHA or CSMA; empty: ALOHA."""
    max_distance: float = element(
        default=0.0, original=Original(allows_trailing_text=True), minimum=0, maximum=MAX_DISTANCE
    )
    """Longest distance between two devices, for the length of a slot [m]."""
    max_backoff_slots: int = element(default=4, minimum=0, maximum=1_000_000)
    """CSMA: longest wait when another device is heard, at least 1 [slots]."""
    slot: float | None = element(namespaced=True, default=None, minimum=0.001, maximum=1e6)
    """Length of a slot [s]; without it the travel time over ``maxDistance`` and the time of a
    packet of 64 bytes, at least 1 ms."""

    def bind(self, channel: Channel, airtime: Callable[[int], int]) -> Mac:
        """Make the protocol; one of another name is ALOHA.

        Args:
            channel: what the device sends on.
            airtime: how long a packet of so many bytes takes [ns].
        """
        if self.slot is not None:
            slot = nanoseconds(self.slot)
        else:
            travel = channel.delay(Path(distance=self.max_distance, depth=0.0))
            slot = nanoseconds(travel) + airtime(SLOT_BYTES)
        kind = mac_kind(self.name) or "aloha"
        return Mac(kind=kind, slot=max(slot, MIN_SLOT), max_backoff=self.max_backoff_slots)


@dataclass(frozen=True, kw_only=True)
class PacketBuilderSpec(Spec):
    """A ``<txPacketBuilder>`` or ``<rxPacketBuilder>``: read and not used, data has no frame."""

    class_name: str
    """Name of the class that packs."""
    lib_path: str = ""
    """Library that holds it, when it is not built in."""


@dataclass(frozen=True, kw_only=True)
class CommsMeshSpec(Spec):
    """A ``<mesh>`` that shows where a device is; nothing touches it."""

    path: str
    """The file."""
    scale_factor: tuple[float, float, float] = (1.0, 1.0, 1.0)
    """Scale along x, y, z [1]."""


class CommsSpec(Mounted, Protocol):
    """The spec of either device."""

    @property
    def dccomms_id(self) -> str:
        """Its name."""

    @property
    def tf_id(self) -> str:
        """Name of its frame."""

    @property
    def relative_tf_id(self) -> str:
        """Name of the frame it rides on."""


@dataclass(frozen=True, kw_only=True)
class _OnLink:
    """The origin of a link."""

    relative_to: str
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    orientation: tuple[float, float, float] = (0.0, 0.0, 0.0)


def packet_topics(name: str, *, has_energy: bool = False) -> tuple[DeviceTopic, ...]:
    """Return the topics of a device."""
    packets = (DeviceTopic(name=f"{name}/tx", is_heard=True), DeviceTopic(name=f"{name}/rx"))
    energy = DeviceTopic(name=f"{name}/energy", rate=ENERGY_RATE)
    return (*packets, energy) if has_energy else packets


class CommsDevice(Device):
    """A device on a link: bytes on ``<id>/tx`` are sent, what it receives is on ``<id>/rx``.

    Args:
        spec: its spec.
        world: the scene.
        vehicle: what it rides on.
        settings: what it is in the network; None: it takes no part.
    """

    def __init__(
        self,
        spec: CommsSpec,
        world: DeviceWorld,
        vehicle: DeviceVehicle,
        settings: ModemSettings | None,
    ) -> None:
        self._mount = vehicle.mount(spec)
        self._link = vehicle.mount(_OnLink(relative_to=spec.relative_to))
        self._visual = vehicle.mount(_OnLink(relative_to=spec.relative_to), visual=True)
        self.frame = spec.tf_id or f"{vehicle.name}/{spec.dccomms_id}"
        """Name of its frame."""
        self.parent_frame = spec.relative_tf_id or f"{vehicle.name}/{spec.relative_to}"
        """Name of the frame it rides on."""
        if settings is not None:
            self._join(spec.dccomms_id, world, settings)

    def _join(self, name: str, world: DeviceWorld, settings: ModemSettings) -> None:
        bus = world.bus
        publish = bus.publisher(f"{name}/rx", UInt8MultiArray)
        modem = Modem(
            settings, lambda: _position(self._mount), lambda packet, _: publish(_message(packet))
        )
        send = world.network.join(modem)

        def take(message: UInt8MultiArray) -> None:
            send(message.data.tobytes(), _destination(message))

        bus.subscribe(f"{name}/tx", UInt8MultiArray, take, check=_check_bytes)
        if settings.energy is not None:
            publish_energy = bus.publisher(f"{name}/energy", Float64)

            def tell() -> None:
                publish_energy(Float64(data=modem.energy(world.network.now) or 0.0))

            world.every(ENERGY_RATE, tell)

    @property
    def parent_from_device(self) -> Pose:
        """Where it is on its link now."""
        return self._link.world_from_body.inverse() @ self._mount.world_from_body

    def sample(self, time: float) -> PoseMessage:
        """Return the pose of the link's visual frame in W, as the original does."""
        pose = self._visual.world_from_body
        x, y, z = pose.position.tolist()
        qw, qx, qy, qz = pose.quaternion.tolist()
        return PoseMessage(
            position=Point(x=x, y=y, z=z), orientation=Quaternion(x=qx, y=qy, z=qz, w=qw)
        )


def _position(body: Body) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return body.world_from_body.position


def _check_bytes(message: UInt8MultiArray) -> None:
    if message.data.dtype != np.uint8:
        raise BadMessage(f"The data of a packet are bytes (uint8), not {message.data.dtype}.")


def _destination(message: UInt8MultiArray) -> int:
    """The address that a packet is for: the size of the dimension called ``destination``."""
    sizes = [each.size for each in message.layout.dim if each.label == "destination"]
    return sizes[0] if sizes else EVERYONE


def _message(packet: Packet) -> UInt8MultiArray:
    """A packet with its sender, and with the device that it is for unless it is for all."""
    dim = [MultiArrayDimension(label="source", size=packet.source)]
    if packet.destination != EVERYONE:
        dim.append(MultiArrayDimension(label="destination", size=packet.destination))
    return UInt8MultiArray(
        layout=MultiArrayLayout(dim=[*dim]), data=np.frombuffer(packet.data, np.uint8)
    )
