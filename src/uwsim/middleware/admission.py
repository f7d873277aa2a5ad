"""Which programs outside may change a scored run, and a count of what was refused of the others.

Everybody may read. A transport names the sender of a message, a call and an offer of a service
(``by``): the connection (WebSocket), the node (ROS 1), the participant (ROS 2 by DDS). Where it
cannot, ``by`` is empty and nothing is refused.
"""

from __future__ import annotations

import threading
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Callable, Iterable
from typing import Literal

from .queues import LatestQueue

MAX_HELD = 100
"""Messages and offers of one sender that are kept until it is known whether it takes part."""
MAX_HELD_BYTES = 4 * 2**20
MAX_SENDERS = 100
"""Senders of which something is kept."""
MAX_KINDS = 100
"""Senders and topics that are counted separately; further ones are counted together."""
OTHERS = ("other senders", "other topics and services")
Decision = Literal["take", "hold", "refuse"]
Take = Callable[[], object]
"""Takes in a message or an offer that was held."""
Report = Callable[[str, str], None]
"""Called once for each sender and topic or service that is refused, with the sender and a text."""
Refused = tuple[str, str, int]
"""Sender, what it sent, how often."""


class Admission(ABC):
    """Decides for each sender; any thread may ask."""

    def __init__(self, report: Report) -> None:
        self._report = report
        self._lock = threading.RLock()
        self._admitted: set[str] = set()
        self._held: dict[str, LatestQueue[Take]] = {}
        self._refused: Counter[tuple[str, str]] = Counter()
        self._known: set[tuple[str, str]] = set()

    @abstractmethod
    def _on_message(self, topic: str, by: str) -> Decision:
        """Decide about a message of a sender that was not admitted."""

    @abstractmethod
    def _on_call(self, name: str, by: str) -> bool:
        """Decide about a call by a sender that was not admitted."""

    @abstractmethod
    def _on_offer(self, name: str, by: str) -> Decision:
        """Decide about a service that a sender offers who was not admitted."""

    def admit(self, by: str) -> None:
        """Let a sender take part; what was held of it is taken in."""
        with self._lock:  # until all is taken in: what comes meanwhile is newer
            self._admitted.add(by)
            held = self._held.pop(by, None)
            for take in held.take() if held is not None else ():
                take()

    def is_waited_for(self, by: str) -> bool:
        """Whether the run waits for what a sender sends."""
        return by in self._admitted

    def leave(self, by: str) -> None:
        """A sender has left for good; what was held of it is forgotten."""
        with self._lock:
            self._held.pop(by, None)

    def takes(self, topic: str, by: str, later: Take, size: int) -> bool:
        """Whether a message of ``size`` bytes is taken in now; if it is held, ``later`` does so."""
        with self._lock:
            return self._is_taken(f"/{topic}", by, self._on_message(topic, by), later, size)

    def may_offer(self, name: str, by: str, later: Take) -> bool:
        """Whether a service of a sender is offered now; if the offer is held, ``later`` does so."""
        with self._lock:
            return self._is_taken(f"/{name}", by, self._on_offer(name, by), later, 0)

    def may_call(self, name: str, by: str) -> bool:
        """Whether a call of a service is answered."""
        with self._lock:
            is_allowed = self._is_certain(by) or self._on_call(name, by)
        if not is_allowed:
            self.refuse(by, f"/{name}")
        return is_allowed

    def may_answer(self, name: str, by: str) -> bool:
        """Whether the response of a service outside is taken from a sender."""
        with self._lock:
            is_allowed = self._is_certain(by) or self._on_offer(name, by) == "take"
        if not is_allowed:
            self.refuse(by, f"/{name}")
        return is_allowed

    def refuse(self, by: str, what: str) -> None:
        """Count what was refused; it is reported once."""
        key = (by or OTHERS[0], what)
        with self._lock:
            is_new = key not in self._known
            if is_new and len(self._known) >= MAX_KINDS:
                key, is_new = OTHERS, OTHERS not in self._known
            self._known.add(key)
            self._refused[key] += 1
        if is_new:
            self._report(by, f"{key[1]} of {key[0]} is refused: it does not take part in this run")

    def take_refused(self) -> tuple[Refused, ...]:
        """Return what was refused since the last call, by sender and topic or service."""
        with self._lock:
            found, self._refused = self._refused, Counter()
        return tuple((by, what, n) for (by, what), n in sorted(found.items()))

    def _is_certain(self, by: str) -> bool:
        """Whether a sender takes part, or cannot be told from those that do."""
        return not by or by in self._admitted

    def _is_taken(self, what: str, by: str, decision: Decision, later: Take, size: int) -> bool:
        if decision == "hold" and self._hold(by, later, size):
            return False
        if decision != "take":
            self.refuse(by, what)
        return decision == "take"

    def _hold(self, by: str, later: Take, size: int) -> bool:
        """Keep something until its sender is admitted; whether there is room."""
        if by not in self._held and len(self._held) >= MAX_SENDERS:
            return False
        self._held.setdefault(by, LatestQueue(MAX_HELD, MAX_HELD_BYTES)).put(later, size)
        return True


