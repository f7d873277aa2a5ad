"""Topics and services inside the process, and the interface through which an algorithm uses them.

A published message is given away: its arrays become read-only and it is delivered, in the order
of publishing, when the simulation reaches the end of its step (`Bus.deliver`). What a callback
publishes in turn is delivered in the same step: computing takes no simulation time. A parameter
``latency_s`` of an algorithm delays all that it publishes. Services answer at once.
"""

from __future__ import annotations

import dataclasses
import math
from collections import deque
from collections.abc import Callable, Mapping
from typing import Any, Protocol, TypeVar, runtime_checkable

import numpy as np

from .errors import BadMessage, BadSetting, UnknownName, UwsimError, did_you_mean
from .inbox import Inbox
from .message_fields import freeze, unfit

M = TypeVar("M")
MAX_MESSAGES_PER_STEP = 100_000


@runtime_checkable
class Node(Protocol):
    """The interface of an algorithm under test: topics, services, timers, parameters."""

    @property
    def now(self) -> float:
        """Simulation time [s]."""

    @property
    def parameters(self) -> Mapping[str, float | str]:
        """The values of ``--set algorithm.name=value``; the algorithm has its own defaults."""

    @property
    def random(self) -> np.random.Generator:
        """The algorithm's own random stream, repeatable under the run's seed."""

    def subscribe(self, topic: str, type: type[M], callback: Callable[[M], None]) -> None:
        """Have ``callback`` called with every message on ``topic``."""

    def publisher(self, topic: str, type: type[M]) -> Callable[[M], None]:
        """Return ``publish(message)`` for ``topic``."""

    def serve(self, name: str, type: type[M], handler: Callable[[M], object]) -> None:
        """Offer a service; ``type`` is the class of its request."""

    def call(self, name: str, request: object) -> object:
        """Call a service and return its response; UnknownName if it is not offered."""

    def every(self, period_s: float, callback: Callable[[], None]) -> None:
        """Have ``callback`` called every ``period_s`` of simulation time, from now on."""


class Algorithm(Protocol):
    """A program under test: it is started once; from then on its callbacks are called."""

    def start(self, node: Node) -> None:
        """Subscribe, serve, call ``startBench``; from then on only callbacks."""


OBSERVER = object()
"""Owner of those who only listen to what others publish, as a recorder: at no end of a topic."""


@dataclasses.dataclass
class _Topic:
    type: type | None = None
    readers: list[Callable[[Any], None]] = dataclasses.field(default_factory=list)
    owners: list[object] = dataclasses.field(default_factory=list)
    """Who reads, of each reader; None for anyone."""
    hearers: list[Callable[[Any], None]] = dataclasses.field(default_factory=list)
    """Who hears what there is, and counts as no reader."""
    checks: list[Callable[[Any], None]] = dataclasses.field(default_factory=list)
    writers: list[object] = dataclasses.field(default_factory=list)
    """Who publishes, each once; None for anyone."""
    kept: deque[Any] | None = None
    """The newest message, kept from the first request on."""
    unread: Any = None
    """The newest message that was published while the topic had no subscriber."""


@dataclasses.dataclass(frozen=True)
class TopicEnds:
    """What a topic carries, and who is at its ends."""

    type: type
    """Class of its messages."""
    is_published: bool
    """Whether anyone publishes on it."""
    is_read: bool
    """Whether anyone subscribes to it."""


