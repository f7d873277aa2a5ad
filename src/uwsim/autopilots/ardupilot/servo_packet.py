"""The packet with servo outputs that ArduPilot's software in the loop sends in each frame.

All numbers are little-endian. The source is ArduPilot's documentation of its JSON interface.

======  ========  ============  ==========================================================
offset  type      field         meaning
======  ========  ============  ==========================================================
0       uint16    magic         18458 with 16 channels, 29569 with 32
2       uint16    frame_rate    the rate of frames that ArduPilot would like [Hz]
4       uint32    frame_count   the number of the frame; equal numbers are the same frame
8       uint16    pwm           the pulse width of each channel, 16 or 32 numbers [us]
======  ========  ============  ==========================================================
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

PACKET_16, PACKET_32 = struct.Struct("<HHI16H"), struct.Struct("<HHI32H")
MAGIC_16, MAGIC_32 = 18458, 29569
N_COUNTS = 1 << 32
"""The number of frame counts, after which they begin again."""


@dataclass(frozen=True, slots=True)
class ServoPacket:
    """A packet with servo outputs."""

    frame_rate: int
    """The rate of frames that ArduPilot would like [Hz]."""
    frame_count: int
    """The number of the frame."""
    pwm: tuple[int, ...]
    """The pulse width of each channel, 16 or 32 [us]; 0: no signal."""

    def frames_since(self, frame_count: int) -> int:
        """Return the number of frames since another; negative if this one is older."""
        difference = (self.frame_count - frame_count) % N_COUNTS
        return difference if difference < N_COUNTS // 2 else difference - N_COUNTS


def read_servo_packet(data: bytes) -> ServoPacket | None:
    """Return the packet of a datagram; None if the size or the magic is wrong."""
    if len(data) == PACKET_16.size:
        magic, frame_rate, frame_count, *pwm = PACKET_16.unpack(data)
        is_valid = magic == MAGIC_16
    elif len(data) == PACKET_32.size:
        magic, frame_rate, frame_count, *pwm = PACKET_32.unpack(data)
        is_valid = magic == MAGIC_32
    else:
        return None
    return ServoPacket(frame_rate, frame_count, tuple(pwm)) if is_valid else None
