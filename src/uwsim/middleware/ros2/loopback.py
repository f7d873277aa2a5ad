"""Restriction of a domain to this computer: Cyclone DDS itself listens on all addresses."""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

DEVICE = b"lo"
"""The loopback interface."""
FILE_DESCRIPTORS = Path("/proc/self/fd")
WILDCARD_ADDRESSES = ("0.0.0.0", "::")
"""The addresses of sockets that listen on every interface."""


def open_sockets() -> set[str]:
    """Return the identifiers of the open sockets of this process."""
    names = set()
    with suppress(OSError):
        for number in os.listdir(FILE_DESCRIPTORS):
            with suppress(OSError):
                names.add(os.readlink(FILE_DESCRIPTORS / number))
    return {name for name in names if name.startswith("socket:")}


def bind_to_loopback(old_sockets: set[str]) -> bool:
    """Make the UDP sockets that were opened since receive from the loopback interface only.

    Args:
        old_sockets: the result of `open_sockets` before they were opened.

    Returns:
        True if no other computer can reach them now.
    """
    is_closed = FILE_DESCRIPTORS.is_dir()
    for udp_socket in _new_udp_sockets(old_sockets):
        with udp_socket:
            if udp_socket.getsockname()[0] not in WILDCARD_ADDRESSES:
                continue
            try:
                udp_socket.setsockopt(socket.SOL_SOCKET, socket.SO_BINDTODEVICE, DEVICE)
            except (OSError, AttributeError):  # Linux before 5.7 allows root only
                is_closed = False
    return is_closed


def _new_udp_sockets(old_sockets: set[str]) -> Iterator[socket.socket]:
    for number in os.listdir(FILE_DESCRIPTORS) if FILE_DESCRIPTORS.is_dir() else ():
        with suppress(OSError):
            name = os.readlink(FILE_DESCRIPTORS / number)
            if name.startswith("socket:") and name not in old_sockets:
                new_socket = socket.socket(fileno=os.dup(int(number)))
                is_udp = new_socket.type == socket.SOCK_DGRAM
                if is_udp and new_socket.family in (socket.AF_INET, socket.AF_INET6):
                    yield new_socket
                else:
                    new_socket.close()
