"""Position reports: packets of 20 bytes with the position and velocity of a vehicle."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...bus import Node
from ...messages import MultiArrayLayout, UInt8MultiArray

N_NUMBERS = 5
"""The numbers of a report: north, east, down [m], and the velocity north and east [m/s]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class PositionReport:
    """The position and velocity of a vehicle at a time."""

    time: float
    """The time at which the report arrived [s]."""
    position: Array
    """The position, north, east, down, (3,) [m]."""
    velocity: Array
    """The velocity over ground, (3,) [m/s]; down is 0."""

    def position_at(self, time: float) -> Array:
        """Return the position at a time [s] if the velocity is constant, (3,) [m]."""
        position: Array = self.position + self.velocity * (time - self.time)
        return position


class ReportLink:
    """The modem of a vehicle, which sends and receives position reports.

    Packets of another size are ignored.

    Args:
        node: the node of the algorithm.
        modem: the name of the modem, which begins its topics.
        on_report: a function that is called with each report that arrives.
    """

    def __init__(self, node: Node, modem: str, on_report: Callable[[PositionReport], None]) -> None:
        self._node, self._on_report = node, on_report
        self._publish = node.publisher(f"/{modem}/tx", UInt8MultiArray)
        node.subscribe(f"/{modem}/rx", UInt8MultiArray, self._on_packet)

    def send(self, position: Array, velocity: Array) -> None:
        """Send a position (3,) [m] and a velocity (3,) [m/s], north, east, down."""
        numbers = np.concatenate([position, velocity[:2]]).astype("<f4")
        layout = MultiArrayLayout(dim=[], data_offset=0)
        self._publish(UInt8MultiArray(layout=layout, data=numbers.view(np.uint8)))

    def _on_packet(self, packet: UInt8MultiArray) -> None:
        data = packet.data.tobytes()
        if len(data) != 4 * N_NUMBERS:
            return
        numbers = np.frombuffer(data, "<f4").astype(np.float64)
        velocity = np.array([*numbers[3:], 0.0])
        self._on_report(
            PositionReport(time=self._node.now, position=numbers[:3], velocity=velocity)
        )
