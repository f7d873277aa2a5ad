"""Times in messages: microseconds since 1970-01-01, without leap seconds, and their texts."""

from __future__ import annotations

import math
from datetime import UTC, datetime, timedelta

from ...errors import BadMessage

DAY_US = 86_400_000_000
"""The length of a day [us]."""
_ORIGIN = datetime(1970, 1, 1, tzinfo=UTC)


def parse_epoch(text: str) -> int:
    """Return the microseconds since 1970 of a date and time as in ISO 8601; raise BadMessage.

    A time without a zone is UTC.
    """
    try:
        moment = datetime.fromisoformat(text.strip())
    except ValueError:
        raise BadMessage(
            f"{text[:40]!r} is no time; expected one such as 2026-01-01T00:00:00Z."
        ) from None
    if moment.tzinfo is None:
        moment = moment.replace(tzinfo=UTC)
    if not 1980 <= moment.year <= 2079:
        raise BadMessage(f"{text[:40]!r} is in {moment.year}; expected 1980 to 2079.")
    return (moment - _ORIGIN) // timedelta(microseconds=1)


def to_datetime(time_us: int) -> datetime:
    """Return the date and time of ``time_us`` [us since 1970]."""
    return _ORIGIN + timedelta(microseconds=time_us)


def format_time_of_day(time_us: int, digits: int = 3) -> str:
    """Return the time of day as hhmmss.sss, cut off after 1 to 6 decimal digits."""
    moment = to_datetime(time_us)
    fraction = f"{moment.microsecond:06d}"[:digits]
    return f"{moment:%H%M%S}.{fraction}"


def parse_time_of_day(text: str, name: str) -> int:
    """Return the microseconds since midnight of hhmmss.sss; raise BadMessage."""
    digits, _, fraction = text.partition(".")
    is_valid = len(digits) == 6 and (digits + fraction).isdigit() and text.isascii()
    if not is_valid or len(fraction) > 9:
        raise BadMessage(f"{name} has the time {text[:20]!r}; expected hhmmss.sss.")
    hours, minutes, seconds = int(digits[:2]), int(digits[2:4]), int(digits[4:])
    if hours > 23 or minutes > 59 or seconds > 60:
        raise BadMessage(f"{name} has the time {text[:20]!r}; expected a time of day.")
    return (hours * 3600 + minutes * 60 + seconds) * 1_000_000 + int(fraction[:6].ljust(6, "0"))


def nearest_time(time_of_day_us: int, now_us: int) -> int:
    """Return the time nearest to ``now_us`` [us since 1970] that has a time of day [us]."""
    midnight = now_us - now_us % DAY_US
    days = math.floor((now_us - midnight - time_of_day_us) / DAY_US + 0.5)
    return midnight + time_of_day_us + days * DAY_US
