"""Messages that arrive from outside: they wait for a step boundary, or are passed on at once."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

from ..log import Log
from ..queues import LatestQueue
from .work_signal import WorkSignal

Message = tuple[object, str]
"""A message, and its sender."""
Tap = Callable[[object, str], None]
"""A function that is called with a message and its sender."""


class Arrivals:
    """A bounded queue of arrived messages for each topic; the newest messages are kept.

    Args:
        log: the log for floods of messages.
        signal: the work signal of the bridge.
    """

    def __init__(self, log: Log, signal: WorkSignal) -> None:
        self._log, self._signal = log, signal
        self._queues: dict[str, LatestQueue[Message]] = {}
        self._taps: dict[str, list[Tap]] = {}
        self.n_arrived: Counter[str] = Counter()
        """The number of messages that have arrived so far, by topic."""

    def tap(self, topic: str, receive: Tap) -> None:
        """Call ``receive`` with each message of a topic at once, in the thread of its arrival.

        First, it is called with the messages that wait already, in the calling thread.
        """
        name = topic.lstrip("/")
        with self._signal.lock:
            queue = self._queues.pop(name, None)
            self._taps.setdefault(name, []).append(receive)
        for message, sender in queue.take() if queue is not None else ():
            receive(message, sender)

    def is_tapped(self, name: str) -> bool:
        """Return whether the messages of a topic are passed on at once.

        May be called from any thread.
        """
        return name in self._taps

    def add(self, name: str, message: object, sender: str, size: int) -> None:
        """Add a message of ``size`` bytes from ``sender``. May be called from any thread."""
        with self._signal.lock:
            if self._signal.is_closed:
                return
            n_dropped = 0
            taps = list(self._taps.get(name, ()))
            if not taps:
                queue = self._queues.setdefault(name, LatestQueue())
                n_dropped = queue.put((message, sender), size)
                self.n_arrived[name] += 1
                self._signal.has_work = True
        for receive in taps:
            receive(message, sender)
        self._signal.wake()
        if n_dropped:
            self._log.report(
                f"/{name}: messages arrive faster than the simulation reads them; the oldest are "
                "dropped",
                kind=f"flood {name}",
            )

    def take(self) -> dict[str, LatestQueue[Message]]:
        """Remove and return the queues, by topic. With the lock of the signal."""
        queues, self._queues = self._queues, {}
        return queues
