"""Conversion of stamps between simulation time and the time on ``/clock``.

In the simulator, time begins at 0; on ``/clock`` it begins at `CLOCK_START`, because ROS interprets
0 as "no clock yet". Adapters therefore add this offset to the stamps of outgoing headers, and
subtract it from the stamps of incoming headers. An incoming stamp of 0 means "no stamp" and is not
changed.
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
"""The time on ``/clock`` at the beginning of a simulation [s]."""


def clock_time(time: float) -> Time:
    """Return simulation time ``time`` [s] as a stamp of ``/clock``."""
    stamp = time_from_seconds(time)
    return Time(sec=stamp.sec + CLOCK_START, nanosec=stamp.nanosec)


def to_ros_time(message: M) -> M:
    """Return a copy of a message with its stamps in the time of ``/clock``."""
    return shift_stamps(message, CLOCK_START * NANOSECONDS)


def to_sim_time(message: M) -> M:
    """Return a copy of a message with its stamps in simulation time, at least 0; 0 stays 0."""
    return shift_stamps(message, -CLOCK_START * NANOSECONDS)


@functools.cache
def _stamped_fields(name: str) -> tuple[tuple[str, str, str], ...]:
    """Return the fields that are or contain headers: name, form (`inner_type`) and inner type."""
    if name not in ros2_store().fielddefs:
        return ()
    fields: list[tuple[str, str, str]] = []
    for field, description in ros2_store().fielddefs[name][1]:
        kind, type_name = inner_type(description)
        if kind in ("one", "list") and (type_name == HEADER or _stamped_fields(type_name)):
            fields.append((field, kind, type_name))
    return tuple(fields)


def shift_stamps(message: M, nanoseconds: int) -> M:
    """Return a copy of a message with the stamps of its headers shifted, to at least 0.

    If ``nanoseconds`` is negative, a stamp of 0 is not changed.
    """
    name = str(getattr(message, "__msgtype__", ""))
    if name == HEADER:
        return cast(M, _shift_header(message, nanoseconds))
    fields = _stamped_fields(name)
    if not fields:
        return message
    message_copy = copy.copy(message)
    for field, kind, _ in fields:
        value: Any = getattr(message, field)
        shifted_value = (
            shift_stamps(value, nanoseconds)
            if kind == "one"
            else [shift_stamps(element, nanoseconds) for element in value]
        )
        object.__setattr__(message_copy, field, shifted_value)  # the message may be frozen
    return message_copy


def _shift_header(header: Any, nanoseconds: int) -> Any:
    stamp = header.stamp
    old_stamp = stamp.sec * NANOSECONDS + stamp.nanosec
    if nanoseconds < 0 and old_stamp == 0:
        return header
    new_stamp = max(0, old_stamp + nanoseconds)
    header_copy = copy.copy(header)
    header_copy.stamp = Time(sec=new_stamp // NANOSECONDS, nanosec=new_stamp % NANOSECONDS)
    return header_copy
