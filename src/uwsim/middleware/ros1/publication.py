"""A topic that is published to subscribers of ROS 1, each with a queue and a thread of its own."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable
from typing import Any

from ...base.message_fields import size_of
from ...errors import BadMessage
from ..encodings import to_ros1
from ..log import Log
from ..queues import LatestQueue
from ..stamps import to_ros_clock
from ..types import WireType
from .tcpros import PeerError, encode_header, framed, has_left, node_of, write

QUEUE_LENGTH = 100
"""Messages that wait for a slow subscriber; the oldest are dropped."""
QUEUE_BYTES = 32 * 2**20
IDLE_CHECK = 0.5
"""How often a connection without messages is looked at for its end [s]."""
Encode = Callable[[Any, int], memoryview]
"""Encodes a message, with its sequence number."""


def encode_message(message: object, seq: int) -> memoryview:
    """Return a message of the bus as ROS 1 has it, stamps on the clock of ROS."""
    return to_ros1(to_ros_clock(message), seq=seq)


class Outgoing:
    """A message on its way out: encoded once, by the first connection that needs it."""

    def __init__(self, message: object, seq: int, encode: Encode) -> None:
        self._message, self._seq, self._encode = message, seq, encode
        self._lock = threading.Lock()
        self._frame: bytes | None = None
        self.size = size_of(message)
        """About how many bytes it takes."""

    def frame(self) -> bytes:
        """Return it with its length in front; raises BadMessage."""
        with self._lock:
            if self._frame is None:
                self._frame = framed(self._encode(self._message, self._seq))
            return self._frame


class Publication:
    """A published topic and its connections.

    Args:
        topic: name with a leading slash.
        kind: its type.
        caller: name of this node.
        log: where it reports.
        send_timeout: how long a subscriber may take to read a message [s].
        encode: returns the bytes of a message.
        is_latched: whether a subscriber begins with the newest message.
    """

    def __init__(
        self,
        topic: str,
        kind: WireType,
        caller: str,
        log: Log,
        send_timeout: float,
        *,
        encode: Encode = encode_message,
        is_latched: bool = False,
    ) -> None:
        self.topic, self.kind = topic, kind
        self._caller, self._log, self._send_timeout = caller, log, send_timeout
        self._encode, self._is_latched = encode, is_latched
        self._newest: Outgoing | None = None
        self._lock = threading.Lock()
        self._queues: list[tuple[str, LatestQueue[Outgoing]]] = []  # of each node
        self._n_sent = 0
        self._is_closed = False

    def send(self, message: object, only: str = "") -> None:
        """Hand a message to all subscribers, or to those of one node, without waiting."""
        self._n_sent += 1
        outgoing = Outgoing(message, self._n_sent, self._encode)
        with self._lock:
            queues = [queue for node, queue in self._queues if only in ("", node)]
            if not only:
                self._newest = outgoing if self._is_latched else None
        for queue in queues:
            if queue.put(outgoing, outgoing.size):
                self._log.report(
                    f"{self.topic}: a subscriber reads too slowly; the oldest messages are dropped",
                    kind=f"slow {self.topic}",
                )

    @property
    def n_subscribers(self) -> int:
        """Connections there are."""
        return len(self._queues)

    def check(self, header: dict[str, str]) -> str | None:
        """Why a subscriber with this connection header cannot be served; None if it can."""
        md5, kind = header.get("md5sum", ""), header.get("type", "")
        if md5 not in ("*", self.kind.md5):
            return (
                f"topic {self.topic} carries {self.kind.ros1_name} (md5sum {self.kind.md5}), "
                f"not {kind} ({md5})"
            )
        return None

    def serve(
        self,
        connection: socket.socket,
        header: dict[str, str],
        count: Callable[[int], object] = lambda n: None,
    ) -> None:
        """Send messages over a connection until either side leaves; in the connection's thread.

        Args:
            connection: to the subscriber.
            header: that the subscriber has sent.
            count: called with 1 once messages are kept for the subscriber, and with -1 at its end.

        Raises:
            PeerError: the subscriber broke off, or does not read.
        """
        queue: LatestQueue[Outgoing] = LatestQueue(QUEUE_LENGTH, QUEUE_BYTES)
        mine = node_of(header), queue
        connection.settimeout(self._send_timeout)
        with self._lock:
            if self._is_closed:
                return
            self._queues.append(mine)  # before the header: who has it misses no message
            if self._newest is not None:
                queue.put(self._newest, self._newest.size)
        count(1)
        try:
            write(connection, encode_header(self._header()))
            self._send_all(connection, queue)
        finally:
            count(-1)
            with self._lock:
                self._queues.remove(mine)
            queue.close()

    def _header(self) -> dict[str, str]:
        return {
            "callerid": self._caller,
            "latching": str(int(self._is_latched)),
            "md5sum": self.kind.md5,
            "message_definition": self.kind.ros1_definition,
            "topic": self.topic,
            "type": self.kind.ros1_name,
        }

    def _send_all(self, connection: socket.socket, queue: LatestQueue[Outgoing]) -> None:
        while not queue.is_closed:
            outgoing = queue.get(timeout=IDLE_CHECK)
            if outgoing is None:
                if has_left(connection):
                    return
                continue
            try:
                write(connection, outgoing.frame())
            except BadMessage as error:
                self._log.report(f"{self.topic}: {error}", kind=f"unencodable {self.topic}")
            except PeerError:
                if has_left(connection):
                    return
                raise

    def close(self) -> None:
        """Serve no more."""
        with self._lock:
            self._is_closed = True
            queues = list(self._queues)
        for _, queue in queues:
            queue.close()
