"""Transforms that web clients have asked for, as long as these are there."""

from __future__ import annotations

from collections.abc import Callable

from ...base.message_fields import size_of
from ...messages import TFMessage
from ..exchange.external_subscribers import ExternalSubscribers
from .contract import Client
from .frame_republisher import FEEDBACK, SOURCES, FrameRepublisher, feedback
from .outgoing import Outgoing
from .readers import WebReaders


class Republications:
    """Which client has asked for which transforms.

    Args:
        demand: told that the topics of transforms are read.
        readers: who are sent them.
        clock: returns the simulation time [s].
    """

    def __init__(
        self,
        external_subscribers: ExternalSubscribers,
        readers: WebReaders,
        clock: Callable[[], float],
    ) -> None:
        self._external_subscribers, self._readers, self._clock = (
            external_subscribers,
            readers,
            clock,
        )
        self._republisher = FrameRepublisher()
        self._topics: dict[Client, list[str]] = {}

    def begin(self, arguments: object, client: Client, goal: str = "") -> str:
        """Publish transforms for a client; returns the topic. In the thread of the server.

        For a goal they are published as its feedback.

        Raises:
            BadMessage: the request is not valid.
        """
        topic = self._republisher.request(arguments, goal).topic
        if client not in self._topics:
            for source in SOURCES:
                self._external_subscribers.add(source)
        self._topics = {**self._topics, client: [*self._topics.get(client, []), topic]}
        return topic

    def cancel(self, goal: str) -> None:
        """End the transforms for a goal. In the thread of the server."""
        topic = self._republisher.goal_topic(goal)
        if topic is not None:
            self._republisher.withdraw(topic)

    def end(self, client: Client) -> None:
        """Publish no more transforms for a client. In the thread of the server."""
        for topic in self._topics.get(client, []):
            self._republisher.withdraw(topic)
        if client in self._topics:
            self._topics = {each: mine for each, mine in self._topics.items() if each != client}
            for source in SOURCES:
                self._external_subscribers.remove(source)

    def send(self, topic: str, message: object) -> None:
        """Take transforms of a topic, and send what is due. In the thread of the simulation."""
        if topic not in SOURCES or not self._topics or not isinstance(message, TFMessage):
            return
        self._republisher.take(message)
        for request, frames in self._republisher.due(self._clock()):
            if request.goal:
                wrap = feedback(request.goal)
                outgoing = Outgoing(FEEDBACK, frames, size_of(frames), wrap=wrap)
                self._readers.post(FEEDBACK, outgoing)
            else:
                outgoing = Outgoing(request.topic, frames, size_of(frames))
                self._readers.post(request.topic, outgoing)
