"""Publishing and reading of topics by the program that owns a simulation."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from ...base.inbox import Inbox
from ...base.record import ExternalValue, Record, wrong_scene_error
from ...base.terminal import warn
from ...bus import Bus
from ...errors import UnknownName


class NewestMessages(ExternalValue):
    """The newest message of each topic that the program reads, and the step of its delivery.

    Args:
        inboxes: the inbox of each topic, by the name of the topic.
        open_inbox: a function that opens the inbox of a further topic.
    """

    def __init__(
        self, inboxes: dict[str, Inbox[Any]], open_inbox: Callable[[str], Inbox[Any]]
    ) -> None:
        self._inboxes, self._open_inbox = inboxes, open_inbox

    def value(self) -> dict[str, tuple[Any, int | None]]:
        """Return the newest message and the step of its delivery, by topic."""
        return {
            topic: (inbox.last_message, inbox.last_step) for topic, inbox in self._inboxes.items()
        }

    def set(self, value: object) -> None:
        """Set the newest messages; open an inbox for each topic that has none yet."""
        if not isinstance(value, dict):
            raise wrong_scene_error()
        for topic in (topic for topic in self._inboxes if topic not in value):
            self._inboxes[topic].clear()
        for topic, (message, step) in value.items():
            if topic not in self._inboxes:
                self._inboxes[topic] = self._open_inbox(topic)
            inbox = self._inboxes[topic]
            inbox.clear()
            inbox.last_message, inbox.last_step = message, step


@dataclass(slots=True)
class AccessState(Record):
    """The state of a program's access to topics."""

    newest_messages: NewestMessages
    """The newest message of each topic that the program reads."""
    is_started: bool = False
    """True if the samples of step 0 are published."""


class TopicAccess:
    """The topics that a program publishes and reads.

    Args:
        bus: the bus of the simulation.
        topics_read: the names of topics to read from the start, if they exist.
    """

    def __init__(self, bus: Bus, topics_read: Iterable[str] = ()) -> None:
        self._bus = bus
        self._publishers: dict[str, Callable[[Any], None]] = {}
        self._inboxes = {name: self._open_inbox(name) for name in topics_read if name in bus.topics}
        self.state = AccessState(NewestMessages(self._inboxes, self._open_inbox))
        """The state: the newest message of each topic that the program reads."""

    def _open_inbox(self, name: str) -> Inbox[Any]:
        return self._bus.inbox(name, object, max_messages=1)

    @property
    def topics_read(self) -> tuple[str, ...]:
        """The names of the topics that the program reads."""
        return tuple(self._inboxes)

    def publish(self, topic: str, message: object) -> None:
        """Publish a message; the first message on a topic without a subscriber prints a warning.

        Raises:
            UnknownName: there is no such topic; the error message suggests the nearest topic with a
                subscriber.
            BadSetting: the topic carries another type of message.
            BadMessage: a field of the message has the wrong type or shape.
        """
        name = topic.strip().lstrip("/")
        if name not in self._publishers:
            missing_text = self._bus.describe_missing_subscriber(name)
            if missing_text is not None and name not in self._bus.topics:
                topics_read = [
                    topic_name
                    for topic_name in self._bus.topics
                    if self._bus.has_subscribers(topic_name)
                ]
                raise UnknownName("topic", topic, topics_read)
            publish = self._bus.publisher(name, type(message))
            if missing_text is not None:
                warn(f"publish({topic!r}): the message has no effect: {missing_text}")
            self._publishers[name] = publish
        self._publishers[name](message)

    def latest_message(self, topic: str) -> Any:
        """Return the newest message on a topic; None before the first.

        Raises:
            UnknownName: there is no such topic; the error message suggests the nearest name.
        """
        name = topic.strip().lstrip("/")
        if name not in self._inboxes:
            if name not in self._bus.topics:
                raise UnknownName("topic", topic, self._bus.topics)
            unread_message = self._bus.unread_message(name)
            self._inboxes[name] = self._open_inbox(name)
            if unread_message is not None:
                self._inboxes[name].receive(unread_message, self._bus.step)
        inbox = self._inboxes[name]
        inbox.take()
        return inbox.last_message
