"""What waits to be sent to a client: in order, bounded by number and bytes; the oldest go first."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

from .outgoing import Outgoing

MAX_BYTES = 64 * 2**20
"""So much may wait for one client."""
MAX_MESSAGES = 1000
"""So many may wait of one subscription; replies of services count as one."""


@dataclass(eq=False)
class Lane:
    """What waits of one subscription, or of the replies."""

    compression: str = "none"
    """How its messages are encoded."""
    length: int = MAX_MESSAGES
    """How many of them may wait."""
    items: deque[Outgoing | str] = field(default_factory=deque)
    """What waits, oldest first."""


class OutQueue:
    """Frames in the order in which they came; any thread may put, the writer takes.

    Args:
        wake: called when something came and nothing waited.
    """

    def __init__(self, wake: Callable[[], None]) -> None:
        self._wake = wake
        self._lock = threading.Lock()
        self._order: deque[Lane] = deque()
        self._n_bytes = 0
        self.n_dropped = 0
        """Messages that were dropped."""

    def put(self, lane: Lane, item: Outgoing | str) -> int:
        """Put an item at the end; returns how many messages were dropped for it."""
        with self._lock:
            before, was_empty = self.n_dropped, not self._order
            lane.items.append(item)
            self._order.append(lane)
            self._n_bytes += size_of(item)
            while len(lane.items) > lane.length or (
                self._n_bytes > MAX_BYTES and len(lane.items) > 1
            ):
                self._n_bytes -= size_of(lane.items.popleft())
                self._order.remove(lane)  # its oldest place
                self.n_dropped += 1
            dropped = self.n_dropped - before
        if was_empty:  # else the writer takes it before it waits
            self._wake()
        return dropped

    def take(self) -> tuple[Lane, Outgoing | str] | None:
        """Take out the oldest item; None if nothing waits."""
        with self._lock:
            if not self._order:
                return None
            lane = self._order.popleft()
            item = lane.items.popleft()
            self._n_bytes -= size_of(item)
            return lane, item

    def forget(self, lane: Lane) -> None:
        """Drop what waits of a lane."""
        with self._lock:
            self._n_bytes -= sum(map(size_of, lane.items))
            lane.items.clear()
            self._order = deque(each for each in self._order if each is not lane)


def size_of(item: Outgoing | str) -> int:
    """About how many bytes an item takes."""
    return item.size if isinstance(item, Outgoing) else len(item)
