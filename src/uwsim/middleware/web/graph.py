"""The topics, services and clients of a WebSocket server, which clients can query."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping

from ...bus import TopicEndpoints
from ...errors import UnknownName
from ...messages import CompressedImage, Image
from ...messages.services import Service
from ..types import wire_type
from .contract import Client

COMPRESSED_SUFFIX = "/compressed"
"""The suffix of the topic that carries the images of another topic as JPEG."""


class WebGraph:
    """The topics and services of a bus, and the clients that use them, for any thread.

    Args:
        clock: a function that returns the simulation time [s].
        clients: the connected clients.
        hidden_reason: a function that returns why a topic is hidden from clients; None if it is
            not.
    """

    def __init__(
        self,
        clock: Callable[[], float],
        clients: Collection[Client],
        hidden_reason: Callable[[str], str | None],
    ) -> None:
        self.clock, self._clients, self.hidden_reason = clock, clients, hidden_reason
        self.topics: Mapping[str, TopicEndpoints] = {}
        """The endpoints of each topic of the bus; the mapping is replaced as a whole."""
        self.services: Mapping[str, Service] = {}
        """The type of each service of the bus; the mapping is replaced as a whole."""

    def type_of(self, topic: str) -> type | None:
        """Return the class of the messages of a topic; None if it is not known."""
        endpoints = self.topics.get(topic)
        if endpoints is None and self.image_of(topic) is not None:
            return CompressedImage
        return None if endpoints is None else endpoints.type

    def types(self) -> dict[str, str]:
        """Return the name of each topic's type in ROS 2, sorted by topic."""
        type_names = {}
        for name in sorted(self.topics):
            wire = wire_type(self.topics[name].type)
            if wire is not None:
                type_names[name] = wire.ros2_name
            image_topic = name + COMPRESSED_SUFFIX
            if image_topic not in self.topics and self.image_of(image_topic) is not None:
                type_names[image_topic] = CompressedImage.__msgtype__
        return type_names

    def image_of(self, topic: str) -> str | None:
        """Return the topic whose images ``topic`` carries compressed; None if there is none."""
        source = topic.removesuffix(COMPRESSED_SUFFIX)
        endpoints = self.topics.get(source) if source != topic else None
        has_images = endpoints is not None and endpoints.type is Image and endpoints.is_published
        return source if has_images else None

    def is_published(self, topic: str) -> bool:
        """Return whether a topic is published."""
        endpoints = self.topics.get(topic)
        is_on_bus = endpoints is not None and endpoints.is_published
        return is_on_bus or self.image_of(topic) is not None

    def is_subscribed(self, topic: str) -> bool:
        """Return whether the simulation subscribes to a topic."""
        endpoints = self.topics.get(topic)
        return endpoints is not None and endpoints.is_read

    def clients_publishing(self, topic: str) -> list[str]:
        """Return the clients that have advertised a topic, as names of nodes."""
        names = [client.name for client in tuple(self._clients) if client.has_advertised(topic)]
        return sorted(map(_node_name, names))

    def clients_reading(self, topic: str) -> list[str]:
        """Return the clients that have subscribed to a topic, as names of nodes."""
        names = [client.name for client in tuple(self._clients) if client.has_subscribed(topic)]
        return sorted(map(_node_name, names))

    def find_service(self, name: str) -> Service:
        """Return the type of a service of the bus; raise UnknownName if there is none."""
        if name not in self.services:
            raise UnknownName("service", f"/{name}", [f"/{service}" for service in self.services])
        return self.services[name]


def _node_name(client: str) -> str:
    """Return the name of a node for a client: ``/client_127_0_0_1_40312``."""
    return "/" + re.sub(r"[^A-Za-z0-9_]", "_", client)
