"""External subscribers: a bridge subscribes on the bus only to the topics that they read."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

from ...bus import Bus
from ..log import Log
from .work_signal import WorkSignal

Change = tuple[str, int]
"""A topic, and the change of its number of subscribers."""


class Subscribers:
    """The number of external subscribers of each topic of a bus.

    Args:
        bus: the bus of the simulation.
        log: the log for topics that are hidden from algorithms under test.
        signal: the work signal of the bridge.
        owner: the owner of the subscriptions on the bus.
        is_forwarded: a function that returns whether to send a message to external subscribers.
        send: a function that sends a message of a topic to external subscribers.
    """

    def __init__(
        self,
        bus: Bus,
        log: Log,
        signal: WorkSignal,
        *,
        owner: object,
        is_forwarded: Callable[[object], bool],
        send: Callable[[str, object], None],
    ) -> None:
        self._bus, self._log, self._signal, self._owner = bus, log, signal, owner
        self._is_forwarded, self._send = is_forwarded, send
        self._changes: list[Change] = []
        self._n_subscribers: Counter[str] = Counter()
        self._unsubscribe: dict[str, Callable[[], None]] = {}
        self.n_sent = 0
        """The number of messages sent to external subscribers so far."""

    def add(self, topic: str) -> None:
        """Count one more subscriber of ``topic``. May be called from any thread."""
        self.change(topic, 1)

    def remove(self, topic: str) -> None:
        """Count one subscriber fewer of ``topic``. May be called from any thread."""
        self.change(topic, -1)

    def change(self, topic: str, n: int) -> None:
        """Count ``n`` more subscribers of ``topic``. May be called from any thread."""
        with self._signal.lock:
            self._changes.append((topic.lstrip("/"), n))
            self._signal.mark_urgent()
        self._signal.wake()

    def is_read(self, topic: str) -> bool:
        """Return whether ``topic`` has a subscriber. Called in the thread of the simulation."""
        return self._n_subscribers[topic.lstrip("/")] > 0

    def take(self) -> list[Change]:
        """Remove and return the changes that wait. With the lock of the signal."""
        changes, self._changes = self._changes, []
        return changes

    def apply(self, changes: list[Change]) -> None:
        """Apply changes of the numbers of subscribers, which `take` has returned.

        Subscribe on the bus to topics that now have external subscribers; unsubscribe from others.
        """
        for topic, n in changes:
            self._n_subscribers[topic] += n
            has_subscribers = self._n_subscribers[topic] > 0
            if has_subscribers and topic not in self._unsubscribe:
                self._subscribe(topic)
            elif not has_subscribers and topic in self._unsubscribe:
                self._unsubscribe.pop(topic)()

    def close(self) -> None:
        """End all subscriptions."""
        for unsubscribe in self._unsubscribe.values():
            unsubscribe()
        self._unsubscribe.clear()

    def _subscribe(self, topic: str) -> None:
        if (reason := self._bus.hidden_reason(topic)) is not None:
            self._log.report(f"/{topic} is not sent: it {reason}")
            return

        def receive(message: object) -> None:
            if self._is_forwarded(message):
                self.n_sent += 1
                self._send(topic, message)

        self._unsubscribe[topic] = self._bus.subscribe(topic, object, receive, owner=self._owner)
