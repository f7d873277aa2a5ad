"""Clients that read topics, and what they are sent."""

from __future__ import annotations

from ...base.message_fields import size_of
from ...messages import Image
from ...messages.compressed import as_jpeg
from ..bridge import LATCHED
from ..clock_topic import ClockTopic
from ..exchange.external_subscribers import ExternalSubscribers
from .contract import Client, Subscription
from .graph import COMPRESSED, WebGraph
from .outgoing import Outgoing

CLOCK = "clock"
Reader = tuple[Client, Subscription]


class WebReaders:
    """The subscriptions of all clients, by topic.

    Args:
        graph: topics of the bus.
        demand: told which of them are read.
        clock_topic: sent to who has come.
    """

    def __init__(
        self, graph: WebGraph, external_subscribers: ExternalSubscribers, clock_topic: ClockTopic
    ) -> None:
        self._graph, self._external_subscribers, self._clock_topic = (
            graph,
            external_subscribers,
            clock_topic,
        )
        self._readers: dict[str, tuple[Reader, ...]] = {}
        self._latched: dict[str, Outgoing] = {}

    def __contains__(self, topic: str) -> bool:
        """Whether a client reads a topic. Any thread."""
        return topic in self._readers

    def of(self, topic: str) -> tuple[Reader, ...]:
        """The clients that read a topic. Any thread."""
        return self._readers.get(topic, ())

    def read(self, topic: str, client: Client, subscription: Subscription) -> None:
        """A client subscribes. In the thread of the server."""
        latched = self._latched.get(topic)
        self._readers[topic] = (*self.of(topic), (client, subscription))
        if latched is not None:
            client.post(subscription, latched)
        if topic == CLOCK:
            self._clock_topic.send_at_next_step()
        else:
            if topic not in self._graph.topics:
                subscription.source = self._graph.image_of(topic) or topic
            self._external_subscribers.add(subscription.source)

    def unread(self, topic: str, subscription: Subscription) -> None:
        """A client does so no more. In the thread of the server."""
        left = tuple(each for each in self.of(topic) if each[1] is not subscription)
        if left:
            self._readers[topic] = left
        else:
            self._readers.pop(topic, None)
        if topic != CLOCK:
            self._external_subscribers.remove(subscription.source)

    def send(self, topic: str, message: object) -> None:
        """Give a message to all who read its topic. In the thread of the simulation."""
        is_latched = topic in LATCHED
        if is_latched or topic in self:
            outgoing = Outgoing(topic, message, size_of(message))
            if is_latched:  # before the readers are looked at: who comes meanwhile finds it here
                self._latched[topic] = outgoing
            self.post(topic, outgoing)
        if isinstance(message, Image) and (derived := topic + COMPRESSED) in self:
            self.post(derived, Outgoing(derived, message, size_of(message), as_jpeg))

    def post(self, topic: str, outgoing: Outgoing, *, only: str | None = None) -> None:
        """Give what is sent on a topic to its readers, or to the one named ``only``. Any thread."""
        for client, subscription in self.of(topic):
            if only is None or client.name == only:
                client.post(subscription, outgoing)
