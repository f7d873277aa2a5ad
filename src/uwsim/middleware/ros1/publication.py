"""A topic that is published to subscribers in ROS 1, with a queue and a thread for each."""

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
from ..stamps import to_ros_time
from ..types import WireType
from .tcpros import PeerError, add_length, encode_header, has_left, node_of, write

QUEUE_LENGTH = 100
"""The maximum number of messages that wait for a slow subscriber; the oldest are dropped."""
QUEUE_BYTES = 32 * 2**20
"""The maximum size of these messages [bytes]."""
IDLE_CHECK_INTERVAL = 0.5
"""The interval of checks whether a connection without messages has ended [s]."""
Encode = Callable[[Any, int], memoryview]
"""A function that encodes a message with its sequence number."""


def encode_message(message: object, seq: int) -> memoryview:
    """Encode a message of the bus for ROS 1, with stamps in the time of ``/clock``."""
    return to_ros1(to_ros_time(message), seq=seq)


class EncodedMessage:
    """A message to send, encoded once, by the first connection that needs it."""

    def __init__(self, message: object, seq: int, encode: Encode) -> None:
        self._message, self._seq, self._encode = message, seq, encode
        self._lock = threading.Lock()
        self._frame: bytes | None = None
        self.size = size_of(message)
        """The approximate size of the message [bytes]."""

    def frame(self) -> bytes:
        """Return the encoded message, preceded by its length; raise BadMessage if it is invalid."""
        with self._lock:
            if self._frame is None:
                self._frame = add_length(self._encode(self._message, self._seq))
            return self._frame


class Publication:
    """A published topic, and the connections to its subscribers.

    Args:
        topic: the name of the topic, with a leading slash.
        kind: the type of the messages.
        caller: the name of this node.
        log: the log for events.
        send_timeout: the time limit for a subscriber to read a message [s].
        encode: a function that returns the bytes of a message.
        is_latched: True if new subscribers receive the newest message first.
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
        self._latched_message: EncodedMessage | None = None
        self._lock = threading.Lock()
        self._queues: list[tuple[str, LatestQueue[EncodedMessage]]] = []  # with the node's name
        self._n_sent = 0
        self._is_closed = False

    def send(self, message: object, target_node: str = "") -> None:
        """Send a message without waiting, to all subscribers or only to those of one node."""
        self._n_sent += 1
        encoded_message = EncodedMessage(message, self._n_sent, self._encode)
        with self._lock:
            queues = [queue for node, queue in self._queues if target_node in ("", node)]
            if not target_node:
                self._latched_message = encoded_message if self._is_latched else None
        for queue in queues:
            if queue.put(encoded_message, encoded_message.size):
                self._log.report(
                    f"{self.topic}: a subscriber reads too slowly; the oldest messages are dropped",
                    kind=f"slow {self.topic}",
                )

    @property
    def n_subscribers(self) -> int:
        """The number of connected subscribers."""
        return len(self._queues)

    def check(self, header: dict[str, str]) -> str | None:
        """Return the reason why a subscriber with this header cannot be served; None if it can."""
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
            connection: the connection to the subscriber.
            header: the header of the subscriber.
            count: a function that is called with 1 as soon as the subscriber has its queue, and
                with -1 at the end of the connection.

        Raises:
            PeerError: the connection broke, or the subscriber does not read.
        """
        queue: LatestQueue[EncodedMessage] = LatestQueue(QUEUE_LENGTH, QUEUE_BYTES)
        node_queue = node_of(header), queue
        connection.settimeout(self._send_timeout)
        with self._lock:
            if self._is_closed:
                return
            self._queues.append(node_queue)  # before the header: then no message is missed
            if self._latched_message is not None:
                queue.put(self._latched_message, self._latched_message.size)
        count(1)
        try:
            write(connection, encode_header(self._header()))
            self._send_all(connection, queue)
        finally:
            count(-1)
            with self._lock:
                self._queues.remove(node_queue)
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

    def _send_all(self, connection: socket.socket, queue: LatestQueue[EncodedMessage]) -> None:
        while not queue.is_closed:
            encoded_message = queue.get(timeout=IDLE_CHECK_INTERVAL)
            if encoded_message is None:
                if has_left(connection):
                    return
                continue
            try:
                write(connection, encoded_message.frame())
            except BadMessage as error:
                self._log.report(f"{self.topic}: {error}", kind=f"unencodable {self.topic}")
            except PeerError:
                if has_left(connection):
                    return
                raise

    def close(self) -> None:
        """Close all queues."""
        with self._lock:
            self._is_closed = True
            queues = list(self._queues)
        for _, queue in queues:
            queue.close()
