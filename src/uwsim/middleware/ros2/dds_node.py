"""A node of ROS 2 on Cyclone DDS (the extra ``ros2``), which needs no installation of ROS 2.

`participant` and `presence` make a DDS participant that ROS 2 recognizes as a node.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from typing import Any, ClassVar

from ...errors import UwsimError
from ..log import Log
from ..types import WireService, ros2_store, wire_type
from .loopback import bind_to_loopback, list_sockets
from .names import topic_name, type_hash_data
from .node import Call, Receive
from .participant import READERS_CHANGED, WRITER_REFUSED, Participant, Writer
from .presence import Presence
from .quality import Quality
from .raw_types import RawSample, raw_type
from .senders import Senders
from .service_server import ServiceServer
from .settings import NODE, Ros2Settings


class DdsNode:
    """A node on Cyclone DDS.

    Args:
        settings: the domain and the network interfaces.
        log: the log for events.
        user_xml: the user's settings of Cyclone DDS (``CYCLONEDDS_URI``), which overrides ours.

    Raises:
        UwsimError: the domain cannot be joined.
    """

    lease: ClassVar[str] = "for 10 s"
    """The time after which a silent node counts as gone: the default of Cyclone DDS."""

    def __init__(self, settings: Ros2Settings, log: Log, *, user_xml: str = "") -> None:
        self._log = log
        old_sockets = list_sockets()
        self._participant = Participant(settings.domain, settings.configuration(user_xml))
        is_local = settings.is_local and not settings.static_peers and not user_xml
        self.is_isolated = is_local and bind_to_loopback(old_sockets)
        """True if other computers cannot reach the node."""
        self._presence = Presence(self._participant, NODE)
        self._types: dict[type, type[RawSample]] = {}

    @property
    def error(self) -> BaseException | None:
        """The error that ended the thread of the node; None if it runs."""
        return self._participant.error

    def writer(
        self, topic: str, type: type, quality: Quality, on_readers: Callable[[int], None]
    ) -> DdsWriter:
        """Make a writer; ``on_readers`` is called with the number of its readers."""

        def count_readers(entity: Any) -> None:
            on_readers(len(entity.get_matched_subscriptions()))

        kind, user_data = self._sample_type(type)
        events = {READERS_CHANGED: count_readers}
        writer = self._participant.writer(
            topic_name(topic), kind, quality, user_data=user_data, events=events
        )
        self._presence.add(writers=(writer.entity,))
        return DdsWriter(self, writer)

    def reader(
        self,
        topic: str,
        type: type,
        quality: Quality,
        receive: Receive,
        on_refused: Callable[[], None],
    ) -> DdsReader:
        """Make a reader; ``on_refused`` is called for a writer with an insufficient quality."""
        kind, user_data = self._sample_type(type)
        senders = Senders()
        entity = self._participant.reader(
            topic_name(topic),
            kind,
            quality,
            lambda sample: receive(sample.data, senders.sender_of(entity, sample)),
            user_data=user_data,
            events={WRITER_REFUSED: lambda _: on_refused()},
        )
        self._presence.add(readers=(entity,))
        return DdsReader(self, entity)

    def server(self, name: str, kind: WireService, call: Call) -> DdsServer:
        """Offer a service to nodes of Cyclone DDS."""
        server = ServiceServer(self._participant, name, kind, call, self._log)
        self._presence.add(readers=(server.reader,), writers=(server.writer.entity,))
        return DdsServer(self._presence, server)

    def announce_endpoints(self) -> None:
        """Announce the endpoints of the node."""
        self._presence.announce_endpoints()

    def offers(self, name: str) -> bool:
        """Return False: services of other nodes are not called, as DDS vendors differ in them."""
        return False

    def call(self, name: str, request: object) -> Future[object]:
        """Raise UwsimError: services of other nodes are not called."""
        raise UwsimError(f"Service /{name}: without rclpy, services of nodes are not called.")

    def publishers(self, topic: str) -> list[str]:
        """Return an empty list: the names of other nodes are not read."""
        return []

    def close(self) -> None:
        """Leave the domain."""
        self._participant.close()

    def drop(self, entity: Any) -> None:
        """Remove an endpoint from the graph."""
        self._presence.remove(entity)
        self._participant.forget(entity)

    def _sample_type(self, type: type) -> tuple[type[RawSample], bytes]:
        """Return the DDS type of a message class, and the USER_DATA with the hash of the type."""
        wire = wire_type(type)
        assert wire is not None
        if type not in self._types:
            self._types[type] = raw_type(ros2_store(), wire.ros2_name)
        return self._types[type], type_hash_data(wire.type_hash)


class DdsReader:
    """A reader on the graph."""

    def __init__(self, node: DdsNode, entity: Any) -> None:
        self._node, self._entity = node, entity

    @property
    def n_writers(self) -> int:
        """The number of writers that match the reader."""
        return len(self._entity.get_matched_publications())

    def close(self) -> None:
        """Remove the reader from the graph."""
        self._node.drop(self._entity)


class DdsWriter:
    """A writer on the graph."""

    def __init__(self, node: DdsNode, writer: Writer) -> None:
        self._node, self._writer = node, writer

    def write(self, data: bytes) -> bool:
        """Write a message; return whether it was accepted."""
        return self._writer.write(data)

    def close(self) -> None:
        """Remove the writer from the graph."""
        self._node.drop(self._writer.entity)


class DdsServer:
    """A service on the graph."""

    def __init__(self, presence: Presence, server: ServiceServer) -> None:
        self._presence, self._server = presence, server

    def close(self) -> None:
        """Withdraw the service."""
        self._presence.remove(self._server.reader)
        self._presence.remove(self._server.writer.entity)
        self._server.close()
