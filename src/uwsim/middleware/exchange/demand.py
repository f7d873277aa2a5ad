"""Topics that are read outside: a bridge subscribes to them on the bus, and to no others."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

from ...bus import Bus
from ..log import Log
from .intake import Intake

Change = tuple[str, int]
"""A topic, and how many more read it."""


class Demand:
    """How many outside read each topic of a bus.

    Args:
        bus: of the simulation.
        log: where topics that are withheld are reported.
        intake: of the bridge.
        owner: whose subscriptions these are for the bus.
        goes_out: whether a message is sent to those outside.
        send: hands a message of a topic to them.
    """

    def __init__(
        self,
        bus: Bus,
        log: Log,
        intake: Intake,
        *,
        owner: object,
        goes_out: Callable[[object], bool],
        send: Callable[[str, object], None],
    ) -> None:
        self._bus, self._log, self._intake, self._owner = bus, log, intake, owner
        self._goes_out, self._send = goes_out, send
        self._changes: list[Change] = []
        self._n_readers: Counter[str] = Counter()
        self._stops: dict[str, Callable[[], None]] = {}
        self.n_sent = 0
        """Messages that were handed to those outside so far."""

    def want(self, topic: str) -> None:
        """One more outside reads ``topic``. Any thread."""
        self.change(topic, 1)

    def unwant(self, topic: str) -> None:
        """One fewer outside reads ``topic``. Any thread."""
        self.change(topic, -1)

    def change(self, topic: str, n: int) -> None:
        """``n`` more outside read ``topic``. Any thread."""
        with self._intake.lock:
            self._changes.append((topic.lstrip("/"), n))
            self._intake.add_urgent()
        self._intake.wake()

    def is_wanted(self, topic: str) -> bool:
        """Whether anybody outside reads ``topic``. In the thread of the simulation."""
        return self._n_readers[topic.lstrip("/")] > 0

    def take(self) -> list[Change]:
        """Remove and return the changes that wait. With the lock of the intake."""
        changes, self._changes = self._changes, []
        return changes

    def follow(self, changes: list[Change]) -> None:
        """Subscribe on the bus while somebody outside reads a topic."""
        for topic, n in changes:
            self._n_readers[topic] += n
            is_wanted = self._n_readers[topic] > 0
            if is_wanted and topic not in self._stops:
                self._subscribe(topic)
            elif not is_wanted and topic in self._stops:
                self._stops.pop(topic)()

    def close(self) -> None:
        """End all subscriptions."""
        for stop in self._stops.values():
            stop()
        self._stops.clear()

    def _subscribe(self, topic: str) -> None:
        if self._bus.is_withheld(topic):
            self._log.say(f"/{topic} is for observers of the run; it is not sent")
            return

        def receive(message: object) -> None:
            if self._goes_out(message):
                self.n_sent += 1
                self._send(topic, message)

        self._stops[topic] = self._bus.subscribe(topic, object, receive, owner=self._owner)
