"""A bounded queue between threads: the newest items stay, the oldest are dropped."""

from __future__ import annotations

import threading
from collections import deque
from typing import Generic, TypeVar

T = TypeVar("T")
MAX_ITEMS = 1000
"""The default of the maximum number of items."""
MAX_BYTES = 64 * 2**20
"""The default of the maximum size of all items [bytes]."""


class LatestQueue(Generic[T]):
    """A queue of at most ``max_items`` and ``max_bytes`` that keeps at least the newest item.

    `put` never waits, so that a slow reader delays no other thread.
    """

    def __init__(self, max_items: int = MAX_ITEMS, max_bytes: int = MAX_BYTES) -> None:
        self._max_items, self._max_bytes = max_items, max_bytes
        self._items: deque[tuple[T, int]] = deque()
        self._n_bytes = 0
        self._is_closed = False
        self._condition = threading.Condition()
        self.n_dropped = 0
        """The number of items dropped so far."""

    def put(self, item: T, size: int = 0) -> int:
        """Add an item of ``size`` bytes; return the number of items dropped for it."""
        with self._condition:
            if self._is_closed:
                return 0
            self._items.append((item, size))
            self._n_bytes += size
            n_dropped_before = self.n_dropped
            while len(self._items) > self._max_items or (
                self._n_bytes > self._max_bytes and len(self._items) > 1
            ):
                self._n_bytes -= self._items.popleft()[1]
                self.n_dropped += 1
            self._condition.notify()
            return self.n_dropped - n_dropped_before

    def get(self, timeout: float | None = None) -> T | None:
        """Wait for an item, remove and return the oldest; None if closed or after a timeout [s]."""
        with self._condition:
            self._condition.wait_for(lambda: bool(self._items) or self._is_closed, timeout)
            if not self._items:
                return None
            item, size = self._items.popleft()
            self._n_bytes -= size
            return item

    def take(self) -> list[T]:
        """Remove and return all items, oldest first."""
        with self._condition:
            items = [item for item, _ in self._items]
            self._items.clear()
            self._n_bytes = 0
            return items

    def close(self) -> None:
        """Accept no more items, and release waiting threads."""
        with self._condition:
            self._is_closed = True
            self._items.clear()
            self._n_bytes = 0
            self._condition.notify_all()

    @property
    def is_closed(self) -> bool:
        """True if the queue is closed."""
        return self._is_closed

    def __len__(self) -> int:
        with self._condition:  # during `put` there may be one item too many
            return len(self._items)
