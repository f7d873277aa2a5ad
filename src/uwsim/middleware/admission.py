"""Rules that decide which external programs may change a scored run, with a count of refusals.

All may read. A transport names the ``sender`` of a message, a call and an offer of a service: the
connection (WebSocket), the node (ROS 1), the participant (ROS 2 by DDS). Where it cannot, the
name is empty and nothing is refused.
"""

from __future__ import annotations

import threading
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Callable, Iterable
from typing import Literal

from .queues import LatestQueue

MAX_HELD = 100
"""The maximum number of messages and offers held of a sender that may take part later."""
MAX_HELD_BYTES = 4 * 2**20
MAX_SENDERS = 100
"""The maximum number of senders of which messages are held."""
MAX_KINDS = 100
"""The maximum number of senders and topics with a count of their own; the others share one."""
OTHER_KEY = ("other senders", "other topics and services")
Decision = Literal["take", "hold", "refuse"]
Accept = Callable[[], object]
"""The function that accepts a held message or offer."""
Report = Callable[[str, str], None]
"""The function that is called with sender and text, once for each refused topic or service."""
Refusal = tuple[str, str, int]
"""The sender, the topic or service, and the number of refusals."""


class Admission(ABC):
    """The decisions about each sender; any thread may call it."""

    def __init__(self, report: Report) -> None:
        self._report = report
        self._lock = threading.RLock()
        self._admitted_senders: set[str] = set()
        self._held_queues: dict[str, LatestQueue[Accept]] = {}
        self._refusal_counts: Counter[tuple[str, str]] = Counter()
        self._known_keys: set[tuple[str, str]] = set()

    @abstractmethod
    def _on_message(self, topic: str, sender: str) -> Decision:
        """Decide about a message of a sender that is not admitted."""

    @abstractmethod
    def _on_call(self, name: str, sender: str) -> bool:
        """Decide about a call of a sender that is not admitted."""

    @abstractmethod
    def _on_offer(self, name: str, sender: str) -> Decision:
        """Decide about a service that is offered by a sender that is not admitted."""

    def admit(self, sender: str) -> None:
        """Admit a sender to the run, and accept what was held of it."""
        with self._lock:  # until all is accepted: messages that arrive meanwhile are newer
            self._admitted_senders.add(sender)
            held_messages = self._held_queues.pop(sender, None)
            for accept in held_messages.take() if held_messages is not None else ():
                accept()

    def is_waited_for(self, sender: str) -> bool:
        """Return whether the run waits for the messages of a sender."""
        return sender in self._admitted_senders

    def remove(self, sender: str) -> None:
        """Forget what was held of a sender that has left."""
        with self._lock:
            self._held_queues.pop(sender, None)

    def may_publish(self, topic: str, sender: str, accept: Accept, size: int) -> bool:
        """Return whether to accept a message of ``size`` bytes now; ``accept`` does so later."""
        with self._lock:
            return self._decide(f"/{topic}", sender, self._on_message(topic, sender), accept, size)

    def may_offer(self, name: str, sender: str, accept: Accept) -> bool:
        """Return whether to offer a service of a sender now; ``accept`` does so later."""
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
            is_allowed = self._takes_part(sender) or self._on_offer(name, sender) == "take"
        if not is_allowed:
            self.refuse(sender, f"/{name}")
        return is_allowed

    def refuse(self, sender: str, name: str) -> None:
        """Count a refusal; report it the first time."""
        key = (sender or OTHER_KEY[0], name)
        with self._lock:
            is_new = key not in self._known_keys
            if is_new and len(self._known_keys) >= MAX_KINDS:
                key, is_new = OTHER_KEY, OTHER_KEY not in self._known_keys
            self._known_keys.add(key)
            self._refusal_counts[key] += 1
        if is_new:
            text = f"{key[1]} of {key[0]} is refused: it does not take part in this run"
            self._report(sender, text)

    def take_refusals(self) -> tuple[Refusal, ...]:
        """Return the refusals since the last call, by sender and topic or service."""
        with self._lock:
            counts, self._refusal_counts = self._refusal_counts, Counter()
        return tuple((sender, name, n) for (sender, name), n in sorted(counts.items()))

    def _takes_part(self, sender: str) -> bool:
        """Return whether a sender takes part, or cannot be distinguished from those that do."""
        return not sender or sender in self._admitted_senders

    def _decide(
        self, name: str, sender: str, decision: Decision, accept: Accept, size: int
    ) -> bool:
        if decision == "hold" and self._hold(sender, accept, size):
            return False
        if decision != "take":
            self.refuse(sender, name)
        return decision == "take"

    def _hold(self, sender: str, accept: Accept, size: int) -> bool:
        """Hold a message or offer until its sender is admitted; return whether there is space."""
        if sender not in self._held_queues and len(self._held_queues) >= MAX_SENDERS:
            return False
        queue = LatestQueue[Accept](MAX_HELD, MAX_HELD_BYTES)
        self._held_queues.setdefault(sender, queue).put(accept, size)
        return True


class SingleProgram(Admission):
    """The rule of runs with one program: a sender is admitted when it has joined.

    Earlier messages and offers of a sender are held until then; calls are refused.
    """

    def _on_message(self, topic: str, sender: str) -> Decision:
        if self._takes_part(sender):
            return "take"
        return "refuse" if self._admitted_senders else "hold"

    def _on_call(self, name: str, sender: str) -> bool:
        return False

    def _on_offer(self, name: str, sender: str) -> Decision:
        return self._on_message(name, sender)


class FirstCaller(SingleProgram):
    """The rule of runs with one program: the first that calls a service is admitted."""

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
        topics: the topics whose owners take part; others may publish nothing, and may call and
            offer services until each topic has an owner. None: every topic, and all may call.
        report: the function that reports refusals.
    """

    def __init__(self, topics: Iterable[str] | None, report: Report) -> None:
        super().__init__(report)
        self._topics = None if topics is None else frozenset(topics)
        self._owners: dict[str, str] = {}
        self._offerers: dict[str, str] = {}

    def is_waited_for(self, sender: str) -> bool:
        """Return whether the run waits for a sender: it owns one of the given topics."""
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
            return "take"
        if topic in self._owners:
            return "take" if self._owners[topic] == sender else "refuse"
        is_open = self._topics is None or topic in self._topics
        if is_open or sender in self._admitted_senders:
            self._owners[topic] = sender
            self.admit(sender)
            return "take"
        return "refuse" if self._is_complete else "hold"

    def _on_call(self, name: str, sender: str) -> bool:
        return not self._is_complete

    def _on_offer(self, name: str, sender: str) -> Decision:
        if sender and sender not in self._admitted_senders and self._is_complete:
            return "refuse"
        return "take" if self._offerers.setdefault(name, sender) == sender else "refuse"

    @property
    def _is_complete(self) -> bool:
        """True if each of the topics has an owner."""
        return self._topics is not None and self._topics <= set(self._owners)
