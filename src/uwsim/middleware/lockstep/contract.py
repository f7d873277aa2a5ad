"""Checks of the fields of a client's messages on the topics of lock-step."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any

from ...bus import Bus
from ...errors import UwsimError
from ..types import message_class, service, wire_type

MAX_NAMES = 1000
"""The maximum number of topics and services in one field."""
Content = dict[str, Any]
"""The JSON object in a join or an answer."""


def join_error(content: Content, bus: Bus) -> str | None:
    """Return the error in the first invalid field of a join; None if all are valid."""
    return (
        _first_error(content, JOIN_FIELDS, required_name="topics")
        or _topic_error(object_in(content, "publishes"), bus)
        or _service_error(object_in(content, "services"), bus)
    )


def answer_error(content: Content) -> str | None:
    """Return the error in the first invalid field of an answer to a tick; None if all are valid."""
    return _first_error(content, ANSWER_FIELDS, required_name="tick")


def reply_error(content: Content) -> str | None:
    """Return the error in the first invalid field of an answer to a call; None if all are valid."""
    return _first_error(content, REPLY_FIELDS, required_name="call")


def object_in(content: Content, field: str) -> dict[str, Any]:
    """Return the object in a field; empty if the field is missing."""
    return content.get(field) or {}


def names_in(content: Content, field: str) -> list[str]:
    """Return the list of names in a field, each once; empty if the field is missing."""
    return list(dict.fromkeys(content.get(field) or ()))


def _first_error(content: Content, fields: Mapping[str, Rule], required_name: str) -> str | None:
    for field, (is_valid, expected) in fields.items():
        value = content.get(field)
        if value is None and field != required_name:
            continue
        if not is_valid(value):
            excerpt = _excerpt(value) if field in content else "missing"
            return f"{field} is {excerpt}; expected {expected}"
    return None


def _topic_error(published_types: Mapping[str, str], bus: Bus) -> str | None:
    """Describe the first topic whose type does not exist, or differs from that on the bus."""
    for topic, kind in published_types.items():
        try:
            cls = message_class(kind)
        except UwsimError as error:
            return f"publishes, {_excerpt(topic)}: {error}"
        bus_type = bus.message_type(topic)
        if bus_type is not None and bus_type is not cls:
            wire = wire_type(bus_type)
            type_name = wire.ros2_name if wire is not None else bus_type.__name__
            return f"publishes, {_excerpt(topic)} is {_excerpt(kind)}; expected {type_name}"
    return None


def _service_error(services: Mapping[str, str], bus: Bus) -> str | None:
    """Describe the first service whose type does not exist, or that is offered already."""
    for name, kind in services.items():
        try:
            service(kind)
        except UwsimError as error:
            return f"services, {_excerpt(name)}: {error}"
        if bus.services.is_offered(name):
            return f"services, {_excerpt(name)} is offered already; expected another"
    return None


def _is_time(value: object) -> bool:
    return not isinstance(value, bool) and isinstance(value, int | float) and value >= 0.0


def _is_count(value: object) -> bool:
    return not isinstance(value, bool) and isinstance(value, int) and value >= 0


def _is_name(value: object) -> bool:
    return isinstance(value, str) and bool(value.strip("/ "))


def _are_names(value: object) -> bool:
    return isinstance(value, list) and len(value) <= MAX_NAMES and all(map(_is_name, value))


def _is_map_of(value: object, is_valid: Callable[[object], bool]) -> bool:
    """Return whether a value is an object whose names and values are valid."""
    if not isinstance(value, dict) or len(value) > MAX_NAMES:
        return False
    return all(_is_name(name) and is_valid(element) for name, element in value.items())


def _excerpt(value: object) -> str:
    text = json.dumps(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


Rule = tuple[Callable[[object], bool], str]
"""A function that checks a value, and the text of what is expected."""
TIME_RULE: Rule = (_is_time, "a time >= 0 [s], or null for none")
NAMES_RULE: Rule = (_are_names, f"a list of at most {MAX_NAMES} names")
TYPES_RULE: Rule = (
    lambda value: _is_map_of(value, _is_name),
    "an object with a type for each name",
)
COUNTS_RULE: Rule = (
    lambda value: _is_map_of(value, _is_count),
    "an object with a whole number >= 0 for each topic",
)
ID_RULE: Rule = (_is_name, "a text")
JOIN_FIELDS = {
    "id": ID_RULE,
    "secret": ID_RULE,
    "topics": NAMES_RULE,
    "next": TIME_RULE,
    "own": NAMES_RULE,
    "publishes": TYPES_RULE,
    "services": TYPES_RULE,
}
"""The rules for the fields of a join."""
ANSWER_FIELDS: Mapping[str, Rule] = {
    "tick": (_is_count, "the whole number of the tick"),
    "next": TIME_RULE,
    "published": COUNTS_RULE,
    "calls": NAMES_RULE,
}
"""The rules for the fields of an answer to a tick."""
REPLY_FIELDS: Mapping[str, Rule] = {
    "call": (_is_count, "the whole number of the call"),
    "values": (lambda value: isinstance(value, dict), "an object"),
    "published": COUNTS_RULE,
    "calls": NAMES_RULE,
}
"""The rules for the fields of an answer to a call."""
