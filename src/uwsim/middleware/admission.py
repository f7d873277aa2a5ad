"""Rules that decide which external programs may take part in a scored run, and count refusals.

Every program may read topics. Only a program that takes part may publish messages, call services
and offer services. The transport gives the name of the ``sender``: a connection (WebSocket), a node
(ROS 1) or a participant (ROS 2 on DDS). If it cannot distinguish senders, the name is empty and
nothing is refused.
"""

from __future__ import annotations

import threading
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Callable, Iterable
from typing import Literal

from .queues import LatestQueue

MAX_HELD = 100
"""The maximum number of messages and offers held for a sender that may be admitted later."""
MAX_HELD_BYTES = 4 * 2**20
"""The maximum size of the messages held for one sender [bytes]."""
MAX_SENDERS = 100
"""The maximum number of senders for which messages are held."""
MAX_KINDS = 100
"""The maximum number of refused pairs of sender and topic that are counted separately."""
OTHER_KEY = ("other senders", "other topics and services")
"""The pair under which all further refusals are counted."""
Decision = Literal["accept", "hold", "refuse"]
"""The decision about a message or an offer; it is held until its sender is admitted."""
Accept = Callable[[], object]
"""A function that accepts a held message or offer."""
Report = Callable[[str, str], None]
"""A function that is called with sender and text, once for each refused topic or service."""
Refusal = tuple[str, str, int]
"""The sender, the topic or service, and the number of refusals."""


class Admission(ABC):
    """The base class of the rules; any thread may call its methods."""

    def __init__(self, report: Report) -> None:
        self._report = report
        self._lock = threading.RLock()
        self._admitted_senders: set[str] = set()
        self._held_queues: dict[str, LatestQueue[Accept]] = {}
        self._refusal_counts: Counter[tuple[str, str]] = Counter()
        self._known_keys: set[tuple[str, str]] = set()

    @abstractmethod
    def _on_message(self, topic: str, sender: str) -> Decision:
        """Decide about a message."""

    @abstractmethod
    def _on_call(self, name: str, sender: str) -> bool:
        """Decide about a call of a sender that is not admitted."""

    @abstractmethod
    def _on_offer(self, name: str, sender: str) -> Decision:
        """Decide about a sender's offer of a service."""

    def admit(self, sender: str) -> None:
        """Admit a sender to the run, and accept the messages and offers held for it."""
        with self._lock:  # kept until the end, so that newer messages come after the held ones
            self._admitted_senders.add(sender)
            held_messages = self._held_queues.pop(sender, None)
            for accept in held_messages.take() if held_messages is not None else ():
                accept()

    def is_waited_for(self, sender: str) -> bool:
        """Return whether the run waits for the messages of a sender."""
        return sender in self._admitted_senders

    def remove(self, sender: str) -> None:
        """Discard the messages and offers held for a sender that has left."""
        with self._lock:
            self._held_queues.pop(sender, None)

    def may_publish(self, topic: str, sender: str, accept: Accept, size: int) -> bool:
        """Return whether to accept a message of ``size`` bytes now.

        If the message is held, ``accept`` is called when the sender is admitted.
        """
        with self._lock:
            return self._decide(f"/{topic}", sender, self._on_message(topic, sender), accept, size)

    def may_offer(self, name: str, sender: str, accept: Accept) -> bool:
        """Return whether to offer a service of a sender now.

        If the offer is held, ``accept`` is called when the sender is admitted.
        """
        with self._lock:
            return self._decide(f"/{name}", sender, self._on_offer(name, sender), accept, 0)

    def may_call(self, name: str, sender: str) -> bool:
        """Return whether to answer a call of a service."""
        with self._lock:
            is_allowed = self._takes_part(sender) or self._on_call(name, sender)
        if not is_allowed:
            self.refuse(sender, f"/{name}")
        return is_allowed

    def may_answer(self, name: str, sender: str) -> bool:
        """Return whether to accept the response of an external service from a sender."""
        with self._lock:
            is_allowed = self._takes_part(sender) or self._on_offer(name, sender) == "accept"
        if not is_allowed:
            self.refuse(sender, f"/{name}")
        return is_allowed

    def refuse(self, sender: str, name: str) -> None:
        """Count a refused message, call or offer; report the first of a sender and name."""
        key = (sender or OTHER_KEY[0], name)
        with self._lock:
            is_new = key not in self._known_keys
            if is_new and len(self._known_keys) >= MAX_KINDS:
                key, is_new = OTHER_KEY, OTHER_KEY not in self._known_keys
            self._known_keys.add(key)
            self._refusal_counts[key] += 1
        if is_new:
            text = f"{key[1]} from {key[0]} is refused: the sender does not take part in this run"
            self._report(sender, text)

    def pop_refusals(self) -> tuple[Refusal, ...]:
        """Return the refusals since the last call, by sender and topic or service."""
        with self._lock:
            counts, self._refusal_counts = self._refusal_counts, Counter()
        return tuple((sender, name, n) for (sender, name), n in sorted(counts.items()))

    def _takes_part(self, sender: str) -> bool:
        """Return whether a sender is admitted, or is not known (its name is empty)."""
        return not sender or sender in self._admitted_senders

    def _decide(
        self, name: str, sender: str, decision: Decision, accept: Accept, size: int
    ) -> bool:
        if decision == "hold" and self._hold(sender, accept, size):
            return False
        if decision != "accept":
            self.refuse(sender, name)
        return decision == "accept"

    def _hold(self, sender: str, accept: Accept, size: int) -> bool:
        """Hold a message or offer until its sender is admitted; return whether there is space."""
        if sender not in self._held_queues and len(self._held_queues) >= MAX_SENDERS:
            return False
        queue = LatestQueue[Accept](MAX_HELD, MAX_HELD_BYTES)
        self._held_queues.setdefault(sender, queue).put(accept, size)
        return True


