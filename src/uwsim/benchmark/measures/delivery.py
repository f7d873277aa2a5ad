r"""u:delivery: the share of the bytes at one communication device that reach another.

.. code-block:: xml

    <u:delivery>
      <name>delivered</name>
      <from>modem1</from> <to>modem3</to>
      <period>4</period> <packets>20</packets> <size>32</size>
    </u:delivery>
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...errors import UnknownName
from ...messages import UInt8MultiArray
from ...schema import element
from ...world import World
from .measure import Measure, MeasureSpec


@dataclass(frozen=True, kw_only=True)
class DeliverySpec(MeasureSpec):
    """A ``<u:delivery>`` element of a benchmark file."""

    columns: ClassVar[tuple[str, ...]] = ("packets",)

    from_: str = element("from")
    """The device that sends the packets, by its ``<dccommsId>``."""
    to: str
    """The device that should receive them."""
    period: float = element(exclusive_minimum=0.0)
    """The time between two packets [s]."""
    packets: int = element(minimum=1, maximum=100_000)
    """The number of packets that are sent."""
    size: int = element(default=32, minimum=8, maximum=65_536)
    """The size of a packet [byte]."""

    def bind(self, world: World) -> Delivery:
        """Resolve both devices, and hide their topics; raises UnknownName if there is none."""
        known_names = [name[:-3] for name in world.bus.topics if name.endswith("/tx")]
        for name in (self.from_, self.to):
            if world.bus.message_type(f"{name}/tx") is not UInt8MultiArray:
                raise UnknownName("communication device", name, known_names)
        world.bus.hide_topic(f"{self.from_}/tx")
        world.bus.hide_topic(f"{self.to}/rx")
        return Delivery(self, world)


class Delivery(Measure):
    r"""The share of the packets sent by one device whose bytes have reached another.

    The measure sends the packets itself, to all devices within range, one at each period from its
    start on. Their bytes are random: the stream ``delivery/NAME`` of the seed. A packet is
    delivered as soon as the other device receives a packet with the same bytes, from whichever
    device; later copies do not count. The topics ``tx`` of the first device and ``rx`` of the other
    are hidden from algorithms under test. Not modelled: packets that are divided or joined on their
    way.
    """

    unit = "1"
    detail_units: ClassVar[Mapping[str, str]] = {
        "packets": "1",
        "sent": "1",
        "bytes": "byte",
        "mean_delay": "s",
        "time_done": "s",
    }

    def __init__(self, spec: DeliverySpec, world: World) -> None:
        self._spec, self._world = spec, world
        self._send = world.bus.publisher(f"{spec.from_}/tx", UInt8MultiArray)
        self._end_subscription: Callable[[], None] | None = None
        self._send_times: dict[bytes, float] = {}  # of the packets that are not delivered [s]
        self._delays: list[float] = []  # of the delivered packets [s]
        self._n_sent = 0
        self._start_time: float | None = None  # [s]
        self._done_time: float | None = None  # after the start [s]

    def start(self) -> None:
        """Begin to observe the receiving device, and send the first packet."""
        self._start_time = self._world.time
        self._rng = self._world.stream(f"delivery/{self._spec.name}")
        self._end_subscription = self._world.bus.subscribe(
            f"{self._spec.to}/rx", UInt8MultiArray, self._on_packet
        )
        self.update()

    def update(self) -> None:
        """Send the packets that are due."""
        assert self._start_time is not None
        level_time = self._world.time - self._start_time
        n_due = min(math.floor(level_time / self._spec.period + 1e-9) + 1, self._spec.packets)
        while self._n_sent < n_due:
            data = self._rng.bytes(self._spec.size)
            self._send_times[data] = level_time
            self._send(UInt8MultiArray(data=np.frombuffer(data, np.uint8)))
            self._n_sent += 1

    def stop(self) -> None:
        """End the observation."""
        self.close()

    def _on_packet(self, packet: UInt8MultiArray) -> None:
        assert self._start_time is not None
        send_time = self._send_times.pop(packet.data.tobytes(), None)
        if send_time is None:
            return
        level_time = self._world.time - self._start_time
        self._delays.append(level_time - send_time)
        if len(self._delays) == self._spec.packets:
            self._done_time = level_time

    @property
    def value(self) -> float | None:
        """The share of all packets of the level that were delivered; None if never active."""
        return None if self._start_time is None else len(self._delays) / self._spec.packets

    @property
    def details(self) -> dict[str, float | None]:
        """The numbers of packets and bytes, and times [s]."""
        n = len(self._delays)
        is_active = self._start_time is not None
        return {
            "packets": float(n) if is_active else None,
            "sent": float(self._n_sent) if is_active else None,
            "bytes": float(n * self._spec.size) if is_active else None,
            "mean_delay": sum(self._delays) / n if n else None,
            "time_done": self._done_time,
        }

    @property
    def reasons(self) -> dict[str, str]:
        """The reasons why details are None."""
        reasons = {
            "mean_delay": "no packet was delivered",
            "time_done": "not all packets were delivered",
        }
        return {name: reason for name, reason in reasons.items() if self.details[name] is None}

    @property
    def log_header(self) -> tuple[str, ...]:
        """The columns: the share, and the number of delivered packets."""
        return ("value", "packets")

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The present values of the columns of the log."""
        return (self.value, self.details["packets"])

    def close(self) -> None:
        """End the observation."""
        if self._end_subscription is not None:
            self._end_subscription()
            self._end_subscription = None
