"""Names of topics, services and message classes, as the bus compares and reports them."""

from __future__ import annotations


def has_exact_type(message: object, expected: type) -> bool:
    """Return whether a message is of exactly the expected class, not of a derived class."""
    return type(message) is expected


def strip_slash(name: str) -> str:
    """Return a name without surrounding spaces and leading slash, as names are compared."""
    return name.strip().lstrip("/")


def type_name(type: type | None) -> str:
    """Return the name of a message class, ``std_msgs/msg/Bool``."""
    return str(getattr(type, "__msgtype__", getattr(type, "__name__", "nothing yet")))
