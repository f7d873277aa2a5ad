"""Addresses of masters, nodes and services: ``http://HOST:PORT``, ``rosrpc://HOST:PORT``."""

from __future__ import annotations

from typing import NamedTuple
from urllib.parse import urlsplit


class Address(NamedTuple):
    """The address of a master, node or service of ROS 1."""

    scheme: str
    """The scheme: ``http`` of XML-RPC, ``rosrpc`` of a service."""
    host: str
    """The name or IP address of the computer."""
    port: int
    """The port; 0 is not the port of a server."""


def read_address(uri: str) -> Address | None:
    """Read an address; return None if it lacks the host or the port, or is invalid."""
    try:
        parts = urlsplit(uri)
        host, port = parts.hostname, parts.port
    except ValueError:  # a port out of range, an address of IPv6 without its end
        return None
    return Address(parts.scheme, host, port) if host and port is not None else None
