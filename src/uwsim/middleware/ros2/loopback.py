"""Restriction of a DDS domain to this computer, as Cyclone DDS itself listens on all addresses."""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

DEVICE = b"lo"
"""The loopback interface."""
FILE_DESCRIPTORS = Path("/proc/self/fd")
"""The folder in which Linux lists the open files of this process."""
WILDCARD_ADDRESSES = ("0.0.0.0", "::")
"""The addresses of sockets that listen on every interface."""


def list_sockets() -> set[str]:
    """Return the identifiers of the open sockets of this process."""
    names = set()
    with suppress(OSError):
        for descriptor in os.listdir(FILE_DESCRIPTORS):
            with suppress(OSError):
                names.add(os.readlink(FILE_DESCRIPTORS / descriptor))
    return {name for name in names if name.startswith("socket:")}


def bind_to_loopback(old_sockets: set[str]) -> bool:
    """Restrict the new UDP sockets that listen on all addresses to the loopback interface.

    Args:
        old_sockets: the result of `list_sockets` before the new sockets were opened.

    Returns:
        True if no other computer can reach the new sockets.
    """
    is_isolated = FILE_DESCRIPTORS.is_dir()
    for udp_socket in _new_udp_sockets(old_sockets):
        with udp_socket:
            if udp_socket.getsockname()[0] not in WILDCARD_ADDRESSES:
                continue  # the socket is bound to one address, so it hears no other interface
            try:
                udp_socket.setsockopt(socket.SOL_SOCKET, socket.SO_BINDTODEVICE, DEVICE)
            except (OSError, AttributeError):  # Linux before 5.7 allows root only
                is_isolated = False
    return is_isolated


def _new_udp_sockets(old_sockets: set[str]) -> Iterator[socket.socket]:
    for descriptor in os.listdir(FILE_DESCRIPTORS) if FILE_DESCRIPTORS.is_dir() else ():
        with suppress(OSError):
            name = os.readlink(FILE_DESCRIPTORS / descriptor)
            if name.startswith("socket:") and name not in old_sockets:
                new_socket = socket.socket(fileno=os.dup(int(descriptor)))
                is_udp = new_socket.type == socket.SOCK_DGRAM
                if is_udp and new_socket.family in (socket.AF_INET, socket.AF_INET6):
                    yield new_socket
                else:
                    new_socket.close()