class Joined(Admission):
    """One program takes part: who is admitted, when it has joined.

    What a sender has published and offered before is held until then; calls are refused.
    """

    def _on_message(self, topic: str, by: str) -> Decision:
        if self._is_certain(by):
            return "take"
        return "refuse" if self._admitted else "hold"

    def _on_call(self, name: str, by: str) -> bool:
        return False

    def _on_offer(self, name: str, by: str) -> Decision:
        return self._on_message(name, by)


class FirstCaller(Joined):
    """One program takes part: the first that calls a service."""

    def __init__(self, service: str, report: Report) -> None:
        super().__init__(report)
        self._service = service

    def _on_call(self, name: str, by: str) -> bool:
        if self._admitted or name != self._service:
            return False
        self.admit(by)
        return True


class TopicOwners(Admission):
    """Each topic belongs to the program that published it first.

    Args:
        topics: those whose owners take part; others may publish nothing, and may call and offer
            services until each of these topics has an owner. None: every topic, and all may call.
        report: see `Report`.
    """

    def __init__(self, topics: Iterable[str] | None, report: Report) -> None:
        super().__init__(report)
        self._topics = None if topics is None else frozenset(topics)
        self._owners: dict[str, str] = {}
        self._offerers: dict[str, str] = {}

    def is_waited_for(self, by: str) -> bool:
        """Whether the run waits for what a sender sends: for the owners of certain topics only."""
        return self._topics is not None and super().is_waited_for(by)

    def leave(self, by: str) -> None:
        """A sender has left for good; its topics and services may have another owner."""
        with self._lock:
            super().leave(by)
            self._admitted.discard(by)
            for owners in (self._owners, self._offerers):
                for name in [name for name, owner in owners.items() if owner == by]:
                    del owners[name]

    def _on_message(self, topic: str, by: str) -> Decision:
        if not by:
            return "take"
        if topic in self._owners:
            return "take" if self._owners[topic] == by else "refuse"
        takes_part = self._topics is None or topic in self._topics
        if takes_part or by in self._admitted:
            self._owners[topic] = by
            self.admit(by)
            return "take"
        return "refuse" if self._is_complete else "hold"

    def _on_call(self, name: str, by: str) -> bool:
        return not self._is_complete

    def _on_offer(self, name: str, by: str) -> Decision:
        if by and by not in self._admitted and self._is_complete:
            return "refuse"
        return "take" if self._offerers.setdefault(name, by) == by else "refuse"

    @property
    def _is_complete(self) -> bool:
        """Whether each of the topics has an owner."""
        return self._topics is not None and self._topics <= set(self._owners)
