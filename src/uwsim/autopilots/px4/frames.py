"""Frames of MAVLink on a stream of bytes: payloads in, bytes out, and back.

A frame of MAVLink 2 has a header of 10 bytes, a payload of 1 to 255 bytes and a checksum:

======  ====  ==============================================================
offset  size  field
======  ====  ==============================================================
0       1     253, the start of a frame
1       1     the length of the payload n
2       2     flags; bit 0 of the first announces a signature of 13 bytes
4       1     the sequence number
5       2     the numbers of the system and the component
7       3     the number of the message, little-endian
10      n     the payload, without the zeros at its end
10 + n  2     the checksum, little-endian
======  ====  ==============================================================

A frame of MAVLink 1 starts with 254, and has neither flags nor the two upper bytes of the message's
number. The checksum is CRC-16/MCRF4XX over all bytes but the first, and over one more byte, which
depends on the definition of the message. Source: MAVLink developer guide, "Packet Serialization".

The reader accepts the messages whose definition it knows, and no others. Signatures are not
checked. The sequence numbers of received frames are not checked, because TCP loses nothing.
"""

from __future__ import annotations

import binascii
import re
from collections.abc import Mapping
from dataclasses import dataclass

START, START_1 = 0xFD, 0xFE
"""The first byte of a frame of MAVLink 2 and of MAVLink 1."""
HEADER, HEADER_1 = 10, 6
"""The sizes of the headers of MAVLink 2 and of MAVLink 1 [bytes]."""
SIGNATURE = 13
"""The size of a signature [bytes]."""
SIGNATURE_FLAG = 1
"""The flag of a frame with a signature."""
MAX_FRAME = HEADER + 255 + 2 + SIGNATURE
"""The greatest size of a frame [bytes]."""
START_BYTES = re.compile(rb"[\xfd\xfe]")
"""The bytes that start a frame."""
REVERSED_BITS = bytes(int(f"{byte:08b}"[::-1], 2) for byte in range(256))
"""The byte whose bits are those of the index in reverse order."""


def checksum(data: bytes) -> int:
    """Return the CRC-16/MCRF4XX of ``data``: polynomial 0x1021, bits reversed, initially 0xFFFF."""
    crc = binascii.crc_hqx(data.translate(REVERSED_BITS), 0xFFFF)
    return REVERSED_BITS[crc & 0xFF] << 8 | REVERSED_BITS[crc >> 8]


def encode_frame(
    message: int, payload: bytes, *, crc_extra: int, sequence: int, system: int, component: int
) -> bytes:
    """Return the frame of MAVLink 2 of a payload.

    Args:
        message: the number of the message.
        payload: the payload, of 1 to 255 bytes.
        crc_extra: the byte of the message's definition that the checksum includes.
        sequence: the number of the frame, of which the lowest 8 bits are sent.
        system: the number of the sender's system.
        component: the number of the sender's component.
    """
    payload = payload.rstrip(b"\0") or b"\0"
    header = bytes((len(payload), 0, 0, sequence & 0xFF, system, component))
    body = header + message.to_bytes(3, "little") + payload
    return bytes((START,)) + body + checksum(body + bytes((crc_extra,))).to_bytes(2, "little")


@dataclass(frozen=True, kw_only=True)
class Frame:
    """A valid frame."""

    message: int
    """The number of the message."""
    payload: bytes
    """The payload, possibly without zeros at its end."""


@dataclass(frozen=True, kw_only=True)
class MessageFormat:
    """The part of a message's definition that a frame depends on."""

    crc_extra: int
    """The byte of the definition that the checksum includes."""
    size: int
    """The greatest size of the payload [bytes]."""


class FrameReader:
    """A reader of frames from a stream of bytes, which skips whatever is not a valid frame.

    Args:
        formats: the accepted messages, by their numbers.
    """

    def __init__(self, formats: Mapping[int, MessageFormat]) -> None:
        self._formats = dict(formats)
        self._rest = b""
        self.n_skipped = 0
        """The number of bytes that belong to no valid frame."""

    def read(self, data: bytes) -> list[Frame]:
        """Return the frames that ``data`` completes; at most 280 bytes are kept for the next call.

        A frame is also found behind what looks like the beginning of a longer one. The time is
        proportional to the number of bytes, for any bytes.
        """
        buffer, end, rest = self._rest + data, 0, None
        frames: list[Frame] = []
        position = find_start(buffer, 0)
        while position < len(buffer):
            length = self._frame_length(buffer, position)
            if length > len(buffer) - position:
                rest = position if rest is None else rest
            elif length and (frame := self._parse(buffer[position : position + length])):
                frames.append(frame)
                self.n_skipped += position - end
                end, rest = position + length, None
                position = find_start(buffer, end)
                continue
            position = find_start(buffer, position + 1)
        rest = len(buffer) if rest is None else rest
        self.n_skipped += rest - end
        self._rest = buffer[rest:]
        return frames

    def _frame_length(self, buffer: bytes, start: int) -> int:
        """Return the length of the frame that may begin at an index; 0 if none begins there."""
        head = buffer[start : start + HEADER]
        if len(head) < (HEADER if head[0] == START else HEADER_1):
            return MAX_FRAME  # more than there is
        message = self._formats.get(_message_number(head))
        if message is None or head[1] > message.size:
            return 0
        if head[0] == START_1:
            return HEADER_1 + head[1] + 2
        return HEADER + head[1] + 2 + (SIGNATURE if head[2] & SIGNATURE_FLAG else 0)

    def _parse(self, data: bytes) -> Frame | None:
        """Return the frame; None if its checksum is wrong."""
        end = (HEADER if data[0] == START else HEADER_1) + data[1]
        message = _message_number(data)
        crc_extra = self._formats[message].crc_extra
        if checksum(data[1:end] + bytes((crc_extra,))) != int.from_bytes(
            data[end : end + 2], "little"
        ):
            return None
        return Frame(message=message, payload=data[end - data[1] : end])


def find_start(buffer: bytes, position: int) -> int:
    """Return the index of the next byte that can start a frame, from a position; else the end."""
    match = START_BYTES.search(buffer, position)
    return len(buffer) if match is None else match.start()


def _message_number(head: bytes) -> int:
    return head[5] if head[0] == START_1 else int.from_bytes(head[7:10], "little")
