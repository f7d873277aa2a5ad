"""The signal to the simulation that external programs have sent messages or calls."""

from __future__ import annotations

import threading


class WorkSignal:
    """The flags that the parts of a bridge share; the lock guards the queues of all parts."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        """The lock for adding to a queue, and for taking from it."""
        self.has_work = False
        """True if messages or calls wait for the next step boundary."""
        self.is_urgent = False
        """True if calls or changes wait that are handled even while the simulation waits."""
        self.is_closed = False
        """True if no more messages and calls are accepted."""
        self._wake_event = threading.Event()

    def mark_urgent(self) -> None:
        """Note that urgent work waits. Any thread that holds the lock."""
        self.has_work = self.is_urgent = True

    def wake(self) -> None:
        """Wake the simulation, if it waits. Any thread."""
        self._wake_event.set()

    def wait(self, limit_s: float) -> None:
        """Wait for `wake`, at most ``limit_s``. In the thread of the simulation."""
        self._wake_event.wait(limit_s)
        self._wake_event.clear()
