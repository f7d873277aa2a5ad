"""A device of the network: settings, queue and receptions."""

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
    """Its name, which begins the names of its random streams."""
    address: int
    """Its address."""
    sends_on: str
    """Name of the channel it sends on."""
    listens_to: str
    """Name of the channel it listens to; the same one: it is half duplex."""
    channel: Channel
    """How long its packets travel."""
    errors: ErrorModel
    """How likely they are damaged."""
    bit_rate: float
    """How fast it sends [bit/s]."""
    preamble: float = 0.0
    """What it sends before each packet [s]."""
    min_range: float = 0.0
    """Nearer devices do not hear it [m]."""
    max_range: float = float("inf")
    """Farther devices do not hear it [m]."""
    queue_size: int = 500_000
    """Size of the transmission queue [byte]."""
    send_delay: float = 0.0
    """Between the order to send a packet and its sending [s]."""
    send_jitter: float = 0.0
    """Largest addition to that, uniformly distributed from 0 [s]."""
    receive_jitter: float = 0.0
    """Largest delay of a packet received, uniformly distributed from 0 [s]."""
    mac: Mac = field(default_factory=Mac)
    """Medium access protocol."""
    energy: EnergyModel | None = None
    """What it uses; None: it never runs out."""

    def airtime(self, n_bytes: int) -> int:
        """Return how long a packet takes to send [ns]."""
        return nanoseconds(self.preamble + 8 * n_bytes / self.bit_rate)

    @property
    def is_half_duplex(self) -> bool:
        """Whether it hears nothing while it sends."""
        return self.sends_on == self.listens_to


@dataclass(slots=True)
class Waiting(Item):
    """A packet that waits to be sent."""

    packet: Packet
    """The packet."""
    ready: int
    """From when on it may be sent [ns]."""
    n_tries: int = 0
    """How often the protocol has been asked whether it may be sent."""


@dataclass(slots=True)
class ModemState(Record):
    """What changes of a device."""

    queue: deque[Waiting] = field(default_factory=deque)
    """What waits to be sent; the first of them may be on its way."""
    n_queued_bytes: int = 0
    """Their size."""
    n_packets: int = 0
    """The packets that were handed over."""
    is_busy: bool = False
    """Whether the first of the queue is about to be sent, or being sent."""
    sends_until: int = 0
    """When the packet that is being sent ends [ns]."""
    outgoing: list[int] = field(default_factory=list)
    """The receptions of the packet that is being sent, at each device that hears it."""
    arriving: list[int] = field(default_factory=list)
    """The receptions of what arrives."""
    time_sending: int = 0
    """The time spent sending [ns]."""
    time_receiving: int = 0
    """The time spent receiving [ns]."""
    last_delivery: int = 0
    """When the last packet was handed on [ns]."""
    counts: Counts = field(default_factory=Counts)
    """What became of its packets."""


class Modem:
    """A device in a network, driven by the network.

    Args:
        settings: what it is.
        position: returns where it is, in W, (3,) [m].
        deliver: called with each packet received and its time [ns].
    """

    def __init__(
        self,
        settings: ModemSettings,
        position: Callable[[], Array],
        deliver: Callable[[Packet, int], None],
    ) -> None:
        self.settings, self.position, self.deliver = settings, position, deliver
        self.state = ModemState()
        """What changes of it."""

    @property
    def counts(self) -> Counts:
        """What became of its packets."""
        return self.state.counts

    def energy(self, now: int) -> float | None:
        """Return what is left of its energy [J]; None if it has no limit."""
        model = self.settings.energy
        if model is None:
            return None
        return model.left(now, sent=self.state.time_sending, received=self.state.time_receiving)

    def is_dead(self, now: int) -> bool:
        """Whether its energy is used up."""
        return self.energy(now) == 0.0

    def reaches(self, path: Path) -> bool:
        """Whether a device at the end of a path hears it."""
        return self.settings.min_range <= path.distance <= self.settings.max_range
