"""A device of the network (a modem): its settings, and its state with queue and receptions."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

from ..base.geometry import Array
from ..base.record import Item, Record
from .channel import Channel, Path
from .energy import EnergyModel
from .events import nanoseconds
from .mac import Mac
from .packet import Counts, Packet
from .packet_errors import ErrorModel


@dataclass(frozen=True, kw_only=True)
class ModemSettings:
    """The settings of a device."""

    name: str
    """The name of the device; the names of its random streams begin with it."""
    address: int
    """The address of the device."""
    sends_on: str
    """The name of the channel on which the device sends."""
    listens_to: str
    """The name of the channel to which it listens; if both are equal, it is half duplex."""
    channel: Channel
    """The channel that delays the packets it sends."""
    errors: ErrorModel
    """The error model of the packets it sends."""
    bit_rate: float
    """The bit rate of sending [bit/s]."""
    preamble: float = 0.0
    """The length of the preamble before each packet [s]."""
    min_range: float = 0.0
    """The distance below which other devices do not receive its packets [m]."""
    max_range: float = float("inf")
    """The distance above which other devices do not receive its packets [m]."""
    queue_size: int = 500_000
    """The size of the transmission queue [byte]."""
    send_delay: float = 0.0
    """The delay between the request to send a packet and its sending [s]."""
    send_jitter: float = 0.0
    """The largest random addition to the send delay, uniformly distributed from 0 [s]."""
    receive_jitter: float = 0.0
    """The largest random delay of a received packet, uniformly distributed from 0 [s]."""
    mac: Mac = field(default_factory=Mac)
    """The medium access protocol."""
    energy: EnergyModel | None = None
    """The energy use; None: the energy is unlimited."""

    def airtime(self, n_bytes: int) -> int:
        """Return the duration of sending a packet of ``n_bytes``, with its preamble [ns]."""
        return nanoseconds(self.preamble + 8 * n_bytes / self.bit_rate)

    @property
    def is_half_duplex(self) -> bool:
        """True if the device receives nothing while it sends."""
        return self.sends_on == self.listens_to


@dataclass(slots=True)
class QueuedPacket(Item):
    """A packet in the transmission queue."""

    packet: Packet
    """The packet."""
    ready_time: int
    """The earliest time of sending [ns]."""
    n_tries: int = 0
    """The number of tries to send it so far."""


@dataclass(slots=True)
class ModemState(Record):
    """The state of a device."""

    queue: deque[QueuedPacket] = field(default_factory=deque)
    """The transmission queue; its first packet may be in transit."""
    n_queued_bytes: int = 0
    """The size of the queued packets [byte]."""
    n_packets: int = 0
    """The number of packets requested to be sent so far."""
    is_busy: bool = False
    """True if the first packet of the queue is scheduled or being sent."""
    sending_end: int = 0
    """The time at which the newest sending ends or ended [ns]."""
    outgoing_receptions: list[int] = field(default_factory=list)
    """The numbers of the receptions, at other devices, of the packet being sent."""
    incoming_receptions: list[int] = field(default_factory=list)
    """The numbers of the receptions of packets that are arriving at this device."""
    time_sending: int = 0
    """The time spent sending [ns]."""
    time_receiving: int = 0
    """The time spent receiving [ns]."""
    last_delivery: int = 0
    """The time of the last delivery of a received packet [ns]."""
    counts: Counts = field(default_factory=Counts)
    """The number of packets of each outcome."""


class Modem:
    """A device in a network; `Network` advances its state.

    Args:
        settings: the settings of the device.
        position: a function that returns the position of the device in the world W, (3,) [m].
        deliver: a function that is called with each received packet and its time [ns].
    """

    def __init__(
        self,
        settings: ModemSettings,
        position: Callable[[], Array],
        deliver: Callable[[Packet, int], None],
    ) -> None:
        self.settings, self.position, self.deliver = settings, position, deliver
        self.state = ModemState()
        """The state of the device."""

    @property
    def counts(self) -> Counts:
        """The number of packets of each outcome."""
        return self.state.counts

    def energy(self, now: int) -> float | None:
        """Return the remaining energy at ``now`` [ns] in J; None if it is unlimited."""
        model = self.settings.energy
        if model is None:
            return None
        return model.remaining_energy(
            now, time_sending=self.state.time_sending, time_receiving=self.state.time_receiving
        )

    def is_dead(self, now: int) -> bool:
        """Return whether the energy is used up at ``now`` [ns]."""
        return self.energy(now) == 0.0

    def reaches(self, path: Path) -> bool:
        """Return whether a device at the other end of a path is within range."""
        return self.settings.min_range <= path.distance <= self.settings.max_range
