"""The mapping of ROS 2 names to DDS names, as in the article "Topic and Service name mapping"."""

from __future__ import annotations

import re

LEGAL_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*")
"""The pattern of a name of ROS 2, without its leading slash."""
MAX_NAME_LENGTH = 240
"""The maximum length of a name [characters]: DDS allows 255, including the prefix of ROS 2."""
DISCOVERY_TOPIC = "ros_discovery_info"
"""The topic on which each participant announces its nodes and endpoints; it has no prefix."""


def is_legal(name: str) -> bool:
    """Return whether ROS 2 allows a name of a topic or service, given without its leading slash."""
    return len(name) <= MAX_NAME_LENGTH and LEGAL_NAME.fullmatch(name) is not None


def topic_name(topic: str) -> str:
    """Return ``rt/a/b`` for ``/a/b``; the leading slash may be missing."""
    return f"rt/{topic.lstrip('/')}"


def request_name(service: str) -> str:
    """Return ``rq/a/bRequest`` for ``/a/b``."""
    return f"rq/{service.lstrip('/')}Request"


def reply_name(service: str) -> str:
    """Return ``rr/a/bReply`` for ``/a/b``."""
    return f"rr/{service.lstrip('/')}Reply"


def type_name(ros_type: str) -> str:
    """Return ``pkg::msg::dds_::Name_`` for ``pkg/msg/Name``."""
    package, kind, name = ros_type.split("/")
    return f"{package}::{kind}::dds_::{name}_"


def type_hash_data(type_hash: str) -> bytes:
    """Return the USER_DATA of an endpoint with the hash of its type (REP 2016)."""
    return f"typehash={type_hash};".encode()
