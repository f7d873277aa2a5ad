"""Addresses of masters, nodes and services: ``http://HOST:PORT``, ``rosrpc://HOST:PORT``."""

from __future__ import annotations

from typing import NamedTuple
from urllib.parse import urlsplit


class Address(NamedTuple):
    """Where something of ROS 1 listens."""

    scheme: str
    """``http`` of XML-RPC, ``rosrpc`` of a service."""
    host: str
    """Name or number of the computer."""
    port: int
    """The port; 0 is none that can be called."""


def read_address(uri: str) -> Address | None:
    """Read an address; None if it lacks the host or the port, or is nonsense."""
    try:
        place = urlsplit(uri)
        host, port = place.hostname, place.port
    except ValueError:  # a port out of range, an address of IPv6 without its end
        return None
    return Address(place.scheme, host, port) if host and port is not None else None
