"""How ROS 2 names map to DDS names, as in the design article "Topic and Service name mapping"."""

from __future__ import annotations

import re

LEGAL = re.compile(r"[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*")
"""A name of ROS 2, without its leading slash."""
MAX_NAME = 240
"""Letters of such a name; DDS has 255, with what ROS 2 puts around it."""
DISCOVERY_TOPIC = "ros_discovery_info"
"""On it each participant says which nodes and endpoints it has; it has no prefix."""


def is_legal(name: str) -> bool:
    """Whether ROS 2 allows a name of a topic or service, given without its leading slash."""
    return len(name) <= MAX_NAME and LEGAL.fullmatch(name) is not None


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
