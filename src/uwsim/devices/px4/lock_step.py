"""Lock-step with PX4: its clock advances with each HIL_SENSOR, and it answers each of them once.

PX4 connects, and sends HEARTBEAT. Its start script needs a running clock. So HIL_SENSOR is sent at
the pace of real time until the first HIL_ACTUATOR_CONTROLS arrives; meanwhile the simulation waits.
From then on each HIL_SENSOR waits for the HIL_ACTUATOR_CONTROLS with the same time. Source: PX4,
module ``simulator_mavlink``, and its user guide, "Simulation", "Lockstep Simulation".
"""

from __future__ import annotations

import time as wall_time
from collections.abc import Callable
from dataclasses import dataclass

from ...autopilots.px4 import (
    HIL_ACTUATOR_CONTROLS,
    RECEIVED_FORMATS,
    ActuatorControls,
    FrameReader,
    HilMessage,
    decode_actuator_controls,
    encode_frame,
)
from ...base.record import Record
from ...base.terminal import report
from ...errors import ClientLost
from ...world import ByteStream, ServerStream

HINT = (
    "PX4_SYS_AUTOSTART=60002 PX4_SIMULATOR=none PX4_PARAM_SIM_GZ_EN=0 "
    "build/px4_sitl_default/bin/px4"
)
"""The example of a command that starts PX4."""
MAX_BYTES = 1 << 20
"""The greatest number of bytes that are received while the simulation waits for one answer."""
WAIT_PERIOD = 0.1
"""The wall time of one wait, after which limits are checked [s]."""
SYSTEM, COMPONENT = 1, 200
"""The numbers of system and component with which simulators of PX4 send."""


@dataclass(slots=True)
class LockStepState(Record):
    """The state of an exchange with PX4."""

    clock_offset: int = 0
    """PX4's time at the simulation time 0 [us]."""
    n_frames: int = 0
    """The number of sent frames."""
    n_answers: int = 0
    """The number of answers that were waited for."""
    n_stale: int = 0
    """The number of answers to earlier HIL_SENSOR messages, which were not used."""
    n_invalid: int = 0
    """The number of answers with values out of range, which were not used."""
    n_skipped: int = 0
    """The number of received bytes that belong to no valid frame."""

    @property
    def has_events(self) -> bool:
        """True if answers were late or invalid, or bytes were no message."""
        return any((self.n_stale, self.n_invalid, self.n_skipped))


