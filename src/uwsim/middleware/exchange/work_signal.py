"""The signal to the simulation that external programs have sent messages or calls."""

from __future__ import annotations

import threading


class WorkSignal:
    """The lock, flags and wake-up event shared by the queues of a `Bridge`."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        """The lock for adding to a queue, and for taking from it."""
        self.has_work = False
        """True if messages, calls, or changes of subscribers or services, are pending, which the
        simulation handles at the next step boundary."""
        self.is_urgent = False
        """True if calls, or changes of subscribers and services, are pending, which are handled
        even while the simulation waits for a client."""
        self.is_closed = False
        """True if no more messages or calls are accepted."""
        self._wake_event = threading.Event()

    def mark_urgent(self) -> None:
        """Note that urgent work is pending. May be called from any thread that holds the lock."""
        self.has_work = self.is_urgent = True

    def wake(self) -> None:
        """Wake the simulation, if it waits. May be called from any thread."""
        self._wake_event.set()

    def wait(self, limit_s: float) -> None:
        """Wait for `wake`, at most ``limit_s``. Called in the thread of the simulation."""
        self._wake_event.wait(limit_s)
        self._wake_event.clear()
