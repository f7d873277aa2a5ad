"""Topics inside the process, with their services.

A published message is given away: its arrays become read-only and it is delivered, in the order
of publishing, when the simulation reaches the end of its step (`Bus.deliver`). What a callback
publishes in turn is delivered in the same step: computing takes no simulation time. A parameter
``latency_s`` of an algorithm delays all that it publishes. Services answer at once.
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
from .names import is_exactly, type_name, without_slash
from .services import Services
from .topic import Remark, Topic, TopicEnds

M = TypeVar("M")
MAX_MESSAGES_PER_STEP = 100_000


def say_on_standard_error(topic: str, text: str) -> None:
    """Print what a subscriber has to say about a message."""
    warn(f"/{topic}: {text}")


@dataclass(slots=True)
class BusState(Record):
    """What is on its way, and when."""

    step: int = 0
    """The current step; set by the owner of the clock."""
    due_now: deque[tuple[str, object]] = field(default_factory=deque)
    """The topic and message of all that is delivered next."""
    due_later: list[tuple[int, int, str, object]] = field(default_factory=list)
    """The step, number, topic and message of all that is delivered at a later step."""
    n_posted: int = 0
    """The messages for a later step so far."""
    kept: dict[str, object] = field(default_factory=dict)
    """The newest message of each topic that a latched inbox has asked for."""


class Bus:
    """Named topics and services; delivery only when `deliver` is called.

    Topic and service names are compared without a leading slash, so ``/uwsim/camera1`` and
    ``uwsim/camera1`` are one, as they are for a ROS node in the root namespace.
    """

    def __init__(self) -> None:
        self._topics: dict[str, Topic] = {}
        self._withheld: set[str] = set()
        self._observers: list[Callable[[str, type], None]] = []
        self._revision = 0
        self.state = BusState()
        """What is on its way, and when."""
        self.services = Services()
        """Those offered; they answer at once."""
        self.keeps_unread = True
        """Whether somebody may ask for `unread`; else nobody needs what has no subscriber."""

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
        counts: bool = True,
    ) -> Callable[[], None]:
        """Call ``callback`` with every message on ``topic``; returns the way to stop it.

        ``check`` is called while a message is published, and raises BadMessage to its sender if
        the reader could do nothing with it. ``remark`` is called then, too, and returns what is odd
        about a message that is taken all the same, or passed over: what was found, and what was
        expected. The publisher is told, once for each of what was expected.

        ``object`` as the type stands for any: such a reader hears whatever the topic carries, and
        leaves it to others to say what that is. ``owner`` is who reads, for `ends`.

        One that does not count (``counts``) changes nothing for anyone: for it alone nothing is
        drawn. It hears what others read when it is delivered, and what nobody reads while it is
        published; it must not keep the message, which stays its sender's.
        """
        entry = self._typed(topic, type)
        if not counts:
            entry.hearers.append(callback)
            return lambda: entry.hearers.remove(callback)
        entry.readers.append(callback)
        entry.owners.append(owner)
        self._revision += 1
        if check is not None:
            entry.checks.append(check)
        if remark is not None:
            entry.remarks.append(remark)

        def stop() -> None:
            if callback in entry.readers:
                del entry.owners[entry.readers.index(callback)]
                entry.readers.remove(callback)
                self._revision += 1
                if check is not None:
                    entry.checks.remove(check)
                if remark is not None:
                    entry.remarks.remove(remark)

        return stop

    def observe(self, appeared: Callable[[str, type], None]) -> Callable[[], None]:
        """Call ``appeared(topic, type)`` for every topic, now and when a new one comes.

        Returns the way to stop it. The topic has no leading slash.
        """
        self._observers.append(appeared)
        for name in sorted(self._topics):
            if (known := self._topics[name].type) is not None:
                appeared(name, known)

        def stop() -> None:
            if appeared in self._observers:
                self._observers.remove(appeared)

        return stop

    def inbox(
        self, topic: str, type: type[M], *, latched: bool = False, max_messages: int | None = None
    ) -> Inbox[M]:
        """Return an inbox that collects the messages of ``topic`` from now on.

        A ``latched`` one begins with the newest message there was, as a subscriber of ROS does on
        a latched topic. The bus keeps that message from the first time it is asked so. What is not
        taken out is kept, ``max_messages`` messages at most.
        """
        inbox: Inbox[M] = Inbox(max_messages)
        if latched:
            entry = self._typed(topic, type)
            name = without_slash(topic)
            if not entry.is_kept:
                entry.is_kept = True
                entry.readers.append(lambda message: self.state.kept.update({name: message}))
                entry.owners.append(None)
            if (newest := self.state.kept.get(name)) is not None:
                inbox.receive(cast("M", newest), self.step)
        stop = self.subscribe(topic, type, lambda message: inbox.receive(message, self.step))
        inbox.set_stop(stop)
        return inbox

    def ends(self, topic: str, *, besides: object = None) -> TopicEnds | None:
        """Who is at the ends of a topic, one owner and observers left out; None without a type."""
        entry = self._topics.get(without_slash(topic))
        return None if entry is None else entry.ends(besides)

    def publisher(
        self,
        topic: str,
        type: type[M],
        *,
        delay_steps: int = 0,
        owner: object = None,
        say: Callable[[str, str], None] = say_on_standard_error,
    ) -> Callable[[M], None]:
        """Return ``publish(message)`` for ``topic``, delayed by ``delay_steps``.

        ``owner`` is who publishes, for `ends`. ``say(topic, text)`` tells what subscribers have to
        remark on a message.
        """
        if type is object:
            raise BadSetting(f"Topic {topic!r} is published without a message type.")
        name = without_slash(topic)
        entry = self._typed(topic, type)
        if not any(each is owner for each in entry.writers):
            entry.writers.append(owner)
            self._revision += 1

        state = self.state

        def publish(message: M) -> None:
            if not is_exactly(message, type):
                wrong_class = _but_not(type, message.__class__)
                raise BadMessage(f"Topic {topic!r} carries {type_name(type)}, {wrong_class}.")
            if not entry.readers:
                entry.unread = message
                if entry.hearers and not find_invalid_field(message):
                    for hear in entry.hearers:
                        hear(message)
                return
            if wrong := check_and_freeze(message):
                raise BadMessage(f"Topic {topic!r} carries {type_name(type)}: {wrong}.")
            for check in entry.checks:
                check(message)
            for remark in entry.remarks:
                if (text := entry.said_once(remark(message))) is not None:
                    say(name, text)
            if delay_steps:
                state.n_posted += 1
                state.due_later.append((state.step + delay_steps, state.n_posted, name, message))
            else:
                state.due_now.append((name, message))

        return publish

    def withhold(self, topic: str) -> None:
        """Hide a topic from algorithms under test; observers of the run may read it."""
        self._withheld.add(without_slash(topic))

    def is_withheld(self, topic: str) -> bool:
        """Whether a topic is hidden from algorithms under test."""
        return without_slash(topic) in self._withheld

    def unread(self, topic: str) -> object | None:
        """Return the newest message that was published while the topic had no subscriber."""
        entry = self._topics.get(without_slash(topic))
        if entry is None:
            return None
        newest = entry.unread if entry.make_unread is None else entry.make_unread()
        return None if newest is None else freeze(newest)

    def defer_unread(self, topic: str, make: Callable[[], object | None]) -> None:
        """Have the newest message of a topic made when `unread` asks for it.

        Who publishes on the topic then does so only while somebody reads or hears it.
        """
        self._topics[without_slash(topic)].make_unread = make

    def reader_check(self, topic: str) -> Callable[[], bool]:
        """Return what says whether somebody reads or hears a topic that is published."""
        entry = self._topics[without_slash(topic)]
        return lambda: bool(entry.readers or entry.hearers)

    def message_type(self, topic: str) -> type | None:
        """The message type of ``topic``; None before the first reader or writer."""
        entry = self._topics.get(without_slash(topic))
        return entry.type if entry else None

    def has_readers(self, topic: str) -> bool:
        """Whether ``topic`` has a subscriber."""
        entry = self._topics.get(without_slash(topic))
        return bool(entry and entry.readers)

    def may_refuse(self, topic: str) -> bool:
        """Whether a subscriber of ``topic`` refuses some messages of its type while published."""
        entry = self._topics.get(without_slash(topic))
        return bool(entry and entry.checks)

    def without_subscriber(self, topic: str) -> str | None:
        """Report that a topic has no subscriber, with the nearest that has; None if it has one."""
        read = [name for name, entry in self._topics.items() if entry.readers]
        return (
            None
            if without_slash(topic) in read
            else f"it has no subscriber.{did_you_mean(topic, read)}"
        )

    def without_publisher(self, topic: str) -> str | None:
        """Report that a topic has no publisher, with the nearest that has; None if it has one."""
        published = [name for name, entry in self._topics.items() if entry.writers]
        if without_slash(topic) in published:
            return None
        near = did_you_mean(topic, published)
        read = self._topics.get(without_slash(topic))
        alike = [name for name in published if read and self._topics[name].type is read.type]
        if not near and alike:
            near = f" Of its type there is {' and '.join(map(repr, alike[:3]))}."
        return f"it has no publisher.{near}"

    def deliver(self) -> None:
        """Deliver every message that is due at the current step, in the order of publishing."""
        if not self.state.due_now and not self.state.due_later:
            return
        if self.state.due_later:
            due = sorted(post for post in self.state.due_later if post[0] <= self.step)
            self.state.due_later = [post for post in self.state.due_later if post[0] > self.step]
            self.state.due_now.extend((topic, message) for _, _, topic, message in due)
        for _ in range(MAX_MESSAGES_PER_STEP):
            if not self.state.due_now:
                return
            topic, message = self.state.due_now.popleft()
            entry = self._topics[topic]
            for reader in (*entry.readers, *entry.hearers):
                reader(message)
        raise UwsimError(
            f"More than {MAX_MESSAGES_PER_STEP} messages in one step: two callbacks answer each "
            f"other without end, the last on topic {topic!r}."
        )

    @property
    def revision(self) -> int:
        """Grows when a topic, a publisher, a subscriber or a service comes or goes."""
        return self._revision + self.services.revision

    @property
    def next_delivery(self) -> float:
        """The step at which `deliver` has something to hand out; inf where nothing waits."""
        if self.state.due_now:
            return self.step
        later = self.state.due_later
        return min([post[0] for post in later]) if later else math.inf

    @property
    def topics(self) -> dict[str, str]:
        """Topic name -> message type, sorted by name."""
        return {name: type_name(self._topics[name].type) for name in sorted(self._topics)}

    def _typed(self, topic: str, type: type[M]) -> Topic:
        entry = self._topics.setdefault(without_slash(topic), Topic())
        if type is object:
            return entry
        if entry.type is None:
            entry.type = type
            for appeared in list(self._observers):
                appeared(without_slash(topic), type)
        elif entry.type is not type:
            raise BadSetting(
                f"Topic {topic!r} carries {type_name(entry.type)}, {_but_not(entry.type, type)}.",
                name=topic,
            )
        return entry


def _but_not(expected: type, found: type) -> str:
    """``not std_msgs/msg/Bool``, or that it is another class of the same name."""
    if type_name(expected) == type_name(found):
        return f"the class of {expected.__module__}, not that of {found.__module__}"
    return f"not {type_name(found)}"
