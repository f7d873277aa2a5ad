"""Packets between devices: queued, sent, on their way, received or lost.

A packet occupies its channel at a receiver from the arrival of its first bit to that of its last,
each over the distance at the moment when that bit is sent: on its way nothing moves. Times are
whole nanoseconds. A packet is lost at a receiver

- if another one arrives at any moment of its arrival (a collision, both are lost),
- if the receiver sends at any moment of its arrival on the channel it listens to (half duplex),
- at random, with the probability of the sender's error model.

Every random number is the first of a stream of its own, named after the devices and the number of
the packet: one device more changes nothing of what the others draw.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Literal

import numpy as np

from ..base.numerics.linear import length
from ..base.record import Record
from ..errors import UnknownName
from .channel import Channel, Path
from .events import NANOSECONDS, EventQueue, EventsState, nanoseconds
from .modem import Modem, ModemState, Waiting
from .packet import EVERYONE, Outcome, Packet, Reception

MAX_DEPTH = 12_000.0
"""The formulas of sound hold for no greater depth [m]."""


@dataclass(frozen=True)
class _Event:
    kind: Literal["try", "sent"]
    modem: int


@dataclass(frozen=True)
class _Arrival:
    kind: Literal["begin", "end", "deliver"]
    reception: int


@dataclass(slots=True)
class NetworkState(Record):
    """What is on its way."""

    modems: list[ModemState]
    """What changes of each device."""
    events: EventsState[_Event | _Arrival]
    """What happens next."""
    receptions: dict[int, Reception] = field(default_factory=dict)
    """What becomes of each packet that is on its way, at each device that hears it."""
    n_receptions: int = 0
    """The receptions so far."""
    now: int = 0
    """The time up to which everything has happened [ns]."""


class Network:
    """Devices and the packets between them.

    Args:
        stream: the random generator of a name.
        surface: height of the water surface in W [m].
        channels: what devices send on, by name.
    """

    def __init__(
        self,
        stream: Callable[[str], np.random.Generator],
        *,
        surface: float = 0.0,
        channels: Mapping[str, Channel] = MappingProxyType({}),
    ) -> None:
        self.channels = channels
        """What devices send on, by name."""
        self.trace: Callable[[str], None] | None = None
        """Called with a line for everything that becomes of a packet."""
        self._stream, self._surface = stream, surface
        self._modems: list[Modem] = []
        self._events: EventQueue[_Event | _Arrival] = EventQueue()
        self.state = NetworkState([], self._events.state)
        """What is on its way."""

    @property
    def now(self) -> int:
        """Time up to which everything has happened [ns]."""
        return self.state.now

    @property
    def is_idle(self) -> bool:
        """Whether nothing is on its way or waits to be sent."""
        return not self._events

    def join(self, modem: Modem) -> Callable[[bytes, int], None]:
        """Add a device; returns ``send(data, destination)``."""
        number = len(self._modems)
        self._modems.append(modem)
        self.state.modems.append(modem.state)
        return lambda data, destination: self._queue(number, data, destination)

    def modem(self, name: str) -> Modem:
        """Find a device by its name; UnknownName if there is none."""
        for modem in self._modems:
            if modem.settings.name == name:
                return modem
        raise UnknownName("modem", name, [each.settings.name for each in self._modems])

    def advance(self, now: int) -> None:
        """Process all events up to ``now`` [ns]."""
        if not self._modems:
            return
        while (due := self._events.take(now)) is not None:
            self.state.now, event = due
            self._happen(event)
        self.state.now = max(self.now, now)

    def _happen(self, event: _Event | _Arrival) -> None:
        if isinstance(event, _Event):
            (self._try if event.kind == "try" else self._sent)(event.modem)
        elif event.kind == "begin":
            self._begin(event.reception)
        elif event.kind == "end":
            self._end(event.reception)
        else:
            reception = self.state.receptions.pop(event.reception)
            modem = self._modems[reception.receiver]
            self._count(modem, "received", reception.sender, reception.packet)
            modem.deliver(reception.packet, self.now)

    def _queue(self, number: int, data: bytes, destination: int) -> None:
        """Put a packet into the queue of a device, if there is room."""
        modem = self._modems[number]
        settings, state, index = modem.settings, modem.state, modem.state.n_packets
        state.n_packets += 1
        packet = Packet(number=index, source=settings.address, destination=destination, data=data)
        self._count(modem, "queued", number, packet)
        if modem.is_dead(self.now):
            self._count(modem, "no_energy", number, packet)
            return
        if state.n_queued_bytes + packet.room > settings.queue_size:
            self._count(modem, "queue_full", number, packet)
            return
        delay = settings.send_delay
        if settings.send_jitter > 0.0:
            delay += settings.send_jitter * self._draw(f"{settings.name}/{index}/send").random()
        state.queue.append(Waiting(packet=packet, ready=self.now + nanoseconds(delay)))
        state.n_queued_bytes += packet.room
        if not state.is_busy:
            self._plan_next(number)

    def _plan_next(self, number: int) -> None:
        """Try to send the first packet of a device's queue as soon as it may be."""
        state = self._modems[number].state
        state.is_busy = bool(state.queue)
        if state.queue:
            self._events.add(max(state.queue[0].ready, self.now), _Event("try", number))

    def _try(self, number: int) -> None:
        """Send the first packet of the queue, or try again when the protocol says."""
        modem = self._modems[number]
        waiting, settings = modem.state.queue[0], modem.settings
        if modem.is_dead(self.now):
            self._count(modem, "no_energy", number, waiting.packet)
            self._drop_first(modem)
            self._plan_next(number)
            return
        name = f"{settings.name}/{waiting.packet.number}/backoff/{waiting.n_tries}"
        waiting.n_tries += 1
        time = settings.mac.send_time(
            self.now,
            hears=bool(modem.state.arriving),
            draw=lambda below: int(self._draw(name).integers(below)),
        )
        if time > self.now:
            self._events.add(time, _Event("try", number))
        else:
            self._send(number, waiting.packet)

    def _send(self, number: int, packet: Packet) -> None:
        """Send a packet to all that hear the device."""
        sender = self._modems[number]
        settings, state = sender.settings, sender.state
        duration = settings.airtime(len(packet.data))
        state.sends_until = self.now + duration
        state.time_sending += duration
        self._count(sender, "sent", number, packet)
        if settings.is_half_duplex:
            for arriving in state.arriving:
                self._lose(arriving, "half_duplex")
        self._events.add(state.sends_until, _Event("sent", number))
        state.outgoing = [
            self._add_reception(number, other, packet)
            for other, receiver in enumerate(self._modems)
            if other != number and receiver.settings.listens_to == settings.sends_on
            if sender.reaches(self._path(sender, receiver))
        ]
        for outgoing in state.outgoing:
            arrival = self.state.receptions[outgoing].arrival
            self._events.add(arrival, _Arrival("begin", outgoing), rank=1)

    def _lose(self, number: int, why: Outcome) -> None:
        reception = self.state.receptions[number]
        reception.lost = reception.lost or why

    def _add_reception(self, sender: int, receiver: int, packet: Packet) -> int:
        settings = self._modems[sender].settings
        path = self._path(self._modems[sender], self._modems[receiver])
        self.state.n_receptions += 1
        self.state.receptions[self.state.n_receptions] = Reception(
            packet=packet,
            sender=sender,
            receiver=receiver,
            arrival=self.now + nanoseconds(settings.channel.delay(path)),
            error_probability=settings.errors.probability(path, len(packet.data)),
        )
        return self.state.n_receptions

    def _sent(self, number: int) -> None:
        """The last bit is sent: it arrives over the distance that there is now."""
        modem = self._modems[number]
        for outgoing in modem.state.outgoing:
            reception = self.state.receptions[outgoing]
            path = self._path(modem, self._modems[reception.receiver])
            end = self.now + nanoseconds(modem.settings.channel.delay(path))
            self._events.add(max(end, reception.arrival + 1), _Arrival("end", outgoing))
        modem.state.outgoing = []
        self._drop_first(modem)
        self._plan_next(number)

    def _drop_first(self, modem: Modem) -> None:
        modem.state.n_queued_bytes -= modem.state.queue.popleft().packet.room

    def _begin(self, number: int) -> None:
        """Begin to receive a packet; what arrives already is lost with it."""
        reception = self.state.receptions[number]
        modem = self._modems[reception.receiver]
        if modem.is_dead(self.now):
            reception.lost = "no_energy"
        elif modem.settings.is_half_duplex and modem.state.sends_until > self.now:
            reception.lost = "half_duplex"
        if modem.state.arriving:
            for each in (*modem.state.arriving, number):
                self._lose(each, "collisions")
        modem.state.arriving.append(number)

    def _end(self, number: int) -> None:
        """Hand a packet on that has arrived, unless it is lost."""
        reception = self.state.receptions.pop(number)
        modem, packet = self._modems[reception.receiver], reception.packet
        modem.state.arriving.remove(number)
        if reception.lost != "no_energy":
            modem.state.time_receiving += self.now - reception.arrival
        sender = self._modems[reception.sender].settings.name
        name = f"{modem.settings.name}/{sender}/{packet.number}"
        if reception.lost is None and self._is_damaged(reception, name):
            reception.lost = "errors"
        if reception.lost is not None:
            self._count(modem, reception.lost, reception.sender, packet)
        elif packet.destination in (EVERYONE, modem.settings.address):
            delay = 0.0
            if modem.settings.receive_jitter > 0.0:
                delay = modem.settings.receive_jitter * self._draw(f"{name}/receive").random()
            delivery = max(self.now + nanoseconds(delay), modem.state.last_delivery)
            modem.state.last_delivery = delivery
            self.state.receptions[number] = reception
            self._events.add(delivery, _Arrival("deliver", number))

    def _count(self, modem: Modem, outcome: Outcome, sender: int, packet: Packet) -> None:
        """Take note of what becomes of a packet at a device."""
        setattr(modem.counts, outcome, getattr(modem.counts, outcome) + 1)
        if self.trace is not None:
            of = f"{self._modems[sender].settings.name}#{packet.number}"
            time = f"{self.now // NANOSECONDS}.{self.now % NANOSECONDS:09d}"
            name = modem.settings.name
            self.trace(f"{time} {name} {outcome} {of} {len(packet.data)} bytes")

    def _is_damaged(self, reception: Reception, name: str) -> bool:
        likely = reception.error_probability
        return likely > 0.0 and float(self._draw(f"{name}/error").random()) < likely

    def _path(self, sender: Modem, receiver: Modem) -> Path:
        a, b = sender.position(), receiver.position()
        depth = self._surface - 0.5 * (float(a[2]) + float(b[2]))
        return Path(distance=length(a - b), depth=min(max(depth, 0.0), MAX_DEPTH))

    def _draw(self, name: str) -> np.random.Generator:
        return self._stream(f"network/{name}")
