"""The bus as a node of a ROS 2 graph, without an installation of ROS 2.

Endpoints follow the bus: what is published there has a writer, what is read there has a reader, and
services are offered. A camera renders while a reader matches its writer. Messages are encoded
in a thread of their own (``uwsim-ros2-out``), so that the simulation does not wait for it.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from ...bus import Bus, TopicEnds
from ...errors import BadMessage, UwsimError
from ...message_fields import size_of
from ...messages.services import Service
from ..bridge import LATCHED, Bridge
from ..encodings import from_cdr, to_cdr
from ..log import Log
from ..queues import MAX_ITEMS, LatestQueue
from ..stamps import clock_time, inward, outward
from ..types import message_class, ros2_store, wire_service, wire_type
from .names import topic_name, type_hash_data
from .participant import READERS_CHANGED, WRITER_REFUSED, Participant, Writer
from .presence import Presence
from .quality import CLOCK, Quality, quality_of
from .raw_types import RawSample, raw_type
from .service_server import ServiceServer
from .settings import Ros2Settings

NODE = "uwsim"
"""Name of the node."""
LEASE_S = 10.0
"""How long a node may be silent before it counts as gone, as Cyclone DDS has it [s]."""
CLOSE_S = 5.0
"""How long the last messages may take at the end [s]."""


class Ros2(Bridge):
    """Connects a bus to a domain of ROS 2.

    Args:
        bus: of the simulation.
        clock: returns the simulation time [s].
        settings: which domain, and on which network.
        more: configuration of Cyclone DDS by the user, which overrides ours (``CYCLONEDDS_URI``).
        log: where events are reported.

    Raises:
        UwsimError: the domain cannot be joined.
    """

    must_meet = invites = True

    def __init__(
        self,
        bus: Bus,
        clock: Callable[[], float],
        settings: Ros2Settings,
        *,
        more: str = "",
        log: Log | None = None,
    ) -> None:
        super().__init__(bus, clock, log or Log("ros2"))
        self._participant = Participant(settings.domain, settings.configuration(more))
        self._presence = Presence(self._participant, NODE)
        self._writers: dict[str, Writer] = {}
        self._readers: dict[str, Any] = {}
        self._servers: dict[str, ServiceServer] = {}
        self._whole: set[str] = set()
        self._outgoing: LatestQueue[tuple[str, object]] = LatestQueue()
        self._types: dict[type, type[RawSample]] = {}
        self._clock_class = message_class("rosgraph_msgs/Clock")
        self._n_clocks = 0
        self._add_writer(CLOCK, self._clock_class, self._on_clocks)
        self._presence.tell()
        self._thread = threading.Thread(target=self._write, name="uwsim-ros2-out", daemon=True)
        self._thread.start()

    def on_topics(self, topics: Mapping[str, TopicEnds]) -> None:
        """Make writers for what is published on the bus, readers for what is read there."""
        published = {name: ends for name, ends in topics.items() if ends.is_published}
        read = {name: ends for name, ends in topics.items() if ends.is_read}
        for name in sorted(set(self._writers) - set(published) - {CLOCK}):
            self._drop(self._writers.pop(name).entity)
        for name in sorted(set(self._readers) - set(read)):
            self._drop(self._readers.pop(name))
        for name in sorted(set(published) - set(self._writers)):
            self._add_writer(name, published[name].type, _Demand(self, name))
        for name in sorted(set(read) - set(self._readers)):
            self._add_reader(name, read[name].type)
        self._presence.tell()

    def on_services(self, services: Mapping[str, Service]) -> None:
        """Offer the services of the bus."""
        for name in sorted(set(self._servers) - set(services)):
            server = self._servers.pop(name)
            self._presence.remove(server.reader)
            self._presence.remove(server.writer.entity)
            server.close()
        for name in sorted(set(services) - set(self._servers)):
            kind = wire_service(services[name])
            server = ServiceServer(
                self._participant, name, kind, partial(self.request, name), self.log
            )
            self._servers[name] = server
            self._presence.add(readers=(server.reader,), writers=(server.writer.entity,))
        self._presence.tell()

    def send(self, topic: str, message: object) -> None:
        """Queue a message; the oldest are dropped while readers are too slow."""
        if self._outgoing.put((topic, message), size_of(message)):
            self.log.say(
                "readers do not keep up; the oldest messages are dropped", kind="outgoing flood"
            )

    def read_all(self, topic: str) -> None:
        """Read a topic with its history (transient local), which its publishers then must offer.

        A reader without history takes no sample that came before it knew the writer, and a writer
        cannot tell when that is.
        """
        name = topic.lstrip("/")
        self._whole.add(name)
        if name in self._readers:
            self._drop(self._readers.pop(name))
            self._add_reader(name, self._topics[name].type)

    def tick(self) -> None:
        """Tell the time when it is due, and whether the thread of DDS has ended."""
        if self._participant.error is not None:
            self.log.say(f"stopped: {self._participant.error}", kind="stopped")
        super().tick()

    def publish_clock(self) -> None:
        """Publish the time, if anybody reads it."""
        if self._n_clocks:
            self.send(CLOCK, self._clock_class(clock=clock_time(self.clock())))

    @property
    def clock_is_read(self) -> bool:
        """Whether a reader matches the writer of ``/clock``."""
        return self._n_clocks > 0

    def is_fed(self, topic: str) -> bool:
        """Whether a writer outside matches the reader of ``topic``."""
        reader = self._readers.get(topic)
        return reader is not None and len(reader.get_matched_publications()) > 0

    def close(self) -> None:
        """Send what waits, and leave the graph."""
        self.send("", None)
        self._thread.join(timeout=CLOSE_S)
        self._outgoing.close()
        self._participant.close()
        super().close()

    def _on_clocks(self, writer: Any) -> None:
        self._n_clocks = len(writer.get_matched_subscriptions())
        self._next_clock = 0.0

    def _add_writer(self, name: str, type: type, on_readers: Callable[[Any], None]) -> None:
        wire = wire_type(type)
        assert wire is not None
        writer = self._participant.writer(
            topic_name(name),
            self._raw(type),
            quality_of(name),
            user_data=type_hash_data(wire.type_hash),
            events={READERS_CHANGED: on_readers},
        )
        self._writers[name] = writer
        self._presence.add(writers=(writer.entity,))

    def _add_reader(self, name: str, type: type) -> None:
        wire = wire_type(type)
        assert wire is not None
        reader = self._participant.reader(
            topic_name(name),
            self._raw(type),
            Quality(depth=MAX_ITEMS, is_latched=name in (*LATCHED, *self._whole), ignores_own=True),
            partial(self._receive, name, type),
            user_data=type_hash_data(wire.type_hash),
            events={WRITER_REFUSED: partial(self._refuse, name)},
        )
        self._readers[name] = reader
        self._presence.add(readers=(reader,))

    def _raw(self, type: type) -> type[RawSample]:
        if type not in self._types:
            wire = wire_type(type)
            assert wire is not None
            self._types[type] = raw_type(ros2_store(), wire.ros2_name)
        return self._types[type]

    def _drop(self, entity: Any) -> None:
        self._presence.remove(entity)
        self._participant.forget(entity)

    def _receive(self, name: str, type: type, sample: RawSample) -> None:
        try:
            self.put(name, inward(from_cdr(type, sample.data)))
        except BadMessage as error:
            self.log.say(f"/{name}: a message was refused: {error}", kind=f"refused {name}")

    def _refuse(self, name: str, _reader: Any) -> None:
        self.log.say(
            f"/{name}: a publisher offers best effort only; it is not read, as commands must not "
            "be lost: set its reliability to RELIABLE",
            kind=f"best effort {name}",
        )

    def _write(self) -> None:
        """Encode and write until `close`."""
        while (item := self._outgoing.get()) is not None:
            topic, message = item
            writer = self._writers.get(topic)
            if message is None:
                return
            if writer is None:
                continue
            try:
                is_sent = writer.write(bytes(to_cdr(outward(message))))
            except UwsimError as error:
                self.log.say(f"/{topic}: not sent: {error}", kind=f"unsent {topic}")
                continue
            if not is_sent:
                self.log.say(
                    f"/{topic}: a reader does not keep up; messages are dropped",
                    kind=f"behind {topic}",
                )


class _Demand:
    """Tells a bridge how many outside read a topic, from their changing number."""

    def __init__(self, bridge: Bridge, topic: str) -> None:
        self._bridge, self._topic, self._n = bridge, topic, 0

    def __call__(self, writer: Any) -> None:
        n_readers = len(writer.get_matched_subscriptions())
        for _ in range(n_readers - self._n):
            self._bridge.want(self._topic)
        for _ in range(self._n - n_readers):
            self._bridge.unwant(self._topic)
        if n_readers < self._n:
            self._bridge.log.say(
                f"/{self._topic}: a reader has left, or was not heard of for {LEASE_S:g} s",
                kind=f"left {self._topic}",
            )
        self._n = n_readers
