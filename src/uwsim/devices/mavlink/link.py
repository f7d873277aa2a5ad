"""A link to an autopilot: messages over a stream of bytes, with counters."""

from __future__ import annotations

from dataclasses import dataclass, field

from ...autopilots.mavlink import Codec, Identity, Message, MessageReader
from ...autopilots.mavlink.stream import ReaderState
from ...base.record import Record
from ...world import ByteStream

MAX_OUTBOX = 256
"""The greatest number of messages that wait to be sent."""
MAX_RECEIVES = 32
"""The greatest number of pieces, or datagrams, that one poll receives."""


@dataclass(slots=True)
class LinkState(Record):
    """The state of a link."""

    reader: ReaderState = field(default_factory=ReaderState)
    """The bytes that have arrived, and their counters."""
    outbox: list[bytes] = field(default_factory=list)
    """The messages that `Link.flush` sends."""
    sequence: int = 0
    """The number of the next message, modulo 256."""
    n_sent: int = 0
    """The number of messages sent so far."""
    n_unsent: int = 0
    """The number of messages that were not sent, because the peer was absent or did not read."""


class Link:
    """A link; without a stream, nothing is sent and nothing received.

    Messages wait until the next `flush`. Topics are published at the end of a step, when an
    autopilot in lock-step is computing; a message at that time would be read in one loop or the
    next, and two runs would differ. The device flushes when the autopilot waits for an answer.
    """

    def __init__(self, stream: ByteStream | None = None, codec: Codec | None = None) -> None:
        self._stream, self._codec = stream, codec
        self.state = LinkState()
        """The counters, and the bytes that have arrived."""

    @property
    def is_open(self) -> bool:
        """True if there is a stream."""
        return self._stream is not None

    @property
    def is_connected(self) -> bool:
        """True if there is a peer."""
        return self._stream is not None and self._stream.is_connected

    @property
    def has_outbox(self) -> bool:
        """True if messages wait to be sent."""
        return bool(self.state.outbox)

    def send(self, message: Message, identity: Identity) -> None:
        """Put a message into the outbox."""
        if self._stream is None or self._codec is None:
            return
        state = self.state
        if len(state.outbox) >= MAX_OUTBOX or not self._stream.is_connected:
            state.n_unsent += 1
            return
        state.outbox.append(self._codec.encode(message, identity, state.sequence))
        state.sequence = (state.sequence + 1) % 256

    def flush(self) -> None:
        """Send the messages of the outbox; those that the peer does not read are lost."""
        if self._stream is None:
            return
        state = self.state
        for data in state.outbox:
            if self._stream.send(data):
                state.n_sent += 1
            else:
                state.n_unsent += 1
        state.outbox.clear()

    def receive(self) -> list[Message]:
        """Return the messages that have arrived; see `uwsim.autopilots.mavlink.stream`."""
        if self._stream is None or self._codec is None:
            return []
        pieces: list[bytes] = []
        while len(pieces) < MAX_RECEIVES and (piece := self._stream.receive()):
            pieces.append(piece)
        return MessageReader(self._codec, self.state.reader).read(b"".join(pieces))
