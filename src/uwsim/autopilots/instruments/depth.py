"""Sentences of depth sensors and altimeters: ISDPT of Impact Subsea, DBT and DPT.

Sources: ``$ISDPT,depth,M,pressure,B,temperature,C``: Impact Subsea, ISD4000 manual (depth [m],
absolute pressure [bar], temperature [deg C]). DBT and DPT: E. S. Raymond, "NMEA Revealed". DBT and
DPT state the distance from the transducer to the bottom, so an altimeter sends them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from .sentence import Sentence, format_number, read_sentence

FOOT = 0.3048
"""A foot [m]."""
FATHOM = 1.8288
"""A fathom [m]."""
BAR = 1e5
"""A bar [Pa]."""


@dataclass(frozen=True, kw_only=True)
class DepthReading:
    """The reading of a depth sensor."""

    depth: float = math.nan
    """The depth below the surface [m]; NaN: not known."""
    pressure: float = math.nan
    """The absolute pressure [Pa]; NaN: not known."""
    temperature: float = math.nan
    """The temperature of the water [deg C]; NaN: not known."""

    def isdpt(self) -> Sentence:
        """Return depth, pressure and temperature."""
        return Sentence(
            "ISDPT",
            (
                format_number(self.depth, 3, width=8 if self.depth < 0.0 else 7),
                "M",
                format_number(self.pressure / BAR, 4, width=8),
                "B",
                format_number(self.temperature, 2, width=5),
                "C",
            ),
        )


@dataclass(frozen=True, kw_only=True)
class BottomDistance:
    """The distance of an altimeter to the bottom."""

    distance: float = math.nan
    """The distance from the transducer to the bottom [m]; NaN: no echo."""

    def dbt(self) -> Sentence:
        """Return the distance in feet, metres and fathoms; empty fields without an echo."""
        feet, metres, fathoms = (
            format_number(self.distance / unit, 2) for unit in (FOOT, 1.0, FATHOM)
        )
        return Sentence("SDDBT", (feet, "f", metres, "M", fathoms, "F"))

    def dpt(self) -> Sentence:
        """Return the distance in metres, with an offset of the transducer of 0."""
        return Sentence("SDDPT", (format_number(self.distance, 2), "0.0"))


def read_depth(data: bytes) -> DepthReading:
    """Return the reading of an ISDPT sentence; raise BadMessage."""
    sentence = read_sentence(data, "ISDPT")
    return DepthReading(
        depth=sentence.number(0),
        pressure=sentence.number(2) * BAR,
        temperature=sentence.number(4),
    )


def read_bottom_distance(data: bytes) -> BottomDistance:
    """Return the distance of a DBT or DPT sentence of any talker; raise BadMessage."""
    sentence = read_sentence(data)
    if sentence.address.endswith("DBT"):
        return BottomDistance(distance=sentence.number(2))
    if not sentence.address.endswith("DPT") or sentence.address == "ISDPT":
        read_sentence(data, "SDDBT", "SDDPT")
    return BottomDistance(distance=sentence.number(0))
