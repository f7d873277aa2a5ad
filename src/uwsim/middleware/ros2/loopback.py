"""Keeping a domain to this computer: Cyclone DDS itself listens on all addresses in any case."""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

DEVICE = b"lo"
"""The loopback interface."""
OPEN = Path("/proc/self/fd")
ANYWHERE = ("0.0.0.0", "::")
"""Addresses of sockets that listen on every interface."""


def open_sockets() -> set[str]:
    """Return what identifies the sockets that this process has open."""
    found = set()
    with suppress(OSError):
        for number in os.listdir(OPEN):
            with suppress(OSError):
                found.add(os.readlink(OPEN / number))
    return {each for each in found if each.startswith("socket:")}


def bind_to_loopback(before: set[str]) -> bool:
    """Have the UDP sockets that were opened since receive from the loopback interface alone.

    Args:
        before: what `open_sockets` has returned before they were opened.

    Returns:
        Whether none of them can be reached from other computers now.
    """
    is_closed = OPEN.is_dir()
    for found in _new_udp_sockets(before):
        with found:
            if found.getsockname()[0] not in ANYWHERE:
                continue
            try:
                found.setsockopt(socket.SOL_SOCKET, socket.SO_BINDTODEVICE, DEVICE)
            except (OSError, AttributeError):  # Linux before 5.7 allows it to root only
                is_closed = False
    return is_closed


def _new_udp_sockets(before: set[str]) -> Iterator[socket.socket]:
    for number in os.listdir(OPEN) if OPEN.is_dir() else ():
        with suppress(OSError):
            name = os.readlink(OPEN / number)
            if name.startswith("socket:") and name not in before:
                found = socket.socket(fileno=os.dup(int(number)))
                is_udp = found.type == socket.SOCK_DGRAM
                if is_udp and found.family in (socket.AF_INET, socket.AF_INET6):
                    yield found
                else:
                    found.close()
