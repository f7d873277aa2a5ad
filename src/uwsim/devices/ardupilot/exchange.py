"""The exchange of packets with ArduPilot in lock-step: one servo packet, one answer.

ArduPilot waits for the answer to each packet, and sends the same packet again after about one
second without one. The rules for the numbers of frames:

============  =====================================================================================
number        meaning
============  =====================================================================================
next          the next frame
the same      the answer was lost: it is sent again, and no step is taken. If it was only late, that
              is, the packets wait together, one answer suffices
skipped       packets were lost; they are counted
lower         near 0, or twice in a row: ArduPilot was started again; the simulation continues, with
              or without the vehicle back at its start, or ends as invalid. Else a repeated packet
              that the network delayed: it is counted, and nothing else
first, not 0  ArduPilot was running before this simulation, perhaps left over from an earlier run
============  =====================================================================================

ArduPilot that has read two answers to one frame is one frame ahead. Its next packet then waits
before the answer to the last one is due. That answer is sent for the newest packet, and both count
the same frames again.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Literal

from ...autopilots.ardupilot import ServoPacket, read_servo_packet
from ...base.record import Record
from ...base.terminal import report
from ...errors import ClientLost
from ...world import DatagramPort

OnRestart = Literal["continue", "reset", "end"]
"""The effect of a new start of ArduPilot during a run."""
WAIT_SLICE = 0.2
"""The wall time of one wait, after which limits are checked [s]."""
RESTART_SILENCE = 2.0
"""The wall time of silence after which a packet of another sender counts as a new start [s]. If the
silent one was running before the simulation, it is `WAIT_SLICE`."""
RESTART_EFFECTS = {
    "continue": "the simulation continues",
    "reset": "the vehicle is back at its start",
    "end": "the run ends",
}
"""The effect of a new start of ArduPilot in words."""
MAX_DRAINED = 64
"""The greatest number of waiting packets that one answer covers."""
CHECK_PERIOD = 64
"""The number of answers after which datagrams of other senders are counted."""
FIRST_FRAMES = 10
"""The number of frames of a start: a lower number among them is a new start at once."""
MAX_COUNTED = 64
"""The greatest number of other datagrams that are counted at once, one for each exchange."""
MAX_SEARCHED = 1000
"""The greatest number of other datagrams among which a new start is searched at once."""


@dataclass(slots=True)
class ExchangeState(Record):
    """The state of an exchange."""

    frame_count: int | None = None
    """The number of the last frame; None before the first packet."""
    late_count: int | None = None
    """The number of the last packet if it was lower than that of its frame; else None."""
    first_count: int = 0
    """The number of the sender's first frame; not 0 if it was running before."""
    pwm: tuple[int, ...] = ()
    """The pulse widths of the last packet [us]."""
    answer: bytes = b""
    """The last answer, which is sent again if it was lost."""
    is_pending: bool = False
    """True if the last packet has no answer yet."""
    n_exchanges: int = 0
    """The number of answers so far, without repeated ones."""
    n_duplicates: int = 0
    """The number of packets that were received again."""
    n_lost: int = 0
    """The number of packets that were lost, from the numbers of frames."""
    n_restarts: int = 0
    """The number of times that ArduPilot was started again."""
    n_invalid: int = 0
    """The number of datagrams of the wrong size or with the wrong magic."""
    n_others: int = 0
    """The number of datagrams of other senders that were read."""
    n_dropped: int = 0
    """The number of datagrams of other senders that the system dropped, as their queue was full."""

    @property
    def has_events(self) -> bool:
        """True if packets were lost, repeated or invalid."""
        counts = (self.n_duplicates, self.n_lost, self.n_restarts, self.n_invalid)
        return any((*counts, self.n_others, self.n_dropped))


