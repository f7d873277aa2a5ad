"""How ROS 2 names map to DDS names, as in the design article "Topic and Service name mapping"."""

from __future__ import annotations

DISCOVERY_TOPIC = "ros_discovery_info"
"""On it each participant says which nodes and endpoints it has; it has no prefix."""


def topic_name(topic: str) -> str:
    """``/a/b`` -> ``rt/a/b``; the leading slash may be missing."""
    return f"rt/{topic.lstrip('/')}"


def request_name(service: str) -> str:
    """``/a/b`` -> ``rq/a/bRequest``."""
    return f"rq/{service.lstrip('/')}Request"


def reply_name(service: str) -> str:
    """``/a/b`` -> ``rr/a/bReply``."""
    return f"rr/{service.lstrip('/')}Reply"


def type_name(ros_type: str) -> str:
    """``pkg/msg/Name`` -> ``pkg::msg::dds_::Name_``."""
    package, kind, name = ros_type.split("/")
    return f"{package}::{kind}::dds_::{name}_"


def type_hash_data(type_hash: str) -> bytes:
    """Return the USER_DATA of an endpoint that tells the hash of its type (REP 2016)."""
    return f"typehash={type_hash};".encode()
