"""The division of a stream of bytes into messages, with bounded memory and time."""

from __future__ import annotations

from dataclasses import dataclass

from .commands import COMMANDS, MAX_THRUSTERS, PULSE_WIDTHS, SYNC, binary_length, has_checksum
from .sentence import MAX_LENGTH


@dataclass(frozen=True)
class Frames:
    """The complete messages of a buffer."""

    messages: tuple[bytes, ...]
    """The messages, oldest first."""
    rest: bytes
    """The beginning of a message that is not complete, at most `MAX_LENGTH` bytes."""
    n_skipped: int
    """The number of bytes that belong to no message."""


def split_lines(data: bytes) -> Frames:
    """Divide a stream into lines that begin with ``$``; a second ``$`` begins a line anew."""
    *lines, rest = data.split(b"\n")
    messages, n_skipped = [], 0
    for line in lines:
        start = line.rfind(b"$")
        n_skipped += len(line) + 1 if start < 0 else start
        if start >= 0:
            messages.append(line[start:])
    start = rest.rfind(b"$")
    tail = rest[start:] if start >= 0 and len(rest) - start <= MAX_LENGTH else b""
    return Frames(tuple(messages), tail, n_skipped + len(rest) - len(tail))


def split_binary(data: bytes) -> Frames:
    """Divide a stream into binary commands with a correct checksum; skip all other bytes."""
    messages: list[bytes] = []
    position, n_skipped = 0, 0
    while True:
        start = data.find(SYNC, position)
        if start < 0:
            tail = SYNC[:1] if data.endswith(SYNC[:1]) and position < len(data) else b""
            return Frames(tuple(messages), tail, n_skipped + len(data) - position - len(tail))
        n_skipped += start - position
        head = data[start : start + 4]
        if len(head) == 4 and not _is_head(head):
            position, n_skipped = start + 2, n_skipped + 2
            continue
        if len(head) < 4 or len(data) - start < binary_length(head):
            return Frames(tuple(messages), data[start:], n_skipped)
        message = data[start : start + binary_length(head)]
        if has_checksum(message):
            messages.append(message)
            position = start + len(message)
        else:  # a second command may begin inside of a damaged one
            position, n_skipped = start + 2, n_skipped + 2


def _is_head(head: bytes) -> bool:
    """Return whether 4 bytes are the beginning of a binary command."""
    return head[2] in (COMMANDS, PULSE_WIDTHS) and 1 <= head[3] <= MAX_THRUSTERS
