"""Publishing and reading topics from a program that owns the simulation."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from ...base.inbox import Inbox
from ...base.record import ExternalValue, Record, wrong_scene_error
from ...base.terminal import warn
from ...bus import Bus
from ...errors import UnknownName


class Newest(ExternalValue):
    """The newest message of each topic that is read, and the step at which it came.

    Args:
        inboxes: the inbox of each topic.
        open_inbox: opens that of another topic.
    """

    def __init__(
        self, inboxes: dict[str, Inbox[Any]], open_inbox: Callable[[str], Inbox[Any]]
    ) -> None:
        self._inboxes, self._open_inbox = inboxes, open_inbox

    def value(self) -> dict[str, tuple[Any, int | None]]:
        """Return topic -> its newest message and the step at which it came."""
        return {topic: (box.last_message, box.last_step) for topic, box in self._inboxes.items()}

    def set(self, value: object) -> None:
        """Set the newest messages; topics that are not read yet are read from now on."""
        if not isinstance(value, dict):
            raise wrong_scene_error()
        for topic in (topic for topic in self._inboxes if topic not in value):
            self._inboxes[topic].clear()
        for topic, (last, step) in value.items():
            if topic not in self._inboxes:
                self._inboxes[topic] = self._open_inbox(topic)
            box = self._inboxes[topic]
            box.clear()
            box.last_message, box.last_step = last, step


@dataclass(slots=True)
class AccessState(Record):
    """What a program has read."""

    newest: Newest
    """The newest message of each topic that is read."""
    is_started: bool = False
    """Whether the first samples, at step 0, are published."""


class TopicAccess:
    """The topics that a program publishes and reads.

    Args:
        bus: the topics of the simulation.
        read: topics to read from the start, if they exist.
    """

    def __init__(self, bus: Bus, read: Iterable[str] = ()) -> None:
        self._bus = bus
        self._published: dict[str, Callable[[Any], None]] = {}
        self._inboxes = {name: self._opened(name) for name in read if name in bus.topics}
        self.state = AccessState(Newest(self._inboxes, self._opened))
        """What it has read."""

    def _opened(self, name: str) -> Inbox[Any]:
        return self._bus.inbox(name, object, max_messages=1)

    @property
    def read(self) -> tuple[str, ...]:
        """The topics that are read."""
        return tuple(self._inboxes)

    def publish(self, topic: str, message: object) -> None:
        """Publish a message; the first one without a subscriber gives a warning.

        Raises:
            UnknownName: no such topic; names the nearest that has a subscriber.
            BadSetting: the topic carries another type.
            BadMessage: a field of the message has the wrong type or shape.
        """
        name = topic.strip().lstrip("/")
        if name not in self._published:
            absent = self._bus.describe_missing_subscriber(name)
            if absent is not None and name not in self._bus.topics:
                read = [each for each in self._bus.topics if self._bus.has_subscribers(each)]
                raise UnknownName("topic", topic, read)
            publish = self._bus.publisher(name, type(message))
            if absent is not None:
                warn(f"publish({topic!r}): the message has no effect: {absent}")
            self._published[name] = publish
        self._published[name](message)

    def latest_message(self, topic: str) -> Any:
        """Return the newest message; None before the first.

        Raises:
            UnknownName: no such topic; names the nearest.
        """
        name = topic.strip().lstrip("/")
        if name not in self._inboxes:
            if name not in self._bus.topics:
                raise UnknownName("topic", topic, self._bus.topics)
            before = self._bus.unread_message(name)
            self._inboxes[name] = self._opened(name)
            if before is not None:
                self._inboxes[name].receive(before, self._bus.step)
        inbox = self._inboxes[name]
        inbox.take()
        return inbox.last_message
