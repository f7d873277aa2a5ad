"""``relay-hold``, ``relay-shuttle``: a vehicle brings packets from one modem to another.

The places of both ends are known (parameters). The vehicle keeps the packets that it receives and
sends them again, those first that it has sent least often. There are no acknowledgements. While
packets arrive, it sends only ``copies`` of them after each, as a modem that sends does not receive.
The two differ in where the vehicle is and sends:

- *hold*: at the middle between both ends.
- *shuttle*: at the ``distance`` from the sender, where it is silent, until it has ``load`` packets
  or nothing has arrived for two periods; then at that distance from the receiver.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import length
from ...bus import Node
from ...errors import BadSetting
from ...messages import MultiArrayLayout, UInt8MultiArray
from ..parametric import ParametricAlgorithm, start_benchmark
from .guided_vehicle import GuidedVehicle, place_beside
from .packet_store import PacketStore

ARRIVAL_DISTANCE = 3.0
"""The distance at which the vehicle has arrived at a place [m]."""


class RelayHold(ParametricAlgorithm):
    """A vehicle in the middle between two modems, which sends again what it receives."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "vehicle": "relay",
        "sender": "-40 0",
        "receiver": "40 0",
        "speed": 0.6,
        "period": 4.0,
        "slot": 1.5,
        "copies": 2.0,
    }
    """The name of the ``vehicle``, whose modem is ``NAME_modem``; the places of ``sender`` and
    ``receiver``, north and east in L [m]; the ``speed`` through the water [m/s]; the ``period`` of
    the sender [s]; the time between two packets that the vehicle sends, ``slot`` [s]; and how many
    it sends after each that arrives, ``copies``."""

    def start(self, node: Node) -> None:
        """Start the vehicle and its modem, and the benchmark."""
        self._read_parameters(node.parameters)
        self._node = node
        name = str(self._parameters["vehicle"])
        self.vehicle = GuidedVehicle(node, name, speed=self._number("speed"))
        """The vehicle."""
        self._sender, self._receiver = self._place("sender"), self._place("receiver")
        self._store = PacketStore()
        self._arrival_time = 0.0  # of the newest packet [s]
        self._n_copies = 0  # sent since the newest packet arrived
        self._publish = node.publisher(f"/{name}_modem/tx", UInt8MultiArray)
        node.subscribe(f"/{name}_modem/rx", UInt8MultiArray, self._on_packet)
        node.create_timer(self._number("slot"), self._step)
        start_benchmark(node)

    def _place(self, name: str) -> Array:
        """Return the place of an end, (3,) [m]; its depth is 0."""
        try:
            north, east = (float(word) for word in str(self._parameters[name]).split())
        except ValueError:
            raise BadSetting(
                f"Parameter {name!r} is {self._parameters[name]!r}; expected two numbers [m]."
            ) from None
        return np.array([north, east, 0.0])

    def _on_packet(self, packet: UInt8MultiArray) -> None:
        if self._store.add(packet.data.tobytes()):
            self._arrival_time, self._n_copies = self._node.now, 0

    def _step(self) -> None:
        """Set the goal of the vehicle, and send a packet if it is time."""
        if not self.vehicle.is_ready:
            return
        position = self.vehicle.position
        goal = self.goal(position)
        goal[2] = position[2]
        self.vehicle.go_to(goal)
        if self.is_sending() and length(goal - position) < ARRIVAL_DISTANCE:
            self._send()

    def goal(self, position: Array) -> Array:
        """Return the place to go to from a position, (3,) [m]; its depth is not used."""
        middle: Array = 0.5 * (self._sender + self._receiver)
        return middle

    def is_sending(self) -> bool:
        """Return whether the vehicle sends at its goal."""
        return True

    @property
    def has_silence(self) -> bool:
        """True if no new packet has arrived for two periods."""
        return self._node.now - self._arrival_time > 2.0 * self._number("period")

    def _send(self) -> None:
        if not self.has_silence and self._n_copies >= self._number("copies"):
            return
        data = self._store.take()
        if data is None:
            return
        self._n_copies += 1
        layout = MultiArrayLayout(dim=[], data_offset=0)
        self._publish(UInt8MultiArray(layout=layout, data=np.frombuffer(data, np.uint8)))


class RelayShuttle(RelayHold):
    """A vehicle that takes packets near their sender, and sends them near their receiver."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **RelayHold.PARAMETERS,
        "distance": 15.0,
        "load": 12.0,
    }
    """The parameters of `RelayHold`, the ``distance`` from an end [m], and the number of packets,
    ``load``, with which the vehicle leaves the sender."""

    def __init__(self) -> None:
        super().__init__()
        self._is_loaded = False

    def goal(self, position: Array) -> Array:
        """Return the place near the sender or the receiver, on the side of the other end."""
        if not self._is_loaded and len(self._store):
            self._is_loaded = len(self._store) >= self._number("load") or self.has_silence
        ends = (self._receiver, self._sender)
        near, far = ends if self._is_loaded else ends[::-1]
        return place_beside(near, far, self._number("distance"))

    def is_sending(self) -> bool:
        """Return whether the vehicle has its load."""
        return self._is_loaded
