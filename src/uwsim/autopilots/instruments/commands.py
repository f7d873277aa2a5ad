"""Commands to thrusters: two sentences and a binary message, which are formats of uwsim itself.

.. code-block:: text

    $PUWTC,time,c1,...,cn*hh      commands from -1 to 1
    $PUWTP,time,p1,...,pn*hh      pulse widths [us]: 1100 is -1, 1500 is 0, 1900 is 1

The time is that of the measurement that the command answers, as hhmmss.sss of its sentence; it may
be empty. With it a strict clock measures the delay from a measurement to its effect.

======  ========  =========================================================
byte    type      field of the binary message, little-endian
======  ========  =========================================================
1       2 bytes   ``UW``
3       uint8     1: commands from -1 to 1; 2: pulse widths [us]
4       uint8     n, the number of thrusters
5       uint32    a number that the sender increments
9       float64   time of the measurement that is answered [s since 1970], or NaN
17      float32   n values
17+4n   uint16    CRC-16 of all bytes before (`uwsim.autopilots.instruments.checksums.crc16`)
======  ========  =========================================================
"""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass

from ...errors import BadMessage
from .checksums import crc16
from .sentence import Sentence, format_number, read_sentence
from .utc import format_time_of_day, nearest_time, parse_time_of_day

MAX_THRUSTERS = 32
"""The greatest number of thrusters in a command."""
NEUTRAL_WIDTH, HALF_RANGE = 1500.0, 400.0
"""The pulse width of no thrust, and its difference to that of full thrust [us]."""
SYNC = b"UW"
"""The first bytes of a binary message."""
HEAD = struct.Struct("<2sBBId")
"""The fields of a binary message before its values."""
COMMANDS, PULSE_WIDTHS = 1, 2
"""The kinds of values in a binary message."""


@dataclass(frozen=True, kw_only=True)
class ThrusterCommands:
    """The commands of all thrusters of a vehicle."""

    values: tuple[float, ...]
    """The command of each thruster, from -1 to 1."""
    time_us: int | None = None
    """The time of the measurement that is answered [us since 1970]; None: not known."""
    sequence: int = 0
    """A number that the sender increments."""

    def to_sentence(self) -> Sentence:
        """Return the sentence PUWTC."""
        time = "" if self.time_us is None else format_time_of_day(self.time_us)
        return Sentence("PUWTC", (time, *(format_number(value, 4) for value in self.values)))

    def to_pulse_widths(self) -> Sentence:
        """Return the sentence PUWTP."""
        time = "" if self.time_us is None else format_time_of_day(self.time_us)
        widths = (round(NEUTRAL_WIDTH + HALF_RANGE * value) for value in self.values)
        return Sentence("PUWTP", (time, *map(str, widths)))

    def to_binary(self) -> bytes:
        """Return the binary message."""
        time = math.nan if self.time_us is None else self.time_us / 1e6
        n = len(self.values)
        head = HEAD.pack(SYNC, COMMANDS, n, self.sequence & 0xFFFFFFFF, time)
        body = head + struct.pack(f"<{n}f", *self.values)
        return body + struct.pack("<H", crc16(body))


def read_command_sentence(data: bytes, now_us: int) -> ThrusterCommands:
    """Return the commands of a sentence PUWTC or PUWTP.

    Args:
        data: the sentence.
        now_us: the present time [us since 1970]; the time of day in the sentence is near it.

    Raises:
        BadMessage: the sentence is invalid.
    """
    sentence = read_sentence(data, "PUWTC", "PUWTP")
    time = sentence.text(0)
    time_us = nearest_time(parse_time_of_day(time, sentence.address), now_us) if time else None
    numbers = [sentence.number(i) for i in range(1, len(sentence.fields))]
    return ThrusterCommands(
        values=_check_values(numbers, is_width=sentence.address == "PUWTP"), time_us=time_us
    )


def read_binary_commands(data: bytes) -> ThrusterCommands:
    """Return the commands of a binary message; raise BadMessage."""
    if len(data) < HEAD.size + 2 or len(data) != binary_length(data):
        raise BadMessage(f"A binary command has {len(data)} bytes, which is not its length.")
    sync, kind, n, sequence, time = HEAD.unpack_from(data)
    if sync != SYNC or kind not in (COMMANDS, PULSE_WIDTHS):
        raise BadMessage(f"A binary command begins with {data[:3]!r}; expected UW and 1 or 2.")
    if not has_checksum(data):
        raise BadMessage(
            f"A binary command has a wrong checksum; expected {crc16(data[:-2]):#06x}."
        )
    numbers = [*struct.unpack_from(f"<{n}f", data, HEAD.size)]
    return ThrusterCommands(
        values=_check_values(numbers, is_width=kind == PULSE_WIDTHS),
        time_us=round(1e6 * time) if abs(time) < 1e12 else None,
        sequence=sequence,
    )


def binary_length(data: bytes) -> int:
    """Return the length of the binary message that begins with 4 bytes or more [bytes]."""
    return HEAD.size + 4 * data[3] + 2


def has_checksum(data: bytes) -> bool:
    """Return whether a binary message ends with the checksum of its other bytes."""
    return data[-2:] == struct.pack("<H", crc16(data[:-2]))


def _check_values(numbers: list[float], *, is_width: bool) -> tuple[float, ...]:
    """Return commands from -1 to 1, clamped; raise BadMessage if there are none or too many."""
    if not 1 <= len(numbers) <= MAX_THRUSTERS or not all(map(math.isfinite, numbers)):
        raise BadMessage(
            f"A command has {len(numbers)} values; expected 1 to {MAX_THRUSTERS} numbers."
        )
    if is_width:
        numbers = [(number - NEUTRAL_WIDTH) / HALF_RANGE for number in numbers]
    return tuple(min(max(number, -1.0), 1.0) for number in numbers)
