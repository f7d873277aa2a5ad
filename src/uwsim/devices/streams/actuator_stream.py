"""Commands to thrusters as bytes from hardware or a program outside.

.. code-block:: xml

    <u:actuatorStream>
      <name>thrusters</name> <address>udpin:127.0.0.1:9201</address>
      <format>sentence</format> <rate>20</rate> <timeout>0.5</timeout>
    </u:actuatorStream>

The formats ``sentence`` and ``binary`` are those of `uwsim.autopilots.instruments.commands`. All
bytes that have arrived are read at the beginning of each step, and the newest valid command is
applied. A run that receives commands is not repeatable. Bytes that are not a command are counted
and have no other effect; of more than 2048 bytes in a step only the newest are read.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ...autopilots.instruments.commands import (
    ThrusterCommands,
    read_binary_commands,
    read_command_sentence,
)
from ...autopilots.instruments.framing import Frames, split_binary, split_lines
from ...autopilots.instruments.utc import parse_epoch
from ...base.record import Record
from ...errors import BadMessage
from ...messages import Float64MultiArray
from ...schema import element
from ...vehicle import Autopilot
from ...world import ByteStream, DeviceWorld, TerminalStream
from ..device import Device, DeviceSpec, DeviceTopic, DeviceVehicle
from .endpoint import describe_endpoint_errors, raise_stream_errors
from .observer import StreamObserver

MAX_BYTES = 2048
"""The number of bytes that are read in a step; of more, the newest."""
MAX_MESSAGES = 32
"""The number of messages that are read in a step; of more, the newest."""
MAX_RECEIVED = 32768
"""The number of bytes after which no more are received in a step; a TCP peer then has to wait."""
MAX_PIECES = 16
"""The number of datagrams or pieces that are received in a step; others wait."""


@dataclass(frozen=True, kw_only=True)
class ActuatorStreamSpec(DeviceSpec):
    """A ``<u:actuatorStream>`` of a vehicle with ``u:dynamics``."""

    name: str
    """The name of the stream, for reports."""
    address: str
    """The address at which commands arrive: ``udpin:HOST:PORT``, ``tcpin:HOST:PORT``,
    ``tcp:HOST:PORT``, ``serial:PATH:BIT_RATE``, ``pty`` or ``pty:LINK``."""
    format: Literal["sentence", "binary"] = "sentence"
    """The format of the commands: the sentences PUWTC and PUWTP, or binary messages."""
    rate: float = element(default=10.0, minimum=0.01, maximum=1000.0)
    """The rate at which commands are expected [Hz]; `uwsim run --strict` reports late ones."""
    timeout: float | None = element(default=None, exclusive_minimum=0.0, maximum=3600.0)
    """The simulation time without a command after which the thrusters stop [s]; by default they
    hold the last command."""
    topic: str = ""
    """The topic on which applied commands are published, for recordings; empty: none."""
    epoch: str = "2026-01-01T00:00:00Z"
    """The date and time at the start of the simulation."""

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """The topic of applied commands."""
        if not self.topic:
            return ()
        return (DeviceTopic(name=self.topic, message_type=Float64MultiArray, element="topic"),)

    def errors(self) -> list[str]:
        """Return the errors of epoch and address."""
        return describe_endpoint_errors(self.epoch, self.address)

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> ActuatorStream:
        """Open the stream; raise SceneError if the vehicle has no thrusters."""
        errors, autopilot = self.errors(), vehicle.autopilot
        if autopilot is None or not vehicle.thrusters:
            errors.append(f"{vehicle.name} has no thrusters; expected a vehicle with u:dynamics")
        raise_stream_errors(self, "u:actuatorStream", errors)
        assert autopilot is not None
        epoch_us = parse_epoch(self.epoch)
        connection = None
        if world.connections is not None:
            connection = world.connections.open(self.address)
        return ActuatorStream(
            self, world, autopilot, len(vehicle.thrusters), connection, epoch_us=epoch_us
        )


@dataclass(slots=True)
class ActuatorStreamState(Record):
    """The state of an actuator stream."""

    rest: bytes = b""
    """The beginning of a message that is not complete."""
    n_valid: int = 0
    """The number of valid commands so far."""
    n_invalid: int = 0
    """The number of messages that are no valid command so far."""
    n_skipped: int = 0
    """The number of bytes that belong to no message so far."""
    last_time: float = 0.0
    """The simulation time of the last command [s]."""
    is_stopped: bool = True
    """True if there was no command, or none for the timeout."""


class ActuatorStream(Device):
    """A stream that receives commands to the thrusters of a vehicle."""

    def __init__(
        self,
        spec: ActuatorStreamSpec,
        world: DeviceWorld,
        autopilot: Autopilot,
        n_thrusters: int,
        connection: ByteStream | None,
        *,
        epoch_us: int,
    ) -> None:
        self.name = spec.name
        """The name of the stream."""
        self.rate = spec.rate
        """The rate at which commands are expected [Hz]."""
        self.observer: StreamObserver | None = None
        """The observer of the stream, outside of the simulation."""
        self._spec, self._autopilot, self._n_thrusters = spec, autopilot, n_thrusters
        self._connection, self._epoch_us = connection, epoch_us
        self._is_datagram = spec.address.startswith("udp")
        self.state: ActuatorStreamState = ActuatorStreamState()
        publish = None
        if spec.topic:
            publish = world.bus.publisher(spec.topic, Float64MultiArray)
        self._publish = publish

    @property
    def is_open(self) -> bool:
        """True if the stream can receive commands."""
        return self._connection is not None

    @property
    def description(self) -> str:
        """The format and the other side, for the user."""
        path = self._connection.path if isinstance(self._connection, TerminalStream) else ""
        source = " ".join(filter(None, (path, self._spec.address)))
        return f"{self.name}: {self._spec.format} from {source}"

    def idle_until(self, time: float) -> float:
        """Return the time of the next check for bytes: the next step, or never."""
        return math.inf if self._connection is None else time

    def step(self, time: float) -> None:
        """Apply the newest command that has arrived since the last step."""
        if self._connection is None:
            return
        state = self.state
        commands = self._receive(self._connection, time)
        for command in commands:
            state.n_valid += 1
            stamp = None
            if command.time_us is not None:
                stamp = (command.time_us - self._epoch_us) / 1e6
            if self.observer is not None:
                self.observer.note_command(self.name, stamp)
        if commands:
            values = np.array(commands[-1].values)  # (n,) [1]
            self._apply(values)
            state.last_time, state.is_stopped = time, False
        elif self._has_timed_out(time):
            self._apply(np.zeros(self._n_thrusters))
            state.is_stopped = True

    def _apply(self, values: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> None:
        self._autopilot.set_thrusters(values)
        if self._publish is not None:
            self._publish(Float64MultiArray(data=values))

    def _has_timed_out(self, time: float) -> bool:
        timeout = self._spec.timeout
        state = self.state
        return timeout is not None and not state.is_stopped and time - state.last_time > timeout

    def _receive(self, connection: ByteStream, time: float) -> list[ThrusterCommands]:
        """Return the valid commands that have arrived; count all else."""
        state, commands = self.state, []
        frames = self._read_frames(connection)
        state.rest, state.n_skipped = frames.rest, state.n_skipped + frames.n_skipped
        n_left_out = max(len(frames.messages) - MAX_MESSAGES, 0)
        state.n_invalid += n_left_out
        now_us = self._epoch_us + round(1e6 * time)
        for message in frames.messages[n_left_out:]:
            try:
                command = (
                    read_binary_commands(message)
                    if self._spec.format == "binary"
                    else read_command_sentence(message, now_us)
                )
            except BadMessage:
                state.n_invalid += 1
                continue
            if len(command.values) == self._n_thrusters:
                commands.append(command)
            else:
                state.n_invalid += 1
        return commands

    def _read_frames(self, connection: ByteStream) -> Frames:
        """Return the messages in the newest bytes; each datagram ends a message."""
        pieces = [] if self._is_datagram else [self.state.rest]
        n_received = 0
        for _ in range(MAX_PIECES):
            piece = connection.receive() if n_received < MAX_RECEIVED else b""
            if not piece:
                break
            pieces.append(piece)
            n_received += len(piece)
            is_sentence = self._spec.format == "sentence"
            if self._is_datagram and is_sentence and not piece.endswith(b"\n"):
                pieces.append(b"\n")
        data = b"".join(pieces)
        split = split_binary if self._spec.format == "binary" else split_lines
        frames = split(data[-MAX_BYTES:])
        n_skipped = frames.n_skipped + max(len(data) - MAX_BYTES, 0)
        if self._is_datagram:
            return Frames(frames.messages, b"", n_skipped + len(frames.rest))
        return Frames(frames.messages, frames.rest, n_skipped)
