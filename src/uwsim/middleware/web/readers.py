"""The web clients that read topics, and the sending of messages to them."""

from __future__ import annotations

from ...base.message_fields import size_of
from ...messages import Image
from ...messages.compressed import as_jpeg
from ..bridge import LATCHED
from ..clock_topic import ClockTopic
from ..exchange.subscribers import Subscribers
from .contract import Client, Subscription
from .graph import COMPRESSED_SUFFIX, WebGraph
from .outgoing import EncodedMessage

CLOCK = "clock"
"""The topic of the simulation time."""
Reader = tuple[Client, Subscription]
"""A client, and its subscription to a topic."""


class WebReaders:
    """The subscriptions of all clients, by topic.

    Args:
        graph: the topics of the bus.
        subscribers: the external subscribers of the bridge.
        clock_topic: the publisher of the simulation time, which new subscribers receive at once.
    """

    def __init__(self, graph: WebGraph, subscribers: Subscribers, clock_topic: ClockTopic) -> None:
        self._graph, self._subscribers, self._clock_topic = graph, subscribers, clock_topic
        self._readers: dict[str, tuple[Reader, ...]] = {}
        self._latched: dict[str, EncodedMessage] = {}

    def __contains__(self, topic: str) -> bool:
        """Return whether a client reads a topic. May be called from any thread."""
        return topic in self._readers

    def readers_of(self, topic: str) -> tuple[Reader, ...]:
        """Return the clients that read a topic. May be called from any thread."""
        return self._readers.get(topic, ())

    def add(self, topic: str, client: Client, subscription: Subscription) -> None:
        """Add a subscription of a client. Called in the thread of the server."""
        latched = self._latched.get(topic)
        self._readers[topic] = (*self.readers_of(topic), (client, subscription))
        if latched is not None:
            client.post(subscription, latched)
        if topic == CLOCK:
            self._clock_topic.send_at_next_step()
        else:
            if topic not in self._graph.topics:
                subscription.source = self._graph.image_of(topic) or topic
            self._subscribers.add(subscription.source)

    def remove(self, topic: str, subscription: Subscription) -> None:
        """Remove a subscription of a client. Called in the thread of the server."""
        readers = tuple(entry for entry in self.readers_of(topic) if entry[1] is not subscription)
        if readers:
            self._readers[topic] = readers
        else:
            self._readers.pop(topic, None)
        if topic != CLOCK:
            self._subscribers.remove(subscription.source)

    def send(self, topic: str, message: object) -> None:
        """Send a message to all readers of its topic. Called in the thread of the simulation."""
        is_latched = topic in LATCHED
        if is_latched or topic in self:
            encoded_message = EncodedMessage(topic, message, size_of(message))
            if is_latched:  # first stored, so that a reader added meanwhile receives it, too
                self._latched[topic] = encoded_message
            self.post(topic, encoded_message)
        if isinstance(message, Image) and (image_topic := topic + COMPRESSED_SUFFIX) in self:
            self.post(image_topic, EncodedMessage(image_topic, message, size_of(message), as_jpeg))

    def post(self, topic: str, message: EncodedMessage, *, client_name: str | None = None) -> None:
        """Send a message to the readers of a topic, or to the client of that name.

        May be called from any thread.
        """
        for client, subscription in self.readers_of(topic):
            if client_name is None or client.name == client_name:
                client.post(subscription, message)
