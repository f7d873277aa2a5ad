"""What a client may say on the topics of lock-step; each field that is another is refused."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any

from ...bus import Bus
from ...errors import UwsimError
from ..types import message_class, service, wire_type

MAX_NAMES = 1000
"""Topics and services that one client may name in a field."""
Said = dict[str, Any]
"""The JSON object of a join or an answer."""


def wrong_in_join(said: Said, bus: Bus) -> str | None:
    """Return the first field of a join that is not as it should be, and what was expected."""
    return (
        _first_wrong(said, JOIN_FIELDS, needed="topics")
        or _wrong_topic(given(said, "publishes"), bus)
        or _wrong_service(given(said, "services"), bus)
    )


def wrong_in_answer(said: Said) -> str | None:
    """Return the first field of an answer to a tick that is not as it should be."""
    return _first_wrong(said, ANSWER_FIELDS, needed="tick")


def wrong_in_reply(said: Said) -> str | None:
    """Return the first field of an answer to a call that is not as it should be."""
    return _first_wrong(said, REPLY_FIELDS, needed="call")


def given(said: Said, field: str) -> dict[str, Any]:
    """Return an object that may be left out."""
    return said.get(field) or {}


def names(said: Said, field: str) -> list[str]:
    """Return a list of names that may be left out, each once."""
    return list(dict.fromkeys(said.get(field) or ()))


def _first_wrong(said: Said, fields: Mapping[str, Field], needed: str) -> str | None:
    for field, (is_right, expected) in fields.items():
        value = said.get(field)
        if value is None and field != needed:
            continue
        if not is_right(value):
            shown = _shown(value) if field in said else "missing"
            return f"{field} is {shown}; expected {expected}"
    return None


def _wrong_topic(publishes: Mapping[str, str], bus: Bus) -> str | None:
    """Say which topic has a type that does not exist, or another one on the bus."""
    for topic, kind in publishes.items():
        try:
            cls = message_class(kind)
        except UwsimError as error:
            return f"publishes, {_shown(topic)}: {error}"
        known = bus.message_type(topic)
        if known is not None and known is not cls:
            wire = wire_type(known)
            carried = wire.ros2_name if wire is not None else known.__name__
            return f"publishes, {_shown(topic)} is {_shown(kind)}; expected {carried}"
    return None


def _wrong_service(services: Mapping[str, str], bus: Bus) -> str | None:
    """Say which service has a type that does not exist, or is offered already."""
    for name, kind in services.items():
        try:
            service(kind)
        except UwsimError as error:
            return f"services, {_shown(name)}: {error}"
        if bus.services.serves(name):
            return f"services, {_shown(name)} is offered already; expected another"
    return None


def _is_time(value: object) -> bool:
    return not isinstance(value, bool) and isinstance(value, int | float) and value >= 0.0


def _is_count(value: object) -> bool:
    return not isinstance(value, bool) and isinstance(value, int) and value >= 0


def _is_name(value: object) -> bool:
    return isinstance(value, str) and bool(value.strip("/ "))


def _are_names(value: object) -> bool:
    return isinstance(value, list) and len(value) <= MAX_NAMES and all(map(_is_name, value))


def _of_names(value: object, is_right: Callable[[object], bool]) -> bool:
    """Whether it is an object whose values are right."""
    if not isinstance(value, dict) or len(value) > MAX_NAMES:
        return False
    return all(_is_name(name) and is_right(each) for name, each in value.items())


def _shown(value: object) -> str:
    text = json.dumps(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


Field = tuple[Callable[[object], bool], str]
"""Whether a value is right, and what is expected."""
TIME: Field = (_is_time, "a time >= 0 [s], or null for none")
NAMES: Field = (_are_names, f"a list of at most {MAX_NAMES} names")
TYPES: Field = (lambda value: _of_names(value, _is_name), "an object with a type for each name")
COUNTS: Field = (
    lambda value: _of_names(value, _is_count),
    "an object with a whole number >= 0 for each topic",
)
ID: Field = (_is_name, "a text")
JOIN_FIELDS = {
    "id": ID,
    "secret": ID,
    "topics": NAMES,
    "next": TIME,
    "own": NAMES,
    "publishes": TYPES,
    "services": TYPES,
}
ANSWER_FIELDS: Mapping[str, Field] = {
    "tick": (_is_count, "the whole number of the tick"),
    "next": TIME,
    "published": COUNTS,
    "calls": NAMES,
}
REPLY_FIELDS: Mapping[str, Field] = {
    "call": (_is_count, "the whole number of the call"),
    "values": (lambda value: isinstance(value, dict), "an object"),
    "published": COUNTS,
    "calls": NAMES,
}