class Exchange:
    """The exchange with one ArduPilot.

    Args:
        port: the port at which ArduPilot sends.
        timeout: the longest silence [s of wall time].
        on_restart: the effect of a new start of ArduPilot; with ``end`` the run is invalid.
        hint: the text about how to start ArduPilot.
    """

    def __init__(
        self, port: DatagramPort, *, timeout: float, on_restart: OnRestart, hint: str
    ) -> None:
        self._port, self._timeout, self._hint = port, timeout, hint
        self._on_restart = on_restart
        self.state = ExchangeState()
        """The state of the exchange."""

    @property
    def place(self) -> str:
        """The port in words."""
        host, port = self._port.address
        return f"UDP {host}:{port}"

    def wait_for_packet(self, simulation_time: float) -> None:
        """Wait for the packet of the next frame; its pulse widths are then in the state.

        Args:
            simulation_time: the simulation time, for messages [s].

        Raises:
            ClientLost: nothing came within the limit, or ArduPilot was started again.
        """
        start, is_reported = time.monotonic(), False
        while True:
            datagram = self._port.receive(WAIT_SLICE)
            if datagram is not None and self._accept(*datagram):
                return
            silence = time.monotonic() - start
            if silence >= self._timeout:
                raise ClientLost(self._describe_silence(simulation_time))
            if datagram is not None:
                continue
            if not is_reported:
                is_reported = self._report_wait(silence)
            if silence >= (WAIT_SLICE if self.state.first_count else RESTART_SILENCE):
                datagram = self._receive_from_new_sender()
                if datagram is not None and self._accept(*datagram):
                    return

    def send_answer(self, answer: bytes) -> None:
        """Send the answer to the newest packet of those that wait."""
        state = self.state
        for _ in range(MAX_DRAINED):
            datagram = self._port.receive()
            if datagram is None:
                break
            packet = read_servo_packet(datagram[0])
            if packet is None:
                state.n_invalid += 1
            elif packet.frame_count == state.frame_count or self._is_late(packet):
                state.n_duplicates += 1
            else:
                self._count_frames(packet)
        state.answer, state.is_pending = answer, False
        state.n_exchanges += 1
        self._port.send(answer)
        if state.n_exchanges % CHECK_PERIOD == 0:
            self._count_others()

    def _accept(self, data: bytes, sender: tuple[str, int]) -> bool:
        """Return whether a datagram is the packet of a new frame."""
        state, packet = self.state, read_servo_packet(data)
        if packet is None:
            state.n_invalid += 1
            return False
        is_new_sender = self._port.peer != sender
        if is_new_sender:
            self._port.set_peer(sender)
            state.first_count = packet.frame_count
            if state.frame_count is None:
                self._report_connection(packet, sender)
        if packet.frame_count == state.frame_count and not is_new_sender:
            state.n_duplicates += 1
            self._port.send(state.answer)
            return False
        if not is_new_sender and self._is_late(packet):
            state.n_duplicates += 1
            return False
        self._count_frames(packet)
        state.is_pending = True
        return True

    def _is_late(self, packet: ServoPacket) -> bool:
        """Return whether a packet of the same sender is an old one that the network delayed.

        A program that starts sends a number near 0, and the same number until it has the answer.
        """
        state = self.state
        is_lower = state.frame_count is not None and packet.frames_since(state.frame_count) < 0
        is_repeated = packet.frame_count == state.late_count
        state.late_count = packet.frame_count if is_lower else None
        return is_lower and packet.frame_count >= FIRST_FRAMES and not is_repeated

    def _count_frames(self, packet: ServoPacket) -> None:
        """Store a packet, and count lost packets and new starts from its number.

        Raises:
            ClientLost: ArduPilot was started again, which ends the run.
        """
        state = self.state
        if state.frame_count is not None:
            n_frames = packet.frames_since(state.frame_count)
            if n_frames <= 0:
                self._count_restart()
            else:
                state.n_lost += n_frames - 1
        state.frame_count, state.pwm = packet.frame_count, packet.pwm

    def _count_restart(self) -> None:
        self.state.n_restarts += 1
        if self._on_restart == "end":
            raise ClientLost(
                f"ArduPilot on {self.place} was started again: the run is invalid. "
                "<onRestart>continue</onRestart> or <onRestart>reset</onRestart> permits it."
            )
        effect = RESTART_EFFECTS[self._on_restart]
        report(f"ArduPilot on {self.place} was started again; {effect}.")

    def _report_connection(self, packet: ServoPacket, sender: tuple[str, int]) -> None:
        was_running = f"; it was running before, at frame {packet.frame_count}"
        report(
            f"ArduPilot at {sender[0]}:{sender[1]} is connected to {self.place}: "
            f"{len(packet.pwm)} channels{was_running if packet.frame_count else ''}."
        )

    def _receive_from_new_sender(self) -> tuple[bytes, tuple[str, int]] | None:
        """Return a packet of another sender than the silent one; None if there is none."""
        peer = self._port.peer
        datagrams = [
            (data, sender)
            for data, sender in self._port.receive_others(MAX_SEARCHED)
            if sender != peer
        ]
        packets = [datagram for datagram in datagrams if read_servo_packet(datagram[0]) is not None]
        self.state.n_others += len(datagrams) - bool(packets)
        return packets[-1] if packets else None

    def _count_others(self) -> None:
        peer = self._port.peer
        datagrams = self._port.receive_others(MAX_COUNTED)
        self.state.n_others += sum(sender != peer for _, sender in datagrams)
        self.state.n_dropped = self._port.n_dropped

    def _report_wait(self, silence: float) -> bool:
        """Report the first wait at once, a later one after the silence of a new start."""
        if self.state.frame_count is None:
            report(f"waiting for ArduPilot on {self.place}. Start it, for example: {self._hint}")
            return True
        if silence < RESTART_SILENCE:
            return False
        report(
            f"ArduPilot on {self.place} is silent; the run ends after {self._timeout:g} s of wall "
            f"time.{self._old_program_hint}"
        )
        return True

    @property
    def _old_program_hint(self) -> str:
        """The advice about an ArduPilot of an earlier run; empty if this one has begun at 0."""
        if not self.state.first_count:
            return ""
        return (
            " It was running before: an old ArduPilot holds its ports. End it with kill -9, and "
            "start ArduPilot again."
        )

    def _describe_silence(self, simulation_time: float) -> str:
        if self.state.frame_count is None:
            return (
                f"ArduPilot has sent nothing to {self.place} within {self._timeout:g} s of wall "
                f"time (<timeout>). Start it, for example: {self._hint}"
            )
        return (
            f"ArduPilot on {self.place} is silent for {self._timeout:g} s of wall time "
            f"(<timeout>) at {simulation_time:g} s: the run is invalid.{self._old_program_hint}"
        )

    def describe(self) -> str:
        """Return a sentence with the numbers of the exchange."""
        state = self.state
        counts = {
            "received again": state.n_duplicates,
            "lost": state.n_lost,
            "new starts": state.n_restarts,
            "invalid": state.n_invalid,
            "of other senders": state.n_others + state.n_dropped,
        }
        events = ", ".join(f"{name} {n}" for name, n in counts.items() if n)
        return f"ArduPilot on {self.place}: {state.n_exchanges} frames" + (
            f"; packets: {events}" if events else ""
        )
