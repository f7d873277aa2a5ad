"""Services over TCPROS: those of the bus for clients outside, and calls of services outside.

A request is a frame. The answer is a byte, 1 for success, and a frame: the response, or the text of
the error.
"""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from concurrent.futures import TimeoutError as FutureTimeout
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from ...errors import BadMessage, UwsimError
from ..encodings import from_ros1, to_ros1
from ..stamps import to_ros_clock, to_simulation_time
from ..types import WireService
from .address import read_address
from .tcpros import (
    PeerError,
    close,
    encode_header,
    framed,
    node_of,
    open_connection,
    read_frame,
    read_header,
    write,
)

ANSWER_TIMEOUT = 60.0
"""How long a client waits for the end of a step [s]."""
CALL_TIMEOUT = 30.0
"""How long a service outside may take to answer [s]."""

MAX_IDLE = 64
"""Clients that are connected and ask nothing; of more, the longest idle is left."""


class IdleClients:
    """The connections of clients from which a request is awaited, the longest idle first."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._connections: dict[socket.socket, None] = {}

    @contextmanager
    def awaiting(self, connection: socket.socket) -> Iterator[None]:
        """Count a client as idle in the context.

        Raises:
            PeerError: at the end, if the client was left.
        """
        with self._lock:
            self._connections[connection] = None
            if len(self._connections) > MAX_IDLE:
                longest_idle = next(iter(self._connections))
                del self._connections[longest_idle]
                close(longest_idle)
        try:
            yield
        finally:
            with self._lock:
                is_left = connection not in self._connections
                self._connections.pop(connection, None)
            if is_left:
                raise PeerError(f"it asked nothing, as {MAX_IDLE} others; it is left")


def check(offered: WireService, header: dict[str, str]) -> str | None:
    """Why a client with this connection header cannot be served; None if it can."""
    md5 = header.get("md5sum", "")
    if md5 in ("*", offered.md5):
        return None
    return f"service is {offered.ros1_name} (md5sum {offered.md5}), not md5sum {md5}"


def serve(
    connection: socket.socket,
    header: dict[str, str],
    offered: WireService,
    caller: str,
    request: Callable[[Any], Future[object]],
    idle: IdleClients,
) -> None:
    """Answer the calls of one client; in the connection's thread.

    Args:
        connection: to the client.
        header: of the client.
        offered: type of the service.
        caller: name of this node.
        request: asks the simulation.
        idle: clients that ask nothing, of all services.

    Raises:
        PeerError: the client broke off.
    """
    write(
        connection,
        encode_header(
            {
                "callerid": caller,
                "md5sum": offered.md5,
                "request_type": offered.request.ros1_name,
                "response_type": offered.response.ros1_name,
                "type": offered.ros1_name,
            }
        ),
    )
    if header.get("probe") == "1":
        return
    is_persistent = header.get("persistent") == "1"
    timeout = connection.gettimeout()
    while True:
        with idle.awaiting(connection):
            connection.settimeout(None if is_persistent else timeout)
            data = read_frame(connection)
            connection.settimeout(timeout)  # it has to read its answer in time
        if data is None:
            return
        write(connection, _answer(data, offered, request))
        if not is_persistent:
            return


def _answer(data: bytes, offered: WireService, request: Callable[[Any], Future[object]]) -> bytes:
    try:
        asked: object = to_simulation_time(from_ros1(offered.service.request, data))
        response = request(asked).result(timeout=ANSWER_TIMEOUT)
        return b"\x01" + framed(to_ros1(to_ros_clock(response)))
    except FutureTimeout:
        return b"\x00" + framed(b"the simulation does not advance")
    except UwsimError as error:
        return b"\x00" + framed(str(error).encode())


@dataclass(frozen=True)
class Wanted:
    """A service outside."""

    name: str
    """With a leading slash."""
    type: WireService
    """Its type."""
    may_answer: Callable[[str, str], bool] = lambda name, node: True
    """Whether a node, as `node_of` names it, may answer for the service of that name."""


def call(uri: str, wanted: Wanted, caller: str, request: object) -> object:
    """Call a service outside and return its response.

    Args:
        uri: ``rosrpc://host:port``.
        wanted: name and type of the service, and who may answer.
        caller: name of this node.
        request: of the type's class.

    Raises:
        PeerError: nobody answers, or with an error; or a node that may not.
    """
    name, address = wanted.name, read_address(uri)
    if address is None or not address.port:
        raise PeerError(f"service {name} is at {uri[:100]!r}, which is no address")
    connection = open_connection(address.host, address.port, CALL_TIMEOUT)
    try:
        fields = {"callerid": caller, "md5sum": wanted.type.md5, "service": name}
        write(connection, encode_header(fields))
        header = read_header(connection)  # rospy loses what comes together with the header
        if "callerid" in header and not wanted.may_answer(name, node_of(header)):
            raise PeerError(f"service {name}: {node_of(header)} does not take part in this run")
        write(connection, framed(to_ros1(to_ros_clock(request))))
        success = connection.recv(1)
        data = read_frame(connection)
    except OSError as error:
        raise PeerError(f"service {name} does not answer: {error}") from error
    finally:
        close(connection)
    if success != b"\x01" or data is None:
        what = "closed the connection" if data is None else data[:300].decode("utf-8", "replace")
        raise PeerError(f"service {name}: {what}")
    try:
        response: object = to_simulation_time(from_ros1(wanted.type.service.response, data))
        return response
    except BadMessage as error:
        raise PeerError(f"service {name}: {error}") from error