class Bus:
    """Named topics and services; delivery only when `deliver` is called.

    Topic and service names are compared without a leading slash, so ``/uwsim/camera1`` and
    ``uwsim/camera1`` are one, as they are for a ROS node in the root namespace.
    """

    STATE = ("step", "_due_now", "_due_later", "_posted")
    """Attributes of its state, for snapshots."""

    def __init__(self) -> None:
        self._topics: dict[str, _Topic] = {}
        self._services: dict[str, tuple[type, Callable[[Any], object]]] = {}
        self._offers: dict[str, list[Callable[[Any], object]]] = {}
        self._due_now: deque[tuple[str, object]] = deque()
        self._due_later: list[tuple[int, int, str, object]] = []
        self._posted = 0
        self._withheld: set[str] = set()
        self._observers: list[Callable[[str, type], None]] = []
        self._elsewhere: list[tuple[Callable[[str], bool], Callable[[str, Any], object]]] = []
        self.step = 0
        """The current step; set by the owner of the clock."""
        self.revision = 0
        """Grows when a topic, a publisher, a subscriber or a service comes or goes."""
        self.keeps_unread = True
        """Whether somebody may ask for `unread`; else nobody needs what has no subscriber."""

    def subscribe(
        self,
        topic: str,
        type: type[M],
        callback: Callable[[M], None],
        *,
        check: Callable[[M], None] | None = None,
        owner: object = None,
        counts: bool = True,
    ) -> Callable[[], None]:
        """Call ``callback`` with every message on ``topic``; returns the way to stop it.

        ``check`` is called while a message is published, and raises BadMessage to its sender if
        the reader could do nothing with it.

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
        self.revision += 1
        if check is not None:
            entry.checks.append(check)

        def stop() -> None:
            if callback in entry.readers:
                del entry.owners[entry.readers.index(callback)]
                entry.readers.remove(callback)
                self.revision += 1
                if check is not None:
                    entry.checks.remove(check)

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

    def inbox(self, topic: str, type: type[M], *, latched: bool = False) -> Inbox[M]:
        """Return an inbox that collects the messages of ``topic`` from now on.

        A ``latched`` one begins with the newest message there was, as a subscriber of ROS does on
        a latched topic. The bus keeps that message from the first time it is asked so.
        """
        inbox: Inbox[M] = Inbox()
        if latched:
            entry = self._typed(topic, type)
            if entry.kept is None:
                entry.kept = deque(maxlen=1)
                entry.readers.append(entry.kept.append)
                entry.owners.append(None)
            for message in entry.kept:
                inbox.receive(message, self.step)
        stop = self.subscribe(topic, type, lambda message: inbox.receive(message, self.step))
        inbox.stop_with(stop)
        return inbox

    def ends(self, topic: str, *, besides: object = None) -> TopicEnds | None:
        """Who is at the ends of a topic, one owner and observers left out; None without a type."""
        entry = self._topics.get(_without_slash(topic))
        if entry is None or entry.type is None:
            return None
        return TopicEnds(
            entry.type,
            is_published=any(each is None or each is not besides for each in entry.writers),
            is_read=any(
                each is None or (each is not besides and each is not OBSERVER)
                for each in entry.owners
            ),
        )

    def publisher(
        self, topic: str, type: type[M], *, delay_steps: int = 0, owner: object = None
    ) -> Callable[[M], None]:
        """Return ``publish(message)`` for ``topic``, delayed by ``delay_steps``.

        ``owner`` is who publishes, for `ends`.
        """
        if type is object:
            raise BadSetting(f"Topic {topic!r} is published without a message type.")
        name = _without_slash(topic)
        entry = self._typed(topic, type)
        if not any(each is owner for each in entry.writers):
            entry.writers.append(owner)
            self.revision += 1

        def publish(message: M) -> None:
            if not _is_exactly(message, type):
                wrong_class = _but_not(type, message.__class__)
                raise BadMessage(f"Topic {topic!r} carries {_type_name(type)}, {wrong_class}.")
            if not entry.readers:
                entry.unread = message
                if entry.hearers and not unfit(message):
                    for hear in entry.hearers:
                        hear(message)
                return
            if wrong := unfit(message):
                raise BadMessage(f"Topic {topic!r} carries {_type_name(type)}: {wrong}.")
            freeze(message)
            for check in entry.checks:
                check(message)
            if delay_steps:
                self._posted += 1
                self._due_later.append((self.step + delay_steps, self._posted, name, message))
            else:
                self._due_now.append((name, message))

        return publish

    def withhold(self, topic: str) -> None:
        """Hide a topic from algorithms under test; observers of the run may read it."""
        self._withheld.add(_without_slash(topic))

    def is_withheld(self, topic: str) -> bool:
        """Whether a topic is hidden from algorithms under test."""
        return _without_slash(topic) in self._withheld

    def unread(self, topic: str) -> object | None:
        """Return the newest message that was published while the topic had no subscriber."""
        entry = self._topics.get(_without_slash(topic))
        return None if entry is None or entry.unread is None else freeze(entry.unread)

    def message_type(self, topic: str) -> type | None:
        """The message type of ``topic``; None before the first reader or writer."""
        entry = self._topics.get(_without_slash(topic))
        return entry.type if entry else None

    def has_readers(self, topic: str) -> bool:
        """Whether ``topic`` has a subscriber."""
        entry = self._topics.get(_without_slash(topic))
        return bool(entry and entry.readers)

    def without_subscriber(self, topic: str) -> str | None:
        """Report that a topic has no subscriber, with the nearest that has; None if it has one."""
        read = [name for name, entry in self._topics.items() if entry.readers]
        return (
            None
            if _without_slash(topic) in read
            else f"it has no subscriber.{did_you_mean(topic, read)}"
        )

    def without_publisher(self, topic: str) -> str | None:
        """Report that a topic has no publisher, with the nearest that has; None if it has one."""
        published = [name for name, entry in self._topics.items() if entry.writers]
        if _without_slash(topic) in published:
            return None
        near = did_you_mean(topic, published)
        read = self._topics.get(_without_slash(topic))
        alike = [name for name in published if read and self._topics[name].type is read.type]
        if not near and alike:
            near = f" Of its type there is {' and '.join(map(repr, alike[:3]))}."
        return f"it has no publisher.{near}"

    def serve(self, name: str, type: type[M], handler: Callable[[M], object]) -> None:
        """Offer a service whose request class is ``type``; a later offer takes its place."""
        self._services[_without_slash(name)] = (type, handler)
        self.revision += 1

    def offer(self, name: str, type: type[M], handler: Callable[[M], object]) -> Callable[[], None]:
        """Offer a service together with others: a call reaches all, the newest answers.

        Returns the way to take part no more; the last to leave withdraws the service.
        """
        handlers = self._offers.setdefault(_without_slash(name), [])
        handlers.append(handler)
        self.serve(name, type, lambda request: [answer(request) for answer in list(handlers)][-1])

        def leave() -> None:
            if handler in handlers:
                handlers.remove(handler)
                if not handlers:
                    self.withdraw(name)

        return leave

    def withdraw(self, name: str) -> None:
        """Stop offering a service, if it is offered."""
        self._services.pop(_without_slash(name), None)
        self.revision += 1

    def serve_elsewhere(
        self, offers: Callable[[str], bool], call: Callable[[str, Any], object]
    ) -> Callable[[], None]:
        """Have services that are not offered here looked for outside the process.

        Args:
            offers: whether a service of that name, without a leading slash, is offered there.
            call: calls it with a request, and returns its response.

        Returns:
            The way to stop it.
        """
        entry = (offers, call)
        self._elsewhere.append(entry)

        def stop() -> None:
            if entry in self._elsewhere:
                self._elsewhere.remove(entry)

        return stop

    def request_type(self, name: str) -> type | None:
        """The class of a service's requests; None if it is not offered in the process."""
        found = self._services.get(_without_slash(name))
        return found[0] if found else None

    def serves(self, name: str) -> bool:
        """Whether the service is offered, here or outside the process."""
        key = _without_slash(name)
        return key in self._services or any(offers(key) for offers, _ in self._elsewhere)

    def call(self, name: str, request: object) -> object:
        """Call a service now.

        Raises:
            UnknownName: it is not offered.
            BadMessage: the request is of another type, or its fields are.
        """
        if _without_slash(name) not in self._services:
            return self._call_elsewhere(name, request)
        type, handler = self._services[_without_slash(name)]
        if not _is_exactly(request, type):
            raise BadMessage(
                f"Service {name!r} takes {_type_name(type)}, not {_type_name(request.__class__)}."
            )
        if wrong := unfit(request):
            raise BadMessage(f"Service {name!r} takes {_type_name(type)}: {wrong}.")
        return handler(freeze(request))

    def _call_elsewhere(self, name: str, request: object) -> object:
        for offers, call in self._elsewhere:
            if offers(_without_slash(name)):
                return call(_without_slash(name), request)
        raise UnknownName("service", name, self._services)

    def deliver(self) -> None:
        """Deliver every message that is due at the current step, in the order of publishing."""
        if not self._due_now and not self._due_later:
            return
        if self._due_later:
            due = sorted(post for post in self._due_later if post[0] <= self.step)
            self._due_later = [post for post in self._due_later if post[0] > self.step]
            self._due_now.extend((topic, message) for _, _, topic, message in due)
        for _ in range(MAX_MESSAGES_PER_STEP):
            if not self._due_now:
                return
            topic, message = self._due_now.popleft()
            entry = self._topics[topic]
            for reader in (*entry.readers, *entry.hearers):
                reader(message)
        raise UwsimError(
            f"More than {MAX_MESSAGES_PER_STEP} messages in one step: two callbacks answer each "
            f"other without end, the last on topic {topic!r}."
        )

    @property
    def next_delivery(self) -> float:
        """The step at which `deliver` has something to hand out; inf where nothing waits."""
        if self._due_now:
            return self.step
        return min((post[0] for post in self._due_later), default=math.inf)

    @property
    def topics(self) -> dict[str, str]:
        """Topic name -> message type, sorted by name."""
        return {name: _type_name(self._topics[name].type) for name in sorted(self._topics)}

    @property
    def services(self) -> tuple[str, ...]:
        """The names of the services offered, sorted."""
        return tuple(sorted(self._services))

    def _typed(self, topic: str, type: type[M]) -> _Topic:
        entry = self._topics.setdefault(_without_slash(topic), _Topic())
        if type is object:
            return entry
        if entry.type is None:
            entry.type = type
            for appeared in list(self._observers):
                appeared(_without_slash(topic), type)
        elif entry.type is not type:
            raise BadSetting(
                f"Topic {topic!r} carries {_type_name(entry.type)}, {_but_not(entry.type, type)}.",
                name=topic,
            )
        return entry


def _is_exactly(message: object, expected: type) -> bool:
    """Whether the class of a message is exactly this one, not a derived one."""
    return type(message) is expected


def _without_slash(name: str) -> str:
    return name.strip().lstrip("/")


def _but_not(expected: type, found: type) -> str:
    """``not std_msgs/msg/Bool``, or that it is another class of the same name."""
    if _type_name(expected) == _type_name(found):
        return f"the class of {expected.__module__}, not that of {found.__module__}"
    return f"not {_type_name(found)}"


def _type_name(type: type | None) -> str:
    return str(getattr(type, "__msgtype__", getattr(type, "__name__", "nothing yet")))
