"""Names of topics, services and message classes, as the bus compares and reports them."""

from __future__ import annotations


def is_exactly(message: object, expected: type) -> bool:
    """Whether the class of a message is exactly this one, not a derived one."""
    return type(message) is expected


def without_slash(name: str) -> str:
    """Return a name as it is compared: without a leading slash."""
    return name.strip().lstrip("/")


def type_name(type: type | None) -> str:
    """Return the name of a message class, ``std_msgs/msg/Bool``."""
    return str(getattr(type, "__msgtype__", getattr(type, "__name__", "nothing yet")))
