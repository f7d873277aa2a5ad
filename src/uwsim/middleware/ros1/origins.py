"""Which requests of HTTP come from pages in browsers.

Any page may have a browser send a request to any address, also to this computer. The browser adds
the page's ``Origin``. A page can also have its own name lead to this computer, and its requests
then have that name as their ``Host``. Nodes of ROS send no ``Origin``, and as ``Host`` an address
or the name of this computer.
"""

from __future__ import annotations

import ipaddress
import socket
from collections.abc import Mapping

LOCAL = (".local", ".lan", ".localdomain", ".internal", ".home.arpa")
"""Ends of names that are given in a local network only."""


def own_names(host: str) -> frozenset[str]:
    """Return names of this computer, given that by which its server listens."""
    return frozenset(
        name.lower().rstrip(".") for name in (host, "localhost", socket.gethostname()) if name
    )


def wrong_in_headers(headers: Mapping[str, str], own: frozenset[str]) -> str | None:
    """Return what in the headers of a request is of a page in a browser; None: nothing.

    Args:
        headers: of the request.
        own: names of this computer.
    """
    origin = headers.get("origin")
    if origin is not None:
        return f"it is of a page, {origin[:100]!r}"
    if headers.get("sec-fetch-site") is not None:
        return "it is of a browser"
    host = headers.get("host", "")
    name = _without_port(host).lower().rstrip(".")
    is_local = name in own or "." not in name or name.endswith(LOCAL)
    if name and not is_local and not _is_address(name):
        names = ", ".join(sorted(own))
        return f"its Host is {host[:100]!r}; expected an address, or one of {names} (--ros1-host)"
    return None


def _without_port(host: str) -> str:
    """``robot:11311`` -> ``robot``, ``[::1]:11311`` -> ``::1``."""
    host = host.strip()
    if host.startswith("["):
        return host[1:].partition("]")[0]
    return host.rpartition(":")[0] if host.count(":") == 1 else host


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True
