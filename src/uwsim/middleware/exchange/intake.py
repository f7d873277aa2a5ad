"""Whether something has come from outside, and what wakes the simulation for it."""

from __future__ import annotations

import threading


class Intake:
    """The state that the parts of a bridge share; its lock guards what waits in each of them."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        """Held while something is added to what waits, or taken from it."""
        self.has_news = False
        """Whether something waits for the next step boundary."""
        self.is_urgent = False
        """Whether something waits that is done also while the simulation waits."""
        self.is_closed = False
        """Whether nothing more is taken in."""
        self._woken = threading.Event()

    def add_urgent(self) -> None:
        """Note that something urgent waits. Any thread that holds the lock."""
        self.has_news = self.is_urgent = True

    def wake(self) -> None:
        """Have the simulation look again, if it waits. Any thread."""
        self._woken.set()

    def wait(self, limit_s: float) -> None:
        """Wait until `wake` was called, at most ``limit_s``. In the thread of the simulation."""
        self._woken.wait(limit_s)
        self._woken.clear()
