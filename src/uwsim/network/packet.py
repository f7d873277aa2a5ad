"""Packets and their receptions."""

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
"""What becomes of a packet; the fields of `Counts`."""
EVERYONE = -1
"""Address of all devices that hear a packet."""


@dataclass(frozen=True, kw_only=True)
class Packet:
    """Bytes on their way from one device to others."""

    number: int
    """Counts the packets of its sender, from 0."""
    source: int
    """Address of the sender."""
    destination: int
    """Address of the device it is for; `EVERYONE`."""
    data: bytes
    """What is sent."""

    @property
    def room(self) -> int:
        """What it takes of a queue; an empty one takes a byte [byte]."""
        return max(len(self.data), 1)


@dataclass(slots=True)
class Reception(Item):
    """A packet that arrives at a device."""

    packet: Packet
    """What arrives."""
    sender: int
    """Number of the device that sent it."""
    receiver: int
    """Number of the device that it arrives at."""
    arrival: int
    """When its first bit arrives [ns]."""
    error_probability: float
    """How likely it is damaged by noise [1]."""
    lost: Outcome | None = None
    """Why it is lost; None while it is not."""


@dataclass(slots=True)
class Counts(Record):
    """What became of the packets of a device."""

    queued: int = 0
    """Handed over to be sent."""
    sent: int = 0
    """Sent."""
    received: int = 0
    """Received and handed on."""
    queue_full: int = 0
    """Not sent: the transmit queue was full."""
    no_energy: int = 0
    """Neither sent nor received: the energy was used up."""
    collisions: int = 0
    """Not received: another packet arrived at the same time."""
    half_duplex: int = 0
    """Not received: the device was sending."""
    errors: int = 0
    """Not received: damaged by noise, or as the error model has it."""
