"""The bridge that makes a bus a node of a ROS 2 graph.

A topic that is published on the bus has a writer, a topic that is read on the bus has a reader, and
the services of the bus are offered. A camera renders only while a reader matches its writer. A
separate thread (``uwsim-ros2-out``) encodes messages, so that the simulation does not wait for it.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from functools import partial

from ...base.message_fields import size_of
from ...bus import Bus, TopicEndpoints
from ...errors import BadMessage, UwsimError
from ...messages.services import Service
from ..bridge import LATCHED, Bridge, TransportTraits
from ..clock_topic import ROS_PERIOD
from ..encodings import from_cdr, to_cdr
from ..log import Log
from ..queues import MAX_ITEMS, LatestQueue
from ..stamps import clock_time, to_ros_time, to_sim_time
from ..types import message_class, wire_service
from .names import MAX_NAME_LENGTH, is_legal
from .node import BytesReader, BytesWriter, Endpoint, Ros2Node
from .quality import CLOCK, Quality, quality_of

CLOSE_S = 5.0
"""The time limit for sending the last messages at the end [s]."""


class Ros2(Bridge):
    """The connection of a bus to a domain of ROS 2.

    Args:
        bus: the bus of the simulation.
        clock: a function that returns the simulation time [s].
        node: the node in the graph, which `close` closes.
        log: the log for events.
    """

    traits = TransportTraits(needs_discovery=True, needs_invitation=True, clock_period=ROS_PERIOD)

    def __init__(self, bus: Bus, clock: Callable[[], float], node: Ros2Node, log: Log) -> None:
        super().__init__(bus, clock, log)
        self._node = node
        self._writers: dict[str, BytesWriter] = {}
        self._readers: dict[str, BytesReader] = {}
        self._servers: dict[str, Endpoint] = {}
        self._complete_topics: set[str] = set()
        self._illegal_names: set[str] = set()
        self._send_queue: LatestQueue[tuple[str, object]] = LatestQueue()
        self._clock_class = message_class("rosgraph_msgs/Clock")
        self._n_clocks = 0
        self._add_writer(CLOCK, self._clock_class, self._on_clocks)
        node.announce_endpoints()
        self._remove_external_services = bus.services.add_external_services(
            node.offers, self.external_services.call_and_wait
        )
        self._thread = threading.Thread(target=self._write, name="uwsim-ros2-out", daemon=True)
        self._thread.start()

    def on_topics(self, topics: Mapping[str, TopicEndpoints]) -> None:
        """Make a writer for each topic published on the bus, a reader for each topic read there."""
        legal_topics = {name: topic for name, topic in topics.items() if self._is_legal(name)}
        writer_topics = {name: topic for name, topic in legal_topics.items() if topic.is_published}
        reader_topics = {name: topic for name, topic in legal_topics.items() if topic.is_read}
        for name in sorted(set(self._writers) - set(writer_topics) - {CLOCK}):
            self._writers.pop(name).close()
        for name in sorted(set(self._readers) - set(reader_topics)):
            self._readers.pop(name).close()
        for name in sorted(set(writer_topics) - set(self._writers)):
            self._add_writer(
                name, writer_topics[name].type, _ReaderCount(self, name, self._node.lease)
            )
        for name in sorted(set(reader_topics) - set(self._readers)):
            self._add_reader(name, reader_topics[name].type)
        self._node.announce_endpoints()

    def on_services(self, services: Mapping[str, Service]) -> None:
        """Offer the services of the bus."""
        legal_names = set(filter(self._is_legal, services))
        for name in sorted(set(self._servers) - legal_names):
            self._servers.pop(name).close()
        for name in sorted(legal_names - set(self._servers)):
            kind = wire_service(services[name])
            self._servers[name] = self._node.server(name, kind, partial(self.request, name))
        self._node.announce_endpoints()

    def _is_legal(self, name: str) -> bool:
        """Return whether ROS 2 allows a name; report an illegal name once."""
        if is_legal(name):
            return True
        if name not in self._illegal_names:
            self._illegal_names.add(name)
            self.log.report(
                f"not on the graph: /{name[:300]}. A name of ROS 2 has letters, digits and _ "
                f"between slashes, no part begins with a digit, and it has at most "
                f"{MAX_NAME_LENGTH} letters"
            )
        return False

    def send(self, topic: str, message: object) -> None:
        """Queue a message; the oldest messages are dropped while subscribers are too slow."""
        if self._send_queue.put((topic, message), size_of(message)):
            self.log.report(
                "subscribers do not keep up; the oldest messages are dropped", kind="outgoing flood"
            )

    def read_all(self, topic: str) -> None:
        """Read a topic with its history (transient local), which its publishers must then offer.

        A reader without history misses the samples that were written before it discovered the
        writer, and the writer does not know when that happens.
        """
        name = topic.lstrip("/")
        self._complete_topics.add(name)
        if name in self._readers:
            self._readers.pop(name).close()
            self._add_reader(name, self._topics[name].type)

    def _tick(self) -> None:
        """Publish the time if it is due; report if the thread of the node has ended."""
        if self._node.error is not None:
            self.log.report(f"the node has stopped: {self._node.error}", kind="stopped")
        super()._tick()

    def _publish_clock(self) -> None:
        if self._n_clocks:
            self.send(CLOCK, self._clock_class(clock=clock_time(self.clock_topic.time())))

    def _clock_is_read(self) -> bool:
        return self._n_clocks > 0

    def has_publisher(self, topic: str) -> bool:
        """Return whether an external writer matches the reader of ``topic``."""
        reader = self._readers.get(topic)
        return reader is not None and reader.n_writers > 0

    def close(self) -> None:
        """Send the waiting messages, and leave the graph."""
        self.send("", None)
        self._thread.join(timeout=CLOSE_S)
        self._send_queue.close()
        self._remove_external_services()
        self._node.close()
        super().close()

    def call_external_service(self, name: str, request: object) -> Future[object]:
        """Call a service that another node offers."""
        return self._node.call(name, request)

    def _publisher_of(self, topic: str) -> str:
        """Return the nodes that publish a topic; a message does not identify its sender."""
        nodes = self._node.publishers(topic)
        return f"node {nodes[0]}" if len(nodes) == 1 else " or ".join(nodes[:3])

    def _on_clocks(self, n_readers: int) -> None:
        self._n_clocks = n_readers
        self.clock_topic.send_at_next_step()

    def _add_writer(self, name: str, type: type, on_readers: Callable[[int], None]) -> None:
        self._writers[name] = self._node.writer(name, type, quality_of(name), on_readers)

    def _add_reader(self, name: str, type: type) -> None:
        is_latched = name in (*LATCHED, *self._complete_topics)
        quality = Quality(depth=MAX_ITEMS, is_latched=is_latched, ignores_own=True)
        receive = partial(self._receive, name, type)
        refuse = partial(self._refuse_writer, name)
        self._readers[name] = self._node.reader(name, type, quality, receive, refuse)

    def _receive(self, name: str, type: type, data: bytes, sender: str = "") -> None:
        try:
            self.put(name, to_sim_time(from_cdr(type, data)), sender)
        except BadMessage as error:
            self.log.report(f"/{name}: a message was refused: {error}", kind=f"refused {name}")

    def _refuse_writer(self, name: str) -> None:
        self.log.report(
            f"/{name}: a publisher offers best effort only; its messages are not received, because "
            "commands must not be lost. Set its reliability to RELIABLE",
            kind=f"best effort {name}",
        )

    def _write(self) -> None:
        """Encode and write messages until `close`."""
        while (item := self._send_queue.get()) is not None:
            topic, message = item
            writer = self._writers.get(topic)
            if message is None:
                return
            if writer is None:
                continue
            try:
                is_sent = writer.write(bytes(to_cdr(to_ros_time(message))))
            except UwsimError as error:
                self.log.report(f"/{topic}: not sent: {error}", kind=f"unsent {topic}")
                continue
            if not is_sent:
                self.log.report(
                    f"/{topic}: a subscriber does not keep up; messages are dropped",
                    kind=f"behind {topic}",
                )


class _ReaderCount:
    """A callback that reports changes of the number of readers of a topic to a bridge."""

    def __init__(self, bridge: Bridge, topic: str, lease: str) -> None:
        self._bridge, self._topic, self._lease, self._n = bridge, topic, lease, 0

    def __call__(self, n_readers: int) -> None:
        for _ in range(n_readers - self._n):
            self._bridge.subscribers.add(self._topic)
        for _ in range(self._n - n_readers):
            self._bridge.subscribers.remove(self._topic)
        if n_readers < self._n:
            self._bridge.log.report(
                f"/{self._topic}: a subscriber has left, or was silent {self._lease}",
                kind=f"left {self._topic}",
            )
        self._n = n_readers
