"""Stamps on the clock of ROS, which begins at 1 s: ROS takes 0 for "no clock yet".

Inside, simulation time begins at 0. Adapters publish ``/clock`` as `CLOCK_START` later than that,
move the stamps of outgoing headers by as much, and those of incoming ones back. A stamp of 0 means
"none" on its way in, and stays.
"""

from __future__ import annotations

import copy
import functools
from typing import Any, TypeVar, cast

from ..messages import Time
from ..messages.build import NANOSECONDS, time_from_seconds
from .encodings import HEADER, inner_type
from .types import ros2_store

M = TypeVar("M")
CLOCK_START = 1
"""What ``/clock`` shows at the beginning of a simulation [s]."""


def clock_time(time: float) -> Time:
    """Return simulation time ``time`` [s] as ``/clock`` shows it."""
    shown = time_from_seconds(time)
    return Time(sec=shown.sec + CLOCK_START, nanosec=shown.nanosec)


def outward(message: M) -> M:
    """Return a message with its stamps on the clock of ROS; the message itself stays as it is."""
    return moved(message, CLOCK_START * NANOSECONDS)


def inward(message: M) -> M:
    """Return a message with its stamps in simulation time; at least 0, and 0 stays."""
    return moved(message, -CLOCK_START * NANOSECONDS)


@functools.cache
def _stamped(name: str) -> tuple[tuple[str, str, str], ...]:
    """Fields that are, or hold, headers: field, ``one`` or ``list``, inner type."""
    if name not in ros2_store().fielddefs:
        return ()
    found: list[tuple[str, str, str]] = []
    for field, description in ros2_store().fielddefs[name][1]:
        kind, inner = inner_type(description)
        if kind in ("one", "list") and (inner == HEADER or _stamped(inner)):
            found.append((field, kind, inner))
    return tuple(found)


def moved(message: M, nanoseconds: int) -> M:
    """Return a message with the stamps of its headers moved; at least 0.

    On the way back a stamp of 0 stays.
    """
    name = str(getattr(message, "__msgtype__", ""))
    if name == HEADER:
        return cast(M, _header_moved(message, nanoseconds))
    fields = _stamped(name)
    if not fields:
        return message
    copied = copy.copy(message)
    for field, kind, _ in fields:
        value: Any = getattr(message, field)
        new = (
            moved(value, nanoseconds)
            if kind == "one"
            else [moved(each, nanoseconds) for each in value]
        )
        object.__setattr__(copied, field, new)  # of a frozen one, too
    return copied


def _header_moved(header: Any, nanoseconds: int) -> Any:
    stamp = header.stamp
    before = stamp.sec * NANOSECONDS + stamp.nanosec
    if nanoseconds < 0 and before == 0:
        return header
    after = max(0, before + nanoseconds)
    copied = copy.copy(header)
    copied.stamp = Time(sec=after // NANOSECONDS, nanosec=after % NANOSECONDS)
    return copied