class SingleProgram(Admission):
    """The rule of a run with one program, which is admitted by `admit` when it joins the run.

    Until then, messages and offers are held and calls are refused. Afterwards, all other senders
    are refused.
    """

    def _on_message(self, topic: str, sender: str) -> Decision:
        if self._takes_part(sender):
            return "accept"
        return "refuse" if self._admitted_senders else "hold"

    def _on_call(self, name: str, sender: str) -> bool:
        return False

    def _on_offer(self, name: str, sender: str) -> Decision:
        return self._on_message(name, sender)


class FirstCaller(SingleProgram):
    """The rule of a run with one program: the first that calls a given service is admitted."""

    def __init__(self, service: str, report: Report) -> None:
        super().__init__(report)
        self._service = service

    def _on_call(self, name: str, sender: str) -> bool:
        if self._admitted_senders or name != self._service:
            return False
        self.admit(sender)
        return True


class TopicOwners(Admission):
    """The rule that each topic belongs to the program that published it first.

    Args:
        topics: the topics whose owners take part. Other programs may publish nothing; they may call
            and offer services only until each of these topics has an owner. None: all topics, and
            every program may call services.
        report: a function that reports refusals.
    """

    def __init__(self, topics: Iterable[str] | None, report: Report) -> None:
        super().__init__(report)
        self._topics = None if topics is None else frozenset(topics)
        self._owners: dict[str, str] = {}
        self._offerers: dict[str, str] = {}

    def is_waited_for(self, sender: str) -> bool:
        """Return whether the run waits for a sender: it must own one of the given topics."""
        return self._topics is not None and super().is_waited_for(sender)

    def remove(self, sender: str) -> None:
        """Release the topics and services of a sender that has left."""
        with self._lock:
            super().remove(sender)
            self._admitted_senders.discard(sender)
            for owners in (self._owners, self._offerers):
                for name in [name for name, owner in owners.items() if owner == sender]:
                    del owners[name]

    def _on_message(self, topic: str, sender: str) -> Decision:
        if not sender:
            return "accept"
        if topic in self._owners:
            return "accept" if self._owners[topic] == sender else "refuse"
        is_open = self._topics is None or topic in self._topics
        if is_open or sender in self._admitted_senders:
            self._owners[topic] = sender
            self.admit(sender)
            return "accept"
        return "refuse" if self._is_complete else "hold"

    def _on_call(self, name: str, sender: str) -> bool:
        return not self._is_complete

    def _on_offer(self, name: str, sender: str) -> Decision:
        if sender and sender not in self._admitted_senders and self._is_complete:
            return "refuse"
        return "accept" if self._offerers.setdefault(name, sender) == sender else "refuse"

    @property
    def _is_complete(self) -> bool:
        """True if each of the topics has an owner."""
        return self._topics is not None and self._topics <= set(self._owners)
