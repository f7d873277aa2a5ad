"""What there is to ask about: topics, services and clients of a WebSocket server."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping

from ...bus import TopicEndpoints
from ...errors import UnknownName
from ...messages import CompressedImage, Image
from ...messages.services import Service
from ..types import wire_type
from .contract import Client

COMPRESSED = "/compressed"
"""The end of the topic that carries the images of another topic as JPEG."""


class WebGraph:
    """Topics and services of a bus, and the clients that use them. Any thread.

    Args:
        clock: returns the simulation time [s].
        clients: those that are connected.
    """

    def __init__(self, clock: Callable[[], float], clients: Collection[Client]) -> None:
        self.clock, self._clients = clock, clients
        self.topics: Mapping[str, TopicEndpoints] = {}
        """Topics of the bus, and who is at their ends; replaced as a whole."""
        self.services: Mapping[str, Service] = {}
        """Services of the bus; replaced as a whole."""

    def type_of(self, topic: str) -> type | None:
        """The class of the messages of a topic; None if it is not known."""
        ends = self.topics.get(topic)
        if ends is None and self.image_of(topic) is not None:
            return CompressedImage
        return None if ends is None else ends.type

    def types(self) -> dict[str, str]:
        """Topic -> name of its type in ROS 2, sorted by topic."""
        found = {}
        for name in sorted(self.topics):
            wire = wire_type(self.topics[name].type)
            if wire is not None:
                found[name] = wire.ros2_name
            derived = name + COMPRESSED
            if derived not in self.topics and self.image_of(derived) is not None:
                found[derived] = CompressedImage.__msgtype__
        return found

    def image_of(self, topic: str) -> str | None:
        """The published images that a topic of compressed images is made of; None if none."""
        source = topic.removesuffix(COMPRESSED)
        ends = self.topics.get(source) if source != topic else None
        return source if ends and ends.type is Image and ends.is_published else None

    def is_published(self, topic: str) -> bool:
        """Whether anybody publishes a topic."""
        ends = self.topics.get(topic)
        return self.image_of(topic) is not None or (ends is not None and ends.is_published)

    def is_subscribed(self, topic: str) -> bool:
        """Whether anybody in the simulation reads a topic."""
        ends = self.topics.get(topic)
        return ends is not None and ends.is_read

    def clients_publishing(self, topic: str) -> list[str]:
        """The names of the clients that have advertised a topic, as names of nodes."""
        found = [each.name for each in tuple(self._clients) if each.advertises(topic)]
        return sorted(map(_node_name, found))

    def clients_reading(self, topic: str) -> list[str]:
        """The names of the clients that have subscribed to a topic, as names of nodes."""
        found = [each.name for each in tuple(self._clients) if each.reads(topic)]
        return sorted(map(_node_name, found))

    def service_named(self, name: str) -> Service:
        """Return the type of a service of the bus; UnknownName if it is not there."""
        if name not in self.services:
            raise UnknownName("service", f"/{name}", [f"/{each}" for each in self.services])
        return self.services[name]


def _node_name(client: str) -> str:
    """The name of a client as the name of a node: ``/client_127_0_0_1_40312``."""
    return "/" + re.sub(r"[^A-Za-z0-9_]", "_", client)
