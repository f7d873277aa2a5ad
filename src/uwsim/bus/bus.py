"""The bus: the topics and services between the parts of one process.

A publisher must not change a message afterwards: the arrays of the message become read-only.
Messages are delivered in the order of publishing at the end of the simulation step (`Bus.deliver`).
Messages that a callback publishes are delivered in the same step: computing takes no simulation
time. The parameter ``latency_s`` of an algorithm delays its messages. Services respond at once.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeVar, cast

from ..base.inbox import Inbox
from ..base.message_fields import check_and_freeze, find_invalid_field, freeze
from ..base.record import Record
from ..base.terminal import warn
from ..errors import BadMessage, BadSetting, UwsimError, did_you_mean
from .names import has_exact_type, strip_slash, type_name
from .services import Services
from .topic import Remark, Topic, TopicEndpoints

M = TypeVar("M")
OBSERVERS_REASON = "is for observers of the run"
"""The reason why a topic with the truth or with scores is hidden from algorithms under test."""
MAX_MESSAGES_PER_STEP = 100_000
"""The greatest number of messages delivered in one step; more come from an endless loop."""


def print_remark(topic: str, text: str) -> None:
    """Print the remark of a subscriber on a message."""
    warn(f"/{topic}: {text}")


@dataclass(slots=True)
class BusState(Record):
    """The current step, the messages that are not delivered yet and the latched messages."""

    step: int = 0
    """The current step; set by the owner of the clock."""
    due_now: deque[tuple[str, object]] = field(default_factory=deque)
    """The topic and content of each message that the next `Bus.deliver` delivers."""
    due_later: list[tuple[int, int, str, object]] = field(default_factory=list)
    """The step of delivery, serial number, topic and content of each delayed message."""
    n_delayed: int = 0
    """The number of delayed messages published so far: the last serial number."""
    latched_messages: dict[str, object] = field(default_factory=dict)
    """The newest message of each topic that has a latched inbox, by the topic's name."""


