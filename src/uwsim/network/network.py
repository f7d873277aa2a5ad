"""The network of devices: packets are queued, sent, in transit, received or lost.

A packet arrives at a receiver from its first bit to its last bit. The delay of a bit is that of the
distance between both devices when the bit is sent; motion during its travel is not modelled. Times
are whole nanoseconds. A packet is lost at a receiver

- if another packet arrives meanwhile (a collision: both are lost),
- if the receiver meanwhile sends on the channel it listens to (half duplex),
- if the receiver's energy is used up,
- at random, with the probability of the sender's error model.

Every random number is the first draw of its own random stream, named after the devices and the
number of the packet. An additional device therefore does not change the random numbers of others.
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
from .modem import Modem, ModemState, QueuedPacket
from .packet import BROADCAST_ADDRESS, Outcome, Packet, Reception

MAX_DEPTH = 12_000.0
"""The greatest depth at which the formulas of sound speed are valid [m]."""


@dataclass(frozen=True)
class _Event:
    """An event of a modem: it tries to send its next packet, or has sent a packet."""

    kind: Literal["try", "sent"]
    modem: int


@dataclass(frozen=True)
class _Arrival:
    """An event of a reception: it begins, ends, or its packet is delivered."""

    kind: Literal["begin", "end", "deliver"]
    reception: int


@dataclass(slots=True)
class NetworkState(Record):
    """The state of all devices and of the packets in transit."""

    modems: list[ModemState]
    """The state of each device."""
    events: EventsState[_Event | _Arrival]
    """The future events of the network."""
    receptions: dict[int, Reception] = field(default_factory=dict)
    """The receptions of packets in transit, by number: one for each packet and receiver."""
    n_receptions: int = 0
    """The number of receptions so far."""
    now: int = 0
    """The time up to which events are processed [ns]."""


class Network:
    """The devices, and the packets between them.

    Args:
        stream: a function that returns the random generator of a name.
        surface: the height of the water surface in the world W [m].
        channels: the channels on which devices send, by name.
    """

    def __init__(
        self,
        stream: Callable[[str], np.random.Generator],
        *,
        surface: float = 0.0,
        channels: Mapping[str, Channel] = MappingProxyType({}),
    ) -> None:
        self.channels = channels
        """The channels on which devices send, by name."""
        self.trace: Callable[[str], None] | None = None
        """The function that receives a line of text for each outcome of a packet."""
        self._stream, self._surface = stream, surface
        self._modems: list[Modem] = []
        self._events: EventQueue[_Event | _Arrival] = EventQueue()
        self.state = NetworkState([], self._events.state)
        """The state of all devices and of the packets in transit."""

    @property
    def now(self) -> int:
        """The time up to which events are processed [ns]."""
        return self.state.now

    @property
    def is_idle(self) -> bool:
        """True if no packet is in transit or queued."""
        return not self._events

    def join(self, modem: Modem) -> Callable[[bytes, int], None]:
        """Add a device; return ``send(data, destination)``, which queues a packet to an address."""
        modem_index = len(self._modems)
        self._modems.append(modem)
        self.state.modems.append(modem.state)
        return lambda data, destination: self._queue(modem_index, data, destination)

    def modem(self, name: str) -> Modem:
        """Return a device by its name; raise UnknownName if there is none."""
        for modem in self._modems:
            if modem.settings.name == name:
                return modem
        raise UnknownName("modem", name, [other.settings.name for other in self._modems])

    def advance(self, now: int) -> None:
        """Process all events up to ``now`` [ns]."""
        if not self._modems:
            return
        while (due := self._events.take(now)) is not None:
            self.state.now, event = due
            self._process_event(event)
        self.state.now = max(self.now, now)

    def _process_event(self, event: _Event | _Arrival) -> None:
        if isinstance(event, _Event):
            (self._try_to_send if event.kind == "try" else self._finish_sending)(event.modem)
        elif event.kind == "begin":
            self._begin_reception(event.reception)
        elif event.kind == "end":
            self._end_reception(event.reception)
        else:
            reception = self.state.receptions.pop(event.reception)
            modem = self._modems[reception.receiver]
            self._count(modem, "received", reception.sender, reception.packet)
            modem.deliver(reception.packet, self.now)

    def _queue(self, modem_index: int, data: bytes, destination: int) -> None:
        """Append a packet to the queue of a device, if the queue has space."""
        modem = self._modems[modem_index]
        settings, state, packet_number = modem.settings, modem.state, modem.state.n_packets
        state.n_packets += 1
        packet = Packet(
            number=packet_number, source=settings.address, destination=destination, data=data
        )
        self._count(modem, "queued", modem_index, packet)
        if modem.is_dead(self.now):
            self._count(modem, "no_energy", modem_index, packet)
            return
        if state.n_queued_bytes + packet.queue_size > settings.queue_size:
            self._count(modem, "queue_full", modem_index, packet)
            return
        delay = settings.send_delay
        if settings.send_jitter > 0.0:
            random_delay = self._draw(f"{settings.name}/{packet_number}/send").random()
            delay += settings.send_jitter * random_delay
        state.queue.append(QueuedPacket(packet=packet, ready_time=self.now + nanoseconds(delay)))
        state.n_queued_bytes += packet.queue_size
        if not state.is_busy:
            self._plan_next(modem_index)

    def _plan_next(self, modem_index: int) -> None:
        """Schedule the first packet of a device's queue for its earliest time."""
        state = self._modems[modem_index].state
        state.is_busy = bool(state.queue)
        if state.queue:
            self._events.add(max(state.queue[0].ready_time, self.now), _Event("try", modem_index))

    def _try_to_send(self, modem_index: int) -> None:
        """Send the first packet of the queue, or schedule another try as the protocol requires."""
        modem = self._modems[modem_index]
        queued_packet, settings = modem.state.queue[0], modem.settings
        if modem.is_dead(self.now):
            self._count(modem, "no_energy", modem_index, queued_packet.packet)
            self._drop_first(modem)
            self._plan_next(modem_index)
            return
        name = f"{settings.name}/{queued_packet.packet.number}/backoff/{queued_packet.n_tries}"
        queued_packet.n_tries += 1
        time = settings.mac.send_time(
            self.now,
            is_receiving=bool(modem.state.incoming_receptions),
            draw=lambda upper_bound: int(self._draw(name).integers(upper_bound)),
        )
        if time > self.now:
            self._events.add(time, _Event("try", modem_index))
        else:
            self._send(modem_index, queued_packet.packet)

    def _send(self, modem_index: int, packet: Packet) -> None:
        """Send a packet to all devices within range."""
        sender = self._modems[modem_index]
        settings, state = sender.settings, sender.state
        duration = settings.airtime(len(packet.data))
        state.sending_end = self.now + duration
        state.time_sending += duration
        self._count(sender, "sent", modem_index, packet)
        if settings.is_half_duplex:
            for reception_number in state.incoming_receptions:
                self._mark_lost(reception_number, "half_duplex")
        self._events.add(state.sending_end, _Event("sent", modem_index))
        state.outgoing_receptions = [
            self._add_reception(modem_index, other, packet)
            for other, receiver in enumerate(self._modems)
            if other != modem_index and receiver.settings.listens_to == settings.sends_on
            if sender.reaches(self._path(sender, receiver))
        ]
        for outgoing_number in state.outgoing_receptions:
            arrival = self.state.receptions[outgoing_number].arrival
            self._events.add(arrival, _Arrival("begin", outgoing_number), rank=1)

    def _mark_lost(self, reception_number: int, outcome: Outcome) -> None:
        reception = self.state.receptions[reception_number]
        reception.loss_reason = reception.loss_reason or outcome

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

    def _finish_sending(self, modem_index: int) -> None:
        """End the sending of a packet; the present distance delays the last bit."""
        modem = self._modems[modem_index]
        for reception_number in modem.state.outgoing_receptions:
            reception = self.state.receptions[reception_number]
            path = self._path(modem, self._modems[reception.receiver])
            end = self.now + nanoseconds(modem.settings.channel.delay(path))
            self._events.add(max(end, reception.arrival + 1), _Arrival("end", reception_number))
        modem.state.outgoing_receptions = []
        self._drop_first(modem)
        self._plan_next(modem_index)

    def _drop_first(self, modem: Modem) -> None:
        modem.state.n_queued_bytes -= modem.state.queue.popleft().packet.queue_size

    def _begin_reception(self, reception_number: int) -> None:
        """Begin to receive a packet; packets that arrive at the same time are all lost."""
        reception = self.state.receptions[reception_number]
        modem = self._modems[reception.receiver]
        if modem.is_dead(self.now):
            reception.loss_reason = "no_energy"
        elif modem.settings.is_half_duplex and modem.state.sending_end > self.now:
            reception.loss_reason = "half_duplex"
        if modem.state.incoming_receptions:
            for lost_number in (*modem.state.incoming_receptions, reception_number):
                self._mark_lost(lost_number, "collisions")
        modem.state.incoming_receptions.append(reception_number)

    def _end_reception(self, reception_number: int) -> None:
        """End the reception of a packet; schedule its delivery unless it is lost."""
        reception = self.state.receptions.pop(reception_number)
        modem, packet = self._modems[reception.receiver], reception.packet
        modem.state.incoming_receptions.remove(reception_number)
        if reception.loss_reason != "no_energy":
            modem.state.time_receiving += self.now - reception.arrival
        sender = self._modems[reception.sender].settings.name
        name = f"{modem.settings.name}/{sender}/{packet.number}"
        if reception.loss_reason is None and self._is_damaged(reception, name):
            reception.loss_reason = "errors"
        if reception.loss_reason is not None:
            self._count(modem, reception.loss_reason, reception.sender, packet)
        elif packet.destination in (BROADCAST_ADDRESS, modem.settings.address):
            delay = 0.0
            if modem.settings.receive_jitter > 0.0:
                delay = modem.settings.receive_jitter * self._draw(f"{name}/receive").random()
            delivery = max(self.now + nanoseconds(delay), modem.state.last_delivery)
            modem.state.last_delivery = delivery
            self.state.receptions[reception_number] = reception
            self._events.add(delivery, _Arrival("deliver", reception_number))

    def _count(self, modem: Modem, outcome: Outcome, sender: int, packet: Packet) -> None:
        """Count an outcome of a packet at a device, and write it to the trace."""
        name = f"n_{outcome}"
        setattr(modem.counts, name, getattr(modem.counts, name) + 1)
        if self.trace is not None:
            packet_name = f"{self._modems[sender].settings.name}#{packet.number}"
            time = f"{self.now // NANOSECONDS}.{self.now % NANOSECONDS:09d}"
            self.trace(
                f"{time} {modem.settings.name} {outcome} {packet_name} {len(packet.data)} bytes"
            )

    def _is_damaged(self, reception: Reception, name: str) -> bool:
        probability = reception.error_probability
        return probability > 0.0 and float(self._draw(f"{name}/error").random()) < probability

    def _path(self, sender: Modem, receiver: Modem) -> Path:
        a, b = sender.position(), receiver.position()
        depth = self._surface - 0.5 * (float(a[2]) + float(b[2]))
        return Path(distance=length(a - b), depth=min(max(depth, 0.0), MAX_DEPTH))

    def _draw(self, name: str) -> np.random.Generator:
        return self._stream(f"network/{name}")
