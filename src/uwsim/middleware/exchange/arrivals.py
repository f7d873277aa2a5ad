"""Messages from outside that wait for the next step boundary, or are handed on at once."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

from ..log import Log
from ..queues import LatestQueue
from .intake import Intake

Message = tuple[object, str]
"""A message, and who sent it."""
Tap = Callable[[object, str], None]
"""Called with a message, and who sent it."""


class Arrivals:
    """Bounded queues of messages by topic, of which the newest are kept.

    Args:
        log: where floods of messages are reported.
        intake: of the bridge.
    """

    def __init__(self, log: Log, intake: Intake) -> None:
        self._log, self._intake = log, intake
        self._incoming: dict[str, LatestQueue[Message]] = {}
        self._taps: dict[str, list[Tap]] = {}
        self.n_arrived: Counter[str] = Counter()
        """Messages that have come from outside so far, by topic."""

    def tap(self, topic: str, receive: Tap) -> None:
        """Call ``receive`` with each message of a topic from outside, at once, in its thread.

        Those that wait already come first, in this thread.
        """
        name = topic.lstrip("/")
        with self._intake.lock:
            waiting = self._incoming.pop(name, None)
            self._taps.setdefault(name, []).append(receive)
        for message, by in waiting.take() if waiting is not None else ():
            receive(message, by)

    def is_tapped(self, name: str) -> bool:
        """Whether the messages of a topic are handed on at once. Any thread."""
        return name in self._taps

    def add(self, name: str, message: object, by: str, size: int) -> None:
        """Add a message of ``size`` bytes, which ``by`` has sent. Any thread."""
        with self._intake.lock:
            if self._intake.is_closed:
                return
            is_full = 0
            taps = list(self._taps.get(name, ()))
            if not taps:
                is_full = self._incoming.setdefault(name, LatestQueue()).put((message, by), size)
                self.n_arrived[name] += 1
                self._intake.has_news = True
        for receive in taps:
            receive(message, by)
        self._intake.wake()
        if is_full:
            self._log.say(
                f"/{name}: messages come faster than the simulation takes them; the oldest are "
                "dropped",
                kind=f"flood {name}",
            )

    def take(self) -> dict[str, LatestQueue[Message]]:
        """Remove and return what waits, by topic. With the lock of the intake."""
        incoming, self._incoming = self._incoming, {}
        return incoming