class Bus:
    """The topics and services by name; messages are delivered only by `deliver`.

    Names are compared without a leading slash: ``/uwsim/camera1`` and ``uwsim/camera1`` name the
    same topic, as for a ROS node in the root namespace.
    """

    def __init__(self) -> None:
        self._topics: dict[str, Topic] = {}
        self._hidden_topics: dict[str, str] = {}  # the reason by topic
        self._observers: list[Callable[[str, type], None]] = []
        self._revision = 0
        self.state = BusState()
        """The current step, the messages that are not delivered yet and the latched messages."""
        self.services = Services()
        """The services, which respond at once."""
        self.keeps_unread_messages = True
        """True if messages are made for topics without a subscriber, too, for `unread_message`."""

    @property
    def step(self) -> int:
        """The current step; set by the owner of the clock."""
        return self.state.step

    @step.setter
    def step(self, step: int) -> None:
        self.state.step = step

    def subscribe(
        self,
        topic: str,
        type: type[M],
        callback: Callable[[M], None],
        *,
        check: Callable[[M], None] | None = None,
        remark: Callable[[M], Remark | None] | None = None,
        owner: object = None,
        is_counted: bool = True,
    ) -> Callable[[], None]:
        """Call ``callback`` with every message on ``topic``; return a function that unsubscribes.

        Args:
            topic: the name of the topic.
            type: the class of the messages; ``object`` accepts the type of the other endpoints.
            callback: the function that is called with each message.
            check: a function that is called when a message is published. It raises BadMessage to
                the publisher if the subscriber cannot use the message.
            remark: a function that is called when a message is published. If the subscriber will
                ignore or change the message, it returns a `Remark`; the publisher receives each
                remark once.
            owner: the object that subscribes, so that `endpoints` can leave it out.
            is_counted: False for a subscription that does not count as a subscriber, so that no
                image is rendered for it. It receives the messages that are delivered to others; on
                a topic without a subscriber it receives them when they are published, and must not
                keep them.
        """
        entry = self._open_topic(topic, type)
        if not is_counted:
            entry.uncounted_callbacks.append(callback)
            return lambda: entry.uncounted_callbacks.remove(callback)
        entry.callbacks.append(callback)
        entry.subscribers.append(owner)
        self._revision += 1
        if check is not None:
            entry.checks.append(check)
        if remark is not None:
            entry.remarks.append(remark)

        def unsubscribe() -> None:
            if callback in entry.callbacks:
                del entry.subscribers[entry.callbacks.index(callback)]
                entry.callbacks.remove(callback)
                self._revision += 1
                if check is not None:
                    entry.checks.remove(check)
                if remark is not None:
                    entry.remarks.remove(remark)

        return unsubscribe

    def observe(self, on_topic: Callable[[str, type], None]) -> Callable[[], None]:
        """Call ``on_topic(topic, type)`` for every existing topic now, and for each new one later.

        The names have no leading slash. Returns a function that ends the observation.
        """
        self._observers.append(on_topic)
        for name in sorted(self._topics):
            if (message_type := self._topics[name].type) is not None:
                on_topic(name, message_type)

        def stop() -> None:
            if on_topic in self._observers:
                self._observers.remove(on_topic)

        return stop

    def inbox(
        self, topic: str, type: type[M], *, latched: bool = False, max_messages: int | None = None
    ) -> Inbox[M]:
        """Return an inbox that collects the messages of ``topic`` from now on.

        A ``latched`` inbox begins with the newest message, as a subscriber of a latched topic in
        ROS does. The bus stores this message from the first latched inbox on. An inbox holds at
        most ``max_messages`` messages that were not taken.
        """
        inbox: Inbox[M] = Inbox(max_messages)
        if latched:
            entry = self._open_topic(topic, type)
            name = strip_slash(topic)
            if not entry.is_latched:
                entry.is_latched = True
                entry.callbacks.append(
                    lambda message: self.state.latched_messages.update({name: message})
                )
                entry.subscribers.append(None)
            if (latched_message := self.state.latched_messages.get(name)) is not None:
                inbox.receive(cast("M", latched_message), self.step)
        unsubscribe = self.subscribe(topic, type, lambda message: inbox.receive(message, self.step))
        inbox.set_stop(unsubscribe)
        return inbox

    def endpoints(self, topic: str, *, ignored_owner: object = None) -> TopicEndpoints | None:
        """Return whether a topic has publishers and subscribers; None if it has no type yet.

        The endpoints of ``ignored_owner`` and of observers are not counted.
        """
        entry = self._topics.get(strip_slash(topic))
        return None if entry is None else entry.endpoints(ignored_owner)

    def publisher(
        self,
        topic: str,
        type: type[M],
        *,
        delay_steps: int = 0,
        owner: object = None,
        report: Callable[[str, str], None] = print_remark,
    ) -> Callable[[M], None]:
        """Return ``publish(message)`` for ``topic``, which delivers ``delay_steps`` later.

        ``owner`` is the object that publishes, so that `endpoints` can leave it out.
        ``report(topic, text)`` receives the remarks of subscribers on a message.
        """
        if type is object:
            raise BadSetting(f"Topic {topic!r} is published without a message type.")
        name = strip_slash(topic)
        entry = self._open_topic(topic, type)
        if not any(publisher is owner for publisher in entry.publishers):
            entry.publishers.append(owner)
            self._revision += 1

        state = self.state

        def publish(message: M) -> None:
            if not has_exact_type(message, type):
                type_error = _other_type_text(type, message.__class__)
                raise BadMessage(f"Topic {topic!r} carries {type_name(type)}, {type_error}.")
            if not entry.callbacks:
                entry.unread_message = message
                if entry.uncounted_callbacks and not find_invalid_field(message):
                    for callback in entry.uncounted_callbacks:
                        callback(message)
                return
            if error := check_and_freeze(message):
                raise BadMessage(f"Topic {topic!r} carries {type_name(type)}: {error}.")
            for check in entry.checks:
                check(message)
            for remark in entry.remarks:
                if (text := entry.format_new_remark(remark(message))) is not None:
                    report(name, text)
            if delay_steps:
                state.n_delayed += 1
                state.due_later.append((state.step + delay_steps, state.n_delayed, name, message))
            else:
                state.due_now.append((name, message))

        return publish

    def hide_topic(self, topic: str, reason: str = OBSERVERS_REASON) -> None:
        """Hide a topic from algorithms under test; observers of the run may read it.

        Args:
            topic: the name of the topic.
            reason: the end of the sentence "topic 'x' ..." in errors; the first reason counts.
        """
        self._hidden_topics.setdefault(strip_slash(topic), reason)

    def hidden_reason(self, topic: str) -> str | None:
        """Return why a topic is hidden from algorithms under test; None if it is not."""
        return self._hidden_topics.get(strip_slash(topic))

    def unread_message(self, topic: str) -> object | None:
        """Return the newest message published without a subscriber; None if there is none."""
        entry = self._topics.get(strip_slash(topic))
        if entry is None:
            return None
        make = entry.make_unread_message
        message = entry.unread_message if make is None else make()
        return None if message is None else freeze(message)

    def defer_unread_message(self, topic: str, make: Callable[[], object | None]) -> None:
        """Call ``make`` for the newest message of a topic only when `unread_message` requests it.

        The publisher of the topic then publishes only if the topic has a callback.
        """
        self._topics[strip_slash(topic)].make_unread_message = make

    def make_subscriber_check(self, topic: str) -> Callable[[], bool]:
        """Return a function that returns whether a published topic has a callback."""
        entry = self._topics[strip_slash(topic)]
        return lambda: bool(entry.callbacks or entry.uncounted_callbacks)

    def message_type(self, topic: str) -> type | None:
        """Return the message type of ``topic``; None before its first endpoint with a type."""
        entry = self._topics.get(strip_slash(topic))
        return entry.type if entry else None

    def has_subscribers(self, topic: str) -> bool:
        """Return whether ``topic`` has a subscriber."""
        entry = self._topics.get(strip_slash(topic))
        return bool(entry and entry.callbacks)

    def may_refuse(self, topic: str) -> bool:
        """Return whether a subscriber of ``topic`` checks messages when they are published."""
        entry = self._topics.get(strip_slash(topic))
        return bool(entry and entry.checks)

    def describe_missing_subscriber(self, topic: str) -> str | None:
        """Return a text that suggests a topic with a subscriber; None if ``topic`` has one."""
        subscribed_names = [name for name, entry in self._topics.items() if entry.callbacks]
        return (
            None
            if strip_slash(topic) in subscribed_names
            else f"it has no subscriber.{did_you_mean(topic, subscribed_names)}"
        )

    def describe_missing_publisher(self, topic: str) -> str | None:
        """Return a text that suggests a topic with a publisher; None if ``topic`` has one."""
        published_names = [name for name, entry in self._topics.items() if entry.publishers]
        if strip_slash(topic) in published_names:
            return None
        suggestion = did_you_mean(topic, published_names)
        subscribed_topic = self._topics.get(strip_slash(topic))
        names_of_type = [
            name
            for name in published_names
            if subscribed_topic and self._topics[name].type is subscribed_topic.type
        ]
        if not suggestion and names_of_type:
            suggestion = f" Topics of its type: {', '.join(map(repr, names_of_type[:3]))}."
        return f"it has no publisher.{suggestion}"

    def deliver(self) -> None:
        """Deliver every message that is due at the current step, in the order of publishing."""
        if not self.state.due_now and not self.state.due_later:
            return
        if self.state.due_later:
            entries = self.state.due_later
            due = sorted(entry for entry in entries if entry[0] <= self.step)
            self.state.due_later = [entry for entry in entries if entry[0] > self.step]
            self.state.due_now.extend((topic, message) for _, _, topic, message in due)
        for _ in range(MAX_MESSAGES_PER_STEP):
            if not self.state.due_now:
                return
            topic, message = self.state.due_now.popleft()
            entry = self._topics[topic]
            for callback in (*entry.callbacks, *entry.uncounted_callbacks):
                callback(message)
        raise UwsimError(
            f"More than {MAX_MESSAGES_PER_STEP} messages in one step: two callbacks answer each "
            f"other in a loop, the last on topic {topic!r}."
        )

    @property
    def revision(self) -> int:
        """The number of changes of topics, publishers, subscribers and services."""
        return self._revision + self.services.revision

    @property
    def next_delivery(self) -> float:
        """The step at which `deliver` has a message to deliver; inf if there is none."""
        if self.state.due_now:
            return self.step
        due_later = self.state.due_later
        return min([entry[0] for entry in due_later]) if due_later else math.inf

    @property
    def topics(self) -> dict[str, str]:
        """The message types by topic name, sorted by name."""
        return {name: type_name(self._topics[name].type) for name in sorted(self._topics)}

    def _open_topic(self, topic: str, type: type[M]) -> Topic:
        entry = self._topics.setdefault(strip_slash(topic), Topic())
        if type is object:
            return entry
        if entry.type is None:
            entry.type = type
            for on_topic in list(self._observers):
                on_topic(strip_slash(topic), type)
        elif entry.type is not type:
            other_type = _other_type_text(entry.type, type)
            raise BadSetting(
                f"Topic {topic!r} carries {type_name(entry.type)}, {other_type}.", name=topic
            )
        return entry


def _other_type_text(expected: type, other: type) -> str:
    """Return ``not std_msgs/msg/Bool``, or name the modules of two classes of the same name."""
    if type_name(expected) == type_name(other):
        return f"the class of {expected.__module__}, not that of {other.__module__}"
    return f"not {type_name(other)}"
