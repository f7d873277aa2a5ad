"""The requests of connected web clients for transforms."""

from __future__ import annotations

from collections.abc import Callable

from ...base.message_fields import size_of
from ...messages import TFMessage
from ..exchange.subscribers import Subscribers
from .contract import Client
from .frame_republisher import FEEDBACK, SOURCES, FrameRepublisher, make_feedback_wrapper
from .outgoing import EncodedMessage
from .readers import WebReaders


class Republications:
    """The requests of clients for transforms.

    Args:
        subscribers: the external subscribers of the bridge.
        readers: the readers of the transforms.
        clock: a function that returns the simulation time [s].
    """

    def __init__(
        self, subscribers: Subscribers, readers: WebReaders, clock: Callable[[], float]
    ) -> None:
        self._subscribers, self._readers, self._clock = subscribers, readers, clock
        self._republisher = FrameRepublisher()
        self._topics: dict[Client, list[str]] = {}

    def begin(self, arguments: object, client: Client, goal: str = "") -> str:
        """Publish transforms for a client; return the topic. Called in the thread of the server.

        For the ``goal`` of an action, they are published as its feedback.

        Raises:
            BadMessage: the request is not valid.
        """
        topic = self._republisher.add_request(arguments, goal).topic
        if client not in self._topics:
            for source in SOURCES:
                self._subscribers.add(source)
        self._topics = {**self._topics, client: [*self._topics.get(client, []), topic]}
        return topic

    def cancel(self, goal: str) -> None:
        """End the request for a goal. Called in the thread of the server."""
        topic = self._republisher.goal_topic(goal)
        if topic is not None:
            self._republisher.withdraw(topic)

    def end(self, client: Client) -> None:
        """End the requests of a client. Called in the thread of the server."""
        for topic in self._topics.get(client, []):
            self._republisher.withdraw(topic)
        if client in self._topics:
            self._topics = {
                other: names for other, names in self._topics.items() if other != client
            }
            for source in SOURCES:
                self._subscribers.remove(source)

    def send(self, topic: str, message: object) -> None:
        """Store a topic's transforms, send the messages due.

        Called in the thread of the simulation.
        """
        if topic not in SOURCES or not self._topics or not isinstance(message, TFMessage):
            return
        self._republisher.store(message)
        for request, frames in self._republisher.due_messages(self._clock()):
            if request.goal:
                wrap = make_feedback_wrapper(request.goal)
                encoded_message = EncodedMessage(FEEDBACK, frames, size_of(frames), wrap=wrap)
                self._readers.post(FEEDBACK, encoded_message)
            else:
                encoded_message = EncodedMessage(request.topic, frames, size_of(frames))
                self._readers.post(request.topic, encoded_message)
