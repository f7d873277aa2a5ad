"""The number of datagrams that the operating system dropped, because a port's queue was full.

Linux counts them for each socket (``SO_MEMINFO``, ``SK_MEMINFO_DROPS`` of ``linux/sock_diag.h``).
Other systems do not tell.
"""

from __future__ import annotations

import socket
import struct
import sys

MEMORY_OPTION = 55
"""The socket option ``SO_MEMINFO``, which returns counters; Python does not name it."""
N_COUNTERS = 9
"""The number of counters, of 32 bits each."""
DROPS_INDEX = 8
"""The index of the number of dropped datagrams."""


class DropCounter:
    """The number of datagrams that a socket has dropped."""

    def __init__(self, port_socket: socket.socket) -> None:
        self._socket = port_socket
        self._last_count = 0
        self._n_dropped = 0

    @property
    def n_dropped(self) -> int:
        """The number so far; 0 on systems that do not count. The system's counter has 32 bits."""
        count = _read_drops(self._socket)
        if count is not None:
            self._n_dropped += (count - self._last_count) % 2**32
            self._last_count = count
        return self._n_dropped


def _read_drops(port_socket: socket.socket) -> int | None:
    """Return the system's counter; None if there is none, or the socket is closed."""
    if sys.platform != "linux":
        return None
    try:
        counters = port_socket.getsockopt(socket.SOL_SOCKET, MEMORY_OPTION, 4 * N_COUNTERS)
        count: int = struct.unpack(f"{N_COUNTERS}I", counters)[DROPS_INDEX]
    except (OSError, struct.error):
        return None
    return count
