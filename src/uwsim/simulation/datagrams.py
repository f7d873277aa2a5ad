"""UDP packets from outside, taken over between steps."""

from __future__ import annotations

import socket
from collections.abc import Callable, Sequence

from ..errors import UwsimError

MAX_BYTES = 2048
"""Of a packet; what is longer is cut."""
MAX_PACKETS = 1000
"""So many are taken from a port in one step; the rest waits for the next."""


class Datagrams:
    """The UDP ports of a scene; closed at the end.

    Args:
        address: of this computer, at which packets are taken; None: there are none.
    """

    def __init__(self, address: str | None) -> None:
        self._address = address
        self._sockets: list[socket.socket] = []

    def open(self, port: int) -> Callable[[], Sequence[bytes]] | None:
        """Return what returns the packets that have come to a port since its last call, or None.

        Raises:
            UwsimError: the port is not free, or the address is not one of this computer.
        """
        if self._address is None:
            return None
        found = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            found.setblocking(False)
            found.bind((self._address, port))
        except OSError as error:
            found.close()
            self.close()
            why = error.strerror or error
            raise UwsimError(
                f"UDP port {port} of {self._address} cannot be opened: {why}."
            ) from None
        self._sockets.append(found)
        return lambda: _waiting(found)

    def close(self) -> None:
        """Close all ports."""
        for each in self._sockets:
            each.close()
        self._sockets.clear()


def _waiting(port: socket.socket) -> list[bytes]:
    packets: list[bytes] = []
    while len(packets) < MAX_PACKETS:
        try:
            packets.append(port.recv(MAX_BYTES))
        except BlockingIOError:
            break
        except OSError:  # closed, or one that was refused elsewhere
            break
    return packets
