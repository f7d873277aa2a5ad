"""UDP datagrams from external programs, received between steps."""

from __future__ import annotations

import socket
from collections.abc import Callable, Sequence

from ..base.terminal import warn
from ..errors import UwsimError
from .connections.drop_counts import DropCounter

MAX_BYTES = 2048
"""The maximum size of a datagram [bytes]; a longer one is cut."""
MAX_DATAGRAMS = 1000
"""The maximum number of datagrams read from a port at once; later ones wait for the next call."""


class Datagrams:
    """The open UDP ports of a scene.

    Args:
        address: the address of this computer at which datagrams are received; None: open no ports.
    """

    def __init__(self, address: str | None) -> None:
        self._address = address
        self._sockets: list[socket.socket] = []

    def open(self, port: int) -> Callable[[], Sequence[bytes]] | None:
        """Open a port; return a function that returns the datagrams received since its last call.

        The result is None if no ports are opened. On an error, all ports opened before are closed.

        Raises:
            UwsimError: the port is not free, or the address is not one of this computer.
        """
        if self._address is None:
            return None
        port_socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            port_socket.setblocking(False)
            port_socket.bind((self._address, port))
        except OSError as error:
            port_socket.close()
            self.close()
            reason = error.strerror or error
            raise UwsimError(
                f"UDP port {port} of {self._address} cannot be opened: {reason}."
            ) from None
        self._sockets.append(port_socket)
        return lambda: _receive_datagrams(port_socket)

    def close(self) -> None:
        """Close all ports, and print how many datagrams the system has dropped."""
        for port_socket in self._sockets:
            if n_dropped := DropCounter(port_socket).n_dropped:
                host, port = port_socket.getsockname()
                warn(f"UDP {host}:{port}: {n_dropped} datagrams dropped, as the queue was full")
            port_socket.close()
        self._sockets.clear()


def _receive_datagrams(port_socket: socket.socket) -> list[bytes]:
    datagrams: list[bytes] = []
    while len(datagrams) < MAX_DATAGRAMS:
        try:
            datagrams.append(port_socket.recv(MAX_BYTES))
        except BlockingIOError:
            break
        except OSError:  # the port is closed, or the operating system reports an error
            break
    return datagrams
