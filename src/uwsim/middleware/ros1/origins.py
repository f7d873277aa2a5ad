"""Recognition of HTTP requests that come from pages in browsers.

Any page may make a browser send a request to any address, also to this computer. The browser adds
the page's ``Origin``. A page can also make its own name resolve to this computer; its requests then
have that name as their ``Host``. Nodes of ROS send no ``Origin``, and as ``Host`` an address or the
name of this computer.
"""

from __future__ import annotations

import ipaddress
import socket
from collections.abc import Mapping

LOCAL_SUFFIXES = (".local", ".lan", ".localdomain", ".internal", ".home.arpa")
"""The suffixes of names in local networks."""


def local_names(host: str) -> frozenset[str]:
    """Return the names of this computer, with ``host``, the name at which the server listens."""
    return frozenset(
        name.lower().rstrip(".") for name in (host, "localhost", socket.gethostname()) if name
    )


def find_browser_sign(headers: Mapping[str, str], local_names: frozenset[str]) -> str | None:
    """Return the sign in the headers of a request that a web page sent it; None if there is none.

    Args:
        headers: the headers of the request.
        local_names: the names of this computer.
    """
    origin = headers.get("origin")
    if origin is not None:
        return f"it comes from a page, {origin[:100]!r}"
    if headers.get("sec-fetch-site") is not None:
        return "it comes from a browser"
    host = headers.get("host", "")
    name = _remove_port(host).lower().rstrip(".")
    is_local = name in local_names or "." not in name or name.endswith(LOCAL_SUFFIXES)
    if name and not is_local and not _is_address(name):
        names = ", ".join(sorted(local_names))
        return f"its Host is {host[:100]!r}; expected an address, or one of {names} (--ros1-host)"
    return None


def _remove_port(host: str) -> str:
    """Return ``robot`` for ``robot:11311``, ``::1`` for ``[::1]:11311``."""
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
