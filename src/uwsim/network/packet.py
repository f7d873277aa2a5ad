"""Packets, their receptions and outcomes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..base.record import Item, Record

Outcome = Literal[
    "queued",
    "sent",
    "received",
    "queue_full",
    "no_energy",
    "collisions",
    "half_duplex",
    "errors",
]
"""The outcome of a packet; `Counts` has a field for each."""
BROADCAST_ADDRESS = -1
"""The destination of a packet to all devices within range."""


@dataclass(frozen=True, kw_only=True)
class Packet:
    """Bytes sent from one device to others."""

    number: int
    """The index of the packet among all packets of its sender, from 0."""
    source: int
    """The address of the sender."""
    destination: int
    """The address of the receiving device, or `BROADCAST_ADDRESS`."""
    data: bytes
    """The content of the packet."""

    @property
    def queue_size(self) -> int:
        """The space that the packet takes in a queue, at least 1 [byte]."""
        return max(len(self.data), 1)


@dataclass(slots=True)
class Reception(Item):
    """The reception of a packet at a device."""

    packet: Packet
    """The packet that arrives."""
    sender: int
    """The index of the sending device in the network."""
    receiver: int
    """The index of the receiving device in the network."""
    arrival: int
    """The time at which the first bit arrives [ns]."""
    error_probability: float
    """The probability that noise damages the packet, from 0 to 1."""
    loss_reason: Outcome | None = None
    """The reason why the packet is lost at the receiver; None while it is not lost."""


@dataclass(slots=True)
class Counts(Record):
    """The number of packets of each outcome, at one device."""

    n_queued: int = 0
    """The packets that were requested to be sent."""
    n_sent: int = 0
    """The packets that were sent."""
    n_received: int = 0
    """The packets that were received and delivered."""
    n_queue_full: int = 0
    """The packets that were not sent because the queue was full."""
    n_no_energy: int = 0
    """The packets that were neither sent nor received because the energy was used up."""
    n_collisions: int = 0
    """The packets that were lost because another packet arrived at the same time."""
    n_half_duplex: int = 0
    """The packets that were lost because the device was sending."""
    n_errors: int = 0
    """The packets that were lost because the error model or noise damaged them."""
