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
from ..messages.build import time_from_seconds
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
    return _moved(message, CLOCK_START)


def inward(message: M) -> M:
    """Return a message with its stamps in simulation time; at least 0, and 0 stays."""
    return _moved(message, -CLOCK_START)


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


def _moved(message: M, seconds: int) -> M:
    name = str(getattr(message, "__msgtype__", ""))
    if name == HEADER:
        return cast(M, _header_moved(message, seconds))
    fields = _stamped(name)
    if not fields:
        return message
    moved = copy.copy(message)
    for field, kind, _ in fields:
        value: Any = getattr(message, field)
        new = _moved(value, seconds) if kind == "one" else [_moved(x, seconds) for x in value]
        object.__setattr__(moved, field, new)  # of a frozen one, too
    return moved


def _header_moved(header: Any, seconds: int) -> Any:
    stamp = header.stamp
    if seconds < 0 and stamp.sec == 0 and stamp.nanosec == 0:
        return header
    sec = stamp.sec + seconds
    moved = copy.copy(header)
    moved.stamp = Time(sec=sec, nanosec=stamp.nanosec) if sec >= 0 else Time()
    return moved
