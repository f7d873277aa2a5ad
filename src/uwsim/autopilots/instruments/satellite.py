"""Sentences of satellite receivers: GGA, RMC, VTG, GSA and ZDA.

Fields: E. S. Raymond, "NMEA Revealed". A receiver without a fix leaves positions empty and has the
quality 0 (GGA), the status V (RMC), the mode N (VTG) and the fix 1 (GSA). The number of satellites
and the dilution of precision are constants: their geometry is not modelled.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Self

from ...errors import BadMessage
from .sentence import Sentence, format_number, read_sentence
from .utc import format_time_of_day, parse_time_of_day, to_datetime

KNOT = 1852.0 / 3600.0
"""A knot [m/s]."""
N_SATELLITES = 10
"""The number of satellites that receivers report."""
DILUTION = 0.9
"""The horizontal dilution of precision that receivers report [1]."""
MINUTE_DIGITS = 6
"""The number of decimal digits of a minute of arc: a resolution of 2 mm."""


@dataclass(frozen=True, kw_only=True)
class Fix:
    """The position and the velocity over ground of a satellite receiver."""

    time_us: int
    """The time [us since 1970]."""
    latitude: float = math.nan
    """The latitude, positive in the north [deg]; NaN: no fix."""
    longitude: float = math.nan
    """The longitude, positive in the east [deg]; NaN: no fix."""
    altitude: float = math.nan
    """The altitude above the ellipsoid [m]."""
    speed: float = math.nan
    """The speed over ground [m/s]; NaN: not known."""
    course: float = math.nan
    """The course over ground, clockwise from north [deg]; NaN: not known."""

    @property
    def is_valid(self) -> bool:
        """True if there is a fix."""
        return math.isfinite(self.latitude) and math.isfinite(self.longitude)

    def gga(self) -> Sentence:
        """Return the position; the altitude counts from the ellipsoid, the geoid's height is 0."""
        altitude = format_number(self.altitude, 3) if self.is_valid else ""
        satellites = f"{N_SATELLITES:02d}" if self.is_valid else "00"
        fields = (format_time_of_day(self.time_us), *self._position(), str(int(self.is_valid)))
        tail = (satellites, format_number(DILUTION, 1), altitude, "M", "0.0", "M", "", "")
        return Sentence("GPGGA", (*fields, *tail))

    def rmc(self) -> Sentence:
        """Return the recommended minimum: position, speed, course and date."""
        moment = to_datetime(self.time_us)
        return Sentence(
            "GPRMC",
            (
                format_time_of_day(self.time_us),
                "A" if self.is_valid else "V",
                *self._position(),
                format_number(self.speed / KNOT, 3),
                format_number(self.course, 2),
                f"{moment:%d%m%y}",
                "",
                "",
                "A" if self.is_valid else "N",
            ),
        )

    def vtg(self) -> Sentence:
        """Return course and speed over ground."""
        course = format_number(self.course, 2)
        knots, kilometres = (format_number(self.speed / unit, 3) for unit in (KNOT, 1 / 3.6))
        mode = "A" if self.is_valid else "N"
        return Sentence("GPVTG", (course, "T", "", "M", knots, "N", kilometres, "K", mode))

    def gsa(self) -> Sentence:
        """Return the kind of fix and the dilution of precision, with satellites from 1 on."""
        n = N_SATELLITES if self.is_valid else 0
        satellites = [f"{i + 1:02d}" if i < n else "" for i in range(12)]
        dilution = format_number(DILUTION, 1)
        fix = "3" if self.is_valid else "1"
        return Sentence("GPGSA", ("A", fix, *satellites, dilution, dilution, dilution))

    def zda(self) -> Sentence:
        """Return date and time."""
        moment = to_datetime(self.time_us)
        date = (f"{moment:%d}", f"{moment:%m}", f"{moment:%Y}")
        return Sentence("GPZDA", (format_time_of_day(self.time_us), *date, "00", "00"))

    def _position(self) -> tuple[str, str, str, str]:
        if not self.is_valid:
            return ("", "", "", "")
        north, east = self.latitude >= 0.0, self.longitude >= 0.0
        return (
            _format_angle(abs(self.latitude), 2),
            "N" if north else "S",
            _format_angle(abs(self.longitude), 3),
            "E" if east else "W",
        )


def _format_angle(degrees: float, width: int) -> str:
    """Return ddmm.mmmmmm of an angle >= 0."""
    scale = 10**MINUTE_DIGITS
    total = round(degrees * 60 * scale)
    degree_part, part = divmod(total, 60 * scale)
    minutes, fraction = divmod(part, scale)
    return f"{degree_part:0{width}d}{minutes:02d}.{fraction:0{MINUTE_DIGITS}d}"


@dataclass(frozen=True, kw_only=True)
class Position:
    """The position of a GGA or RMC sentence."""

    time_of_day_us: int
    """The time of day [us]."""
    is_valid: bool
    """True if there is a fix."""
    latitude: float
    """The latitude [deg]; NaN without a fix."""
    longitude: float
    """The longitude [deg]; NaN without a fix."""
    altitude: float = math.nan
    """The altitude [m]; NaN if it is not in the sentence."""
    speed: float = math.nan
    """The speed over ground [m/s]; NaN if it is not in the sentence."""
    course: float = math.nan
    """The course over ground [deg]; NaN if it is not in the sentence."""

    @classmethod
    def from_bytes(cls, data: bytes) -> Self:
        """Return the position of a GGA or RMC sentence of any talker; raise BadMessage."""
        sentence = read_sentence(data)
        kind = sentence.address[-3:]
        if kind not in ("GGA", "RMC"):
            raise BadMessage(f"${sentence.address[:10]} is unexpected; expected GGA or RMC.")
        first = 1 if kind == "GGA" else 2
        latitude = _parse_angle(sentence, first, "NS", 2)
        longitude = _parse_angle(sentence, first + 2, "EW", 3)
        has_fix = sentence.text(5) not in ("", "0") if kind == "GGA" else sentence.text(1) == "A"
        return cls(
            time_of_day_us=parse_time_of_day(sentence.text(0), sentence.address),
            is_valid=has_fix and math.isfinite(latitude) and math.isfinite(longitude),
            latitude=latitude,
            longitude=longitude,
            altitude=sentence.number(8) if kind == "GGA" else math.nan,
            speed=sentence.number(6) * KNOT if kind == "RMC" else math.nan,
            course=sentence.number(7) if kind == "RMC" else math.nan,
        )


def _parse_angle(sentence: Sentence, index: int, letters: str, width: int) -> float:
    text, letter = sentence.text(index), sentence.text(index + 1)
    if not text:
        return math.nan
    minutes = sentence.number(index)
    degree_part = math.floor(minutes / 100.0)
    minutes -= 100.0 * degree_part
    if (
        letter not in tuple(letters)
        or not 0 <= degree_part <= (90, 180)[width - 2]
        or minutes >= 60.0
    ):
        raise BadMessage(f"${sentence.address} has the angle {text[:20]!r} {letter[:4]!r}.")
    angle = degree_part + minutes / 60.0
    return angle if letter == letters[0] else -angle
