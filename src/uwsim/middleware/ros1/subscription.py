"""A topic that is read from publishers in ROS 1, with a thread for each publisher."""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Callable, Iterable

from ...errors import BadMessage
from ..encodings import from_ros1
from ..log import Log
from ..stamps import to_sim_time
from ..types import WireType
from ..work_budget import WorkBudget
from .tcpros import (
    PeerError,
    close,
    encode_header,
    node_of,
    open_connection,
    read_frame,
    read_header,
    write,
)
from .xmlrpc import MAX_NODE_ANSWER, call

RETRY_INTERVAL = 1.0
"""The time after which a lost connection is tried again [s]."""
MAX_PUBLISHERS = 100
"""The maximum number of publishers that are read for one topic, each in a thread."""
CONNECT_TIMEOUT = 10.0
"""The time limit for a publisher to answer [s]."""
LINK_SHARE, LINK_BURST = 0.05, 0.1
"""The budget for reading one publisher: the fraction of the wall time, and the longest burst
[s]."""
ALL_SHARE, ALL_BURST = 0.1, 0.2
"""The budget for reading all publishers together, except those for which a run in lock-step
waits."""
PAUSE = 0.1
"""The pause of a publisher that has exceeded its share, in addition to the excess [s]. It limits
how often its thread wakes, because the simulation then waits for Python's global lock."""


class ReadingLimit:
    """A limit on the time that reading publishers takes from the simulation.

    Args:
        is_waited_for: a function that returns whether the run waits for a node, as named by
            `node_of`; such a node has no limit.
    """

    def __init__(self, is_waited_for: Callable[[str], bool] = lambda node: False) -> None:
        self.is_waited_for = is_waited_for
        self.total_budget = WorkBudget(ALL_SHARE, ALL_BURST)


class Subscription:
    """A topic that is read, and the connections to its publishers.

    Args:
        topic: the name of the topic, with a leading slash.
        kind: the type of the messages.
        caller: the name of this node.
        log: the log for events.
        receive: a function that is called, in the thread of the publisher, with each message, whose
            stamps are in simulation time, and with the name of the publisher.
        limit: the limit of the time that reading takes.
    """

    def __init__(
        self,
        topic: str,
        kind: WireType,
        caller: str,
        log: Log,
        receive: Callable[[object, str], None],
        limit: ReadingLimit,
    ) -> None:
        self.limit = limit
        self.topic, self.kind = topic, kind
        self._caller, self._log, self._receive = caller, log, receive
        self._lock = threading.Lock()
        self._links: dict[str, _Link] = {}
        self._is_closed = False

    @property
    def n_publishers(self) -> int:
        """The number of connected publishers."""
        return sum(link.is_connected for link in list(self._links.values()))

    def update(self, uris: Iterable[str]) -> None:
        """Connect to publishers with these URIs, and to no others."""
        all_uris = sorted(set(uris))
        read_uris = set(all_uris[:MAX_PUBLISHERS])
        if len(all_uris) > MAX_PUBLISHERS:
            self._log.report(
                f"{self.topic}: {len(all_uris)} publishers; {MAX_PUBLISHERS} of them are read",
                kind=f"publishers {self.topic}",
            )
        with self._lock:
            if self._is_closed:
                return
            removed_links = [self._links.pop(uri) for uri in sorted(set(self._links) - read_uris)]
            for uri in sorted(read_uris - set(self._links)):
                self._links[uri] = _Link(self, uri)
        for link in removed_links:
            link.close()

    def close(self) -> None:
        """Disconnect from all publishers."""
        with self._lock:
            self._is_closed = True
            links, self._links = list(self._links.values()), {}
        for link in links:
            link.close()

    def connect(self, uri: str) -> tuple[socket.socket, str]:
        """Request the topic from a node and connect to the node.

        Returns:
            The connection, and the name of the node.

        Raises:
            PeerError: the node cannot be reached, or refuses.
        """
        arguments = (self._caller, self.topic, [["TCPROS"]])
        answer = call(uri, "requestTopic", *arguments, max_length=MAX_NODE_ANSWER)
        match answer:
            case ["TCPROS", str(host), int(port)]:
                connection = open_connection(host, port, CONNECT_TIMEOUT)
            case _:
                raise PeerError(f"{uri} offers {self.topic} over another protocol than TCPROS")
        try:
            return connection, self._exchange_headers(connection)
        except PeerError:
            close(connection)
            raise

    def _exchange_headers(self, connection: socket.socket) -> str:
        """Exchange connection headers; return the name of the node."""
        fields = {
            "callerid": self._caller,
            "md5sum": self.kind.md5,
            "message_definition": self.kind.ros1_definition,
            "tcp_nodelay": "1",
            "topic": self.topic,
            "type": self.kind.ros1_name,
        }
        write(connection, encode_header(fields))
        header = read_header(connection)
        if header.get("md5sum") not in ("*", self.kind.md5):
            raise PeerError(f"it publishes {header.get('type')}, not {self.kind.ros1_name}")
        connection.settimeout(None)  # a publisher may be silent for long
        return node_of(header)

    def take(self, data: bytes, sender: str) -> None:
        """Decode a message and pass it on; report an invalid message."""
        try:
            message: object = to_sim_time(from_ros1(self.kind.message, data))
        except BadMessage as error:
            self._log.report(f"{self.topic}: from {sender}: {error}", kind=f"garbage {self.topic}")
        else:
            self._receive(message, sender)

    def report_flood(self, sender: str) -> None:
        """Report that the messages of a publisher wait."""
        line = f"{self.topic}: {sender} publishes faster than uwsim reads; its messages are delayed"
        self._log.report(line, kind=f"flood {self.topic}")

    def report(self, uri: str, error: PeerError) -> None:
        """Report an error of a publisher."""
        self._log.report(f"{self.topic}: publisher {uri}: {error}", kind=f"lost {self.topic} {uri}")


class _Link:
    """The connection to one publisher, which is renewed until it is closed."""

    def __init__(self, subscription: Subscription, uri: str) -> None:
        self._subscription, self._uri = subscription, uri
        self._stop_event = threading.Event()
        self._connection: socket.socket | None = None
        self._work = WorkBudget(LINK_SHARE, LINK_BURST)
        self.is_connected = False
        threading.Thread(target=self._run, name=f"ros1{subscription.topic}", daemon=True).start()

    def _run(self) -> None:
        while not self._stop_event.is_set():
            try:
                self._connection, sender = self._subscription.connect(self._uri)
                self.is_connected = True
                self._read(self._connection, sender)
            except PeerError as error:
                if not self._stop_event.is_set():
                    self._subscription.report(self._uri, error)
            finally:
                self.is_connected = False
                if self._connection is not None:
                    close(self._connection)
            self._stop_event.wait(RETRY_INTERVAL)

    def _read(self, connection: socket.socket, sender: str) -> None:
        """Pass on messages until the connection ends; a flood waits in the sockets."""
        limit = self._subscription.limit
        while not self._stop_event.is_set():
            start_time = time.thread_time()
            data = read_frame(connection)
            if data is None:
                return
            self._subscription.take(data, sender)
            if not limit.is_waited_for(sender):
                duration = time.thread_time() - start_time
                self._work.spend(duration)
                limit.total_budget.spend(duration)
                if (delay := max(self._work.delay, limit.total_budget.delay)) > 0.0:
                    self._subscription.report_flood(sender)
                    self._stop_event.wait(delay + PAUSE)

    def close(self) -> None:
        self._stop_event.set()
        if self._connection is not None:
            close(self._connection)
