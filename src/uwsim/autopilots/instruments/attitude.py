"""Sentences of attitude: HDT, PRDID of Teledyne RDI, and PASHR.

Sources: HDT: E. S. Raymond, "NMEA Revealed". ``$PRDID,pitch,roll,heading``: Teledyne RD
Instruments, PD6 and ADCP input sentences. ``$PASHR,time,heading,T,roll,pitch,heave,...``: Oxford
Technical Solutions, NMEA 0183 description. Pitch is positive with the bow up, roll with the port
side up, heading is clockwise from true north [deg].
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from .sentence import Sentence, format_number, read_sentence
from .utc import format_time_of_day


@dataclass(frozen=True, kw_only=True)
class Attitude:
    """The attitude of a vehicle, forward-right-down axes in north-east-down."""

    time_us: int = 0
    """The time [us since 1970]."""
    roll: float = math.nan
    """The roll angle [deg]; NaN: not known."""
    pitch: float = math.nan
    """The pitch angle [deg]; NaN: not known."""
    heading: float = math.nan
    """The heading, 0 to 360 [deg]; NaN: not known."""

    def hdt(self) -> Sentence:
        """Return the true heading."""
        return Sentence("HEHDT", (_format_heading(self.heading, 3), "T"))

    def prdid(self) -> Sentence:
        """Return pitch, roll and heading."""
        roll, pitch = format_number(self.roll, 2), format_number(self.pitch, 2)
        return Sentence("PRDID", (pitch, roll, _format_heading(self.heading, 2)))

    def pashr(self) -> Sentence:
        """Return heading, roll and pitch; accuracies are not known, heave is not measured."""
        roll = format_number(self.roll, 2, width=6, is_signed=True)
        pitch = format_number(self.pitch, 2, width=6, is_signed=True)
        head = (format_time_of_day(self.time_us), _format_heading(self.heading, 2), "T")
        return Sentence("PASHR", (*head, roll, pitch, "", "", "", "", "1", "1"))


def _format_heading(heading: float, digits: int) -> str:
    """Return a heading from 0 up to 360, which itself is 0."""
    return format_number(round(heading, digits) % 360.0, digits) if heading == heading else ""


def read_attitude(data: bytes) -> Attitude:
    """Return the attitude of a HDT, PRDID or PASHR sentence; raise BadMessage."""
    sentence = read_sentence(data)
    if sentence.address.endswith("HDT"):
        return Attitude(heading=sentence.number(0))
    sentence = read_sentence(data, "PRDID", "PASHR")
    if sentence.address == "PRDID":
        pitch, roll, heading = (sentence.number(i) for i in range(3))
        return Attitude(roll=roll, pitch=pitch, heading=heading)
    return Attitude(heading=sentence.number(1), roll=sentence.number(3), pitch=sentence.number(4))
