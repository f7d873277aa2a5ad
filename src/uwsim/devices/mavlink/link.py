"""A link to an autopilot: messages over a stream of bytes, with counters."""

from __future__ import annotations

from dataclasses import dataclass, field

from ...autopilots.mavlink import Codec, Identity, Message, MessageReader
from ...autopilots.mavlink.stream import ReaderState
from ...base.record import Record
from ...world import ByteStream

MAX_RECEIVES = 32
"""The greatest number of pieces, or datagrams, that one poll receives."""


@dataclass(slots=True)
class LinkState(Record):
    """The state of a link."""

    reader: ReaderState = field(default_factory=ReaderState)
    """The bytes that have arrived, and their counters."""
    sequence: int = 0
    """The number of the next message, modulo 256."""
    n_sent: int = 0
    """The number of messages sent so far."""
    n_unsent: int = 0
    """The number of messages that were not sent, because the peer was absent or did not read."""


class Link:
    """A link; without a stream, nothing is sent and nothing received."""

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

    def send(self, message: Message, identity: Identity) -> bool:
        """Send a message; return False if there is no peer, or it does not read."""
        if self._stream is None or self._codec is None:
            return False
        state = self.state
        is_sent = self._stream.send(self._codec.encode(message, identity, state.sequence))
        if is_sent:
            state.sequence = (state.sequence + 1) % 256
            state.n_sent += 1
        else:
            state.n_unsent += 1
        return is_sent

    def receive(self) -> list[Message]:
        """Return the messages that have arrived; see `uwsim.autopilots.mavlink.stream`."""
        if self._stream is None or self._codec is None:
            return []
        pieces: list[bytes] = []
        while len(pieces) < MAX_RECEIVES and (piece := self._stream.receive()):
            pieces.append(piece)
        return MessageReader(self._codec, self.state.reader).read(b"".join(pieces))
