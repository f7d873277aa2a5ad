"""Publishing and reading topics from a program that owns the simulation."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from ...base.terminal import warn
from ...bus import Bus
from ...errors import UnknownName


class TopicAccess:
    """The topics that a program publishes and reads.

    Args:
        bus: the topics of the simulation.
        read: topics to read from the start, if they exist.
    """

    def __init__(self, bus: Bus, read: Iterable[str] = ()) -> None:
        self._bus = bus
        self._published: dict[str, Callable[[Any], None]] = {}
        self._inboxes = {name: bus.inbox(name, object) for name in read if name in bus.topics}

    @property
    def read(self) -> tuple[str, ...]:
        """The topics that are read."""
        return tuple(self._inboxes)

    @property
    def newest(self) -> dict[str, tuple[Any, int | None]]:
        """Topic -> its newest message and the step at which it came; set to go back to a state."""
        return {topic: (box.last, box.last_step) for topic, box in self._inboxes.items()}

    @newest.setter
    def newest(self, newest: dict[str, tuple[Any, int | None]]) -> None:
        for topic, (last, step) in newest.items():
            if topic not in self._inboxes:
                self._inboxes[topic] = self._bus.inbox(topic, object)
            box = self._inboxes[topic]
            box.clear()
            box.last, box.last_step = last, step

    def publish(self, topic: str, message: object) -> None:
        """Publish a message; the first one without a subscriber gives a warning.

        Raises:
            UnknownName: no such topic; names the nearest that has a subscriber.
            BadSetting: the topic carries another type.
            BadMessage: a field of the message has the wrong type or shape.
        """
        name = topic.strip().lstrip("/")
        if name not in self._published:
            absent = self._bus.without_subscriber(name)
            if absent is not None and name not in self._bus.topics:
                read = [each for each in self._bus.topics if self._bus.has_readers(each)]
                raise UnknownName("topic", topic, read)
            publish = self._bus.publisher(name, type(message))
            if absent is not None:
                warn(f"publish({topic!r}): the message has no effect: {absent}")
            self._published[name] = publish
        self._published[name](message)

    def latest(self, topic: str) -> Any:
        """Return the newest message; None before the first.

        Raises:
            UnknownName: no such topic; names the nearest.
        """
        name = topic.strip().lstrip("/")
        if name not in self._inboxes:
            if name not in self._bus.topics:
                raise UnknownName("topic", topic, self._bus.topics)
            before = self._bus.unread(name)
            self._inboxes[name] = self._bus.inbox(name, object)
            if before is not None:
                self._inboxes[name].receive(before, self._bus.step)
        inbox = self._inboxes[name]
        inbox.take()
        return inbox.last