class LockStep:
    """An exchange with PX4 over a stream of bytes.

    Args:
        stream: the stream, of which PX4 is the client.
        address: the address of the stream, for messages.
        limit: the greatest wall time to wait for PX4's start and for each answer [s].
        state: the state of the exchange, which this object changes.
    """

    def __init__(
        self, stream: ByteStream, address: str, limit: float, state: LockStepState
    ) -> None:
        self._stream, self._address, self._limit = stream, address, limit
        self._reader = FrameReader(RECEIVED_FORMATS)
        self._n_clients = 0
        self.state = state
        """The state of the exchange."""

    def start(self, messages: Callable[[int], list[HilMessage]], period: int, time: float) -> None:
        """Run PX4's clock until it has answered all that was sent, and set `clock_offset`.

        The answers are not used: the number of messages before the first one, and so their noise,
        depends on the wall clock. The next HIL_SENSOR is one period later.

        Args:
            messages: the function that returns the messages at a time of PX4's clock [us].
            period: the interval of HIL_SENSOR [us].
            time: the simulation time, at which the simulation waits [s].

        Raises:
            ClientLost: PX4 does not connect or does not answer within the limit.
        """
        deadline = wall_time.monotonic() + self._limit
        clock, has_answer, is_answered, is_reported = 0, False, False, False
        while not has_answer:
            if wall_time.monotonic() > deadline:
                raise ClientLost(self._describe_missing_start())
            if not self._stream.is_connected:
                self._stream.receive(WAIT_PERIOD)
                if not (is_reported or self._stream.is_connected):
                    is_reported = True
                    report(f"waiting for PX4 on {self._address}. Start it, for example: {HINT}")
                continue
            next_time = wall_time.monotonic() + 1e-6 * period
            clock += period
            self._send(messages(clock))
            rest = next_time - wall_time.monotonic()
            while True:  # receives once at least, however long the messages took
                self._check_skipped(0)
                for answer in self._receive(max(rest, 0.0)):
                    self._check_lock_step(answer)
                    has_answer = True
                    is_answered = answer.time_usec >= clock
                rest = next_time - wall_time.monotonic()
                if has_answer or rest <= 0.0:
                    break
        if not is_answered:
            self._wait_for(clock)
        self.state.clock_offset = clock + period - round(1e6 * time)
        self._n_clients = self._count_clients()

    def exchange(self, messages: list[HilMessage], clock: int) -> ActuatorControls:
        """Send messages, the last of which is HIL_SENSOR, and return the answer.

        Args:
            messages: the messages.
            clock: the time of HIL_SENSOR on PX4's clock [us].

        Raises:
            ClientLost: PX4 has closed the connection, or does not answer within the limit.
        """
        if not self._stream.is_connected:
            raise ClientLost(f"PX4 has closed the connection to {self._address}.")
        self._check_client()
        self._send(messages)
        return self._wait_for(clock)

    def describe(self) -> str:
        """Return a sentence with the numbers of the exchange."""
        state = self.state
        counts = {
            "late answers": state.n_stale,
            "invalid answers": state.n_invalid,
            "bytes of no message": state.n_skipped,
        }
        events = ", ".join(f"{n} {name}" for name, n in counts.items() if n)
        return f"PX4 on {self._address}: {state.n_answers} answers" + (
            f"; {events}" if events else ""
        )

    def _wait_for(self, clock: int) -> ActuatorControls:
        deadline, n_skipped = wall_time.monotonic() + self._limit, self.state.n_skipped
        while wall_time.monotonic() < deadline:
            for answer in self._receive(WAIT_PERIOD):
                self._check_lock_step(answer)
                if answer.time_usec >= clock:
                    self.state.n_answers += 1
                    return answer
                self.state.n_stale += 1
            self._check_skipped(n_skipped)
            self._check_client()
            if not self._stream.is_connected:
                raise ClientLost(f"PX4 has closed the connection to {self._address}.")
        raise ClientLost(
            f"PX4 has not answered HIL_SENSOR of {1e-6 * clock:.6f} s within {self._limit:g} s. If "
            "its modules run at another rate, change <rate>."
        )

    def _receive(self, timeout: float) -> list[ActuatorControls]:
        """Return the valid answers among the bytes that have arrived; wait for the first byte."""
        data = self._stream.receive(timeout)
        answers: list[ActuatorControls] = []
        for frame in self._reader.read(data):
            if frame.message != HIL_ACTUATOR_CONTROLS:
                continue
            answer = decode_actuator_controls(frame.payload)
            if answer is None:
                self.state.n_invalid += 1
            else:
                answers.append(answer)
        self.state.n_skipped = self._reader.n_skipped
        return answers

    def _send(self, messages: list[HilMessage]) -> None:
        data = b""
        for message in messages:
            data += encode_frame(
                message.message,
                message.payload(),
                crc_extra=message.crc_extra,
                sequence=self.state.n_frames,
                system=SYSTEM,
                component=COMPONENT,
            )
            self.state.n_frames += 1
        deadline = wall_time.monotonic() + self._limit
        while not self._stream.send(data):
            if not self._stream.is_connected:
                raise ClientLost(f"PX4 has closed the connection to {self._address}.")
            if wall_time.monotonic() > deadline:
                raise ClientLost(f"PX4 does not read from {self._address}.")
            wall_time.sleep(0.001)

    def _check_skipped(self, n_before: int) -> None:
        if self.state.n_skipped - n_before > MAX_BYTES:
            raise ClientLost(
                f"{self._address} received more than {MAX_BYTES} bytes that are no messages of PX4 "
                "while an answer was due."
            )

    def _count_clients(self) -> int:
        return self._stream.n_clients if isinstance(self._stream, ServerStream) else 0

    def _check_client(self) -> None:
        """Raise ClientLost if another client is connected than at the start, as no step waits."""
        if self._n_clients and self._count_clients() != self._n_clients:
            raise ClientLost(
                f"PX4 has closed the connection to {self._address}, or was silent, and another "
                "client has connected. Start the run and PX4 again."
            )

    def _check_lock_step(self, answer: ActuatorControls) -> None:
        if not answer.is_lock_step:
            raise ClientLost(
                "PX4 does not run in lock-step: flag 1 of HIL_ACTUATOR_CONTROLS is not set. "
                "Use a build for simulation, such as px4_sitl_default."
            )

    def _describe_missing_start(self) -> str:
        state = self.state
        if state.n_invalid or state.n_skipped:
            counts = f"{state.n_invalid} invalid answers and {state.n_skipped} bytes of no message"
            return (
                f"A program has connected to {self._address}, but has sent no valid "
                f"HIL_ACTUATOR_CONTROLS within {self._limit:g} s: {counts}. Expected PX4, with "
                "finite outputs."
            )
        if not self._stream.is_connected:
            return f"PX4 has not connected to {self._address} within {self._limit:g} s."
        return (
            f"PX4 is connected to {self._address}, but has sent no HIL_ACTUATOR_CONTROLS within "
            f"{self._limit:g} s. It sends them when pwm_out_sim and a controller run."
        )
