"""The messages in a stream of bytes, of which some may be lost, altered or meaningless."""

from __future__ import annotations

from dataclasses import dataclass, field

from ...base.record import Record
from .codec import MAGIC_1, MAGIC_2, Codec
from .message import Message

MAX_BUFFER = 65536
"""The greatest number of bytes that wait to be read [bytes]; the oldest are discarded."""
MAX_BYTES_PER_CALL = 16384
"""The greatest number of bytes that one call reads, so that a flood does not delay a step."""
MAX_FRAMES_PER_CALL = 400
"""The greatest number of frames, valid or not, that one call decodes."""


@dataclass(slots=True)
class ReaderState(Record):
    """The state of a reader."""

    buffer: bytes = b""
    """The bytes that have arrived and are not read yet."""
    n_messages: int = 0
    """The number of valid messages so far."""
    n_invalid_bytes: int = 0
    """The number of bytes so far that belong to no valid message."""


@dataclass
class MessageReader:
    """The reader of a stream; invalid bytes are counted and skipped.

    A frame whose checksum is invalid is skipped by one byte only, because the bytes in it may
    contain the begin of a valid frame.
    """

    codec: Codec
    """The decoder."""
    state: ReaderState = field(default_factory=ReaderState)
    """The bytes that wait, and the counters."""

    def read(self, data: bytes) -> list[Message]:
        """Return the messages that ``data`` completes, in their order."""
        state = self.state
        buffer = state.buffer + data
        if len(buffer) > MAX_BUFFER:
            state.n_invalid_bytes += len(buffer) - MAX_BUFFER
            buffer = buffer[-MAX_BUFFER:]
        messages: list[Message] = []
        start, end = 0, min(len(buffer), MAX_BYTES_PER_CALL)
        n_frames = 0
        while start < end and n_frames < MAX_FRAMES_PER_CALL:
            next_start = _find_magic(buffer, start, end)
            state.n_invalid_bytes += next_start - start
            start = next_start
            if start >= end:
                break
            length = self.codec.frame_length(buffer, start)
            if length == 0:
                break
            message = None
            if length is not None:
                message = self.codec.decode(buffer[start : start + length])
                n_frames += 1
            if message is None or length is None:
                state.n_invalid_bytes += 1
                start += 1
                continue
            messages.append(message)
            start += length
        state.n_messages += len(messages)
        state.buffer = buffer[start:]
        return messages


def _find_magic(buffer: bytes, start: int, end: int) -> int:
    """Return the index of the next byte with which a frame may begin; ``end`` if there is none."""
    indices = (buffer.find(magic, start, end) for magic in (MAGIC_1, MAGIC_2))
    return min((index for index in indices if index >= 0), default=end)
