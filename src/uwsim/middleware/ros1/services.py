"""Services over TCPROS: the bus's services for external clients, and calls of external services.

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
from ..stamps import to_ros_time, to_sim_time
from ..types import WireService
from .address import read_address
from .tcpros import (
    PeerError,
    add_length,
    close,
    encode_header,
    node_of,
    open_connection,
    read_frame,
    read_header,
    write,
)

ANSWER_TIMEOUT = 60.0
"""The time limit for a response of the simulation [s]."""
CALL_TIMEOUT = 30.0
"""The time limit for a response of an external service [s]."""

MAX_IDLE = 64
"""The maximum number of connected clients without a request; the longest idle is disconnected."""


class IdleClients:
    """The connections of clients without a request, the longest idle first."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._connections: dict[socket.socket, None] = {}

    @contextmanager
    def count_idle(self, connection: socket.socket) -> Iterator[None]:
        """Count a client as idle in the context.

        Raises:
            PeerError: at the end, if the client was disconnected.
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
                is_disconnected = connection not in self._connections
                self._connections.pop(connection, None)
            if is_disconnected:
                raise PeerError(f"it is idle, like {MAX_IDLE} newer connections; it is closed")


def check(kind: WireService, header: dict[str, str]) -> str | None:
    """Return the reason why a client with this header cannot be served; None if it can."""
    md5 = header.get("md5sum", "")
    if md5 in ("*", kind.md5):
        return None
    return f"service is {kind.ros1_name} (md5sum {kind.md5}), not md5sum {md5}"


def serve(
    connection: socket.socket,
    header: dict[str, str],
    kind: WireService,
    caller: str,
    request: Callable[[Any], Future[object]],
    idle_clients: IdleClients,
) -> None:
    """Answer the calls of one client; in the connection's thread.

    Args:
        connection: the connection to the client.
        header: the header of the client.
        kind: the type of the service.
        caller: the name of this node.
        request: a function that sends a request to the simulation.
        idle_clients: the clients, of all services, that have sent no request.

    Raises:
        PeerError: the connection broke.
    """
    write(
        connection,
        encode_header(
            {
                "callerid": caller,
                "md5sum": kind.md5,
                "request_type": kind.request.ros1_name,
                "response_type": kind.response.ros1_name,
                "type": kind.ros1_name,
            }
        ),
    )
    if header.get("probe") == "1":
        return
    is_persistent = header.get("persistent") == "1"
    timeout = connection.gettimeout()
    while True:
        with idle_clients.count_idle(connection):
            connection.settimeout(None if is_persistent else timeout)
            data = read_frame(connection)
            connection.settimeout(timeout)  # the client must read its answer in time
        if data is None:
            return
        write(connection, _answer(data, kind, request))
        if not is_persistent:
            return


def _answer(data: bytes, kind: WireService, request: Callable[[Any], Future[object]]) -> bytes:
    try:
        bus_request: object = to_sim_time(from_ros1(kind.service.request, data))
        response = request(bus_request).result(timeout=ANSWER_TIMEOUT)
        return b"\x01" + add_length(to_ros1(to_ros_time(response)))
    except FutureTimeout:
        return b"\x00" + add_length(b"the simulation does not advance")
    except UwsimError as error:
        return b"\x00" + add_length(str(error).encode())


@dataclass(frozen=True)
class ExternalService:
    """A service of another node."""

    name: str
    """The name, with a leading slash."""
    type: WireService
    """The type of the service."""
    may_answer: Callable[[str, str], bool] = lambda name, node: True
    """A function that returns whether a node, as named by `node_of`, may answer the service."""


def call(uri: str, service: ExternalService, caller: str, request: object) -> object:
    """Call an external service and return its response.

    Args:
        uri: the URI, ``rosrpc://host:port``.
        service: the service, with the nodes that may answer.
        caller: the name of this node.
        request: the request, of the type's class.

    Raises:
        PeerError: there is no answer, it is an error, or it comes from a node that may not answer.
    """
    name, address = service.name, read_address(uri)
    if address is None or not address.port:
        raise PeerError(f"service {name} is at {uri[:100]!r}, which is not an address")
    connection = open_connection(address.host, address.port, CALL_TIMEOUT)
    try:
        fields = {"callerid": caller, "md5sum": service.type.md5, "service": name}
        write(connection, encode_header(fields))
        header = read_header(connection)  # rospy loses a request that comes with the header
        if "callerid" in header and not service.may_answer(name, node_of(header)):
            raise PeerError(f"service {name}: {node_of(header)} does not take part in this run")
        write(connection, add_length(to_ros1(to_ros_time(request))))
        success = connection.recv(1)
        data = read_frame(connection)
    except OSError as error:
        raise PeerError(f"service {name} does not answer: {error}") from error
    finally:
        close(connection)
    if success != b"\x01" or data is None:
        reason = "closed the connection" if data is None else data[:300].decode("utf-8", "replace")
        raise PeerError(f"service {name}: {reason}")
    try:
        response: object = to_sim_time(from_ros1(service.type.service.response, data))
        return response
    except BadMessage as error:
        raise PeerError(f"service {name}: {error}") from error
