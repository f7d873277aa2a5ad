"""The queue of messages to a client, limited in number and bytes; the oldest is sent first."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

from .outgoing import EncodedMessage

MAX_BYTES = 64 * 2**20
"""The size of all messages that wait for one client, above which older messages of the same
subscription are dropped [bytes]; one message of each subscription is always kept."""
MAX_MESSAGES = 1000
"""The maximum number of waiting messages of one subscription; replies count as one."""


@dataclass(eq=False)
class SubscriptionQueue:
    """The part of a client's queue with the messages of one subscription, or with the replies."""

    compression: str = "none"
    """The encoding of the messages."""
    max_length: int = MAX_MESSAGES
    """The maximum number of messages."""
    items: deque[EncodedMessage | str] = field(default_factory=deque)
    """The messages, oldest first."""


class OutQueue:
    """A queue of frames in order of arrival; any thread adds frames, the writer takes them.

    Args:
        wake: a function that is called when an item is added to the empty queue.
    """

    def __init__(self, wake: Callable[[], None]) -> None:
        self._wake = wake
        self._lock = threading.Lock()
        self._order: deque[SubscriptionQueue] = deque()
        self._n_bytes = 0
        self.n_dropped = 0
        """The number of messages dropped so far."""

    def put(self, queue: SubscriptionQueue, item: EncodedMessage | str) -> int:
        """Put an item at the end of a queue; return the number of messages dropped for it."""
        with self._lock:
            n_dropped_before, was_empty = self.n_dropped, not self._order
            queue.items.append(item)
            self._order.append(queue)
            self._n_bytes += size_of(item)
            while len(queue.items) > queue.max_length or (
                self._n_bytes > MAX_BYTES and len(queue.items) > 1
            ):
                self._n_bytes -= size_of(queue.items.popleft())
                self._order.remove(queue)  # the first entry, which is that of the dropped message
                self.n_dropped += 1
            n_dropped = self.n_dropped - n_dropped_before
        if was_empty:  # else the writer is awake already
            self._wake()
        return n_dropped

    def take(self) -> tuple[SubscriptionQueue, EncodedMessage | str] | None:
        """Remove and return the oldest item; None if the queue is empty."""
        with self._lock:
            if not self._order:
                return None
            queue = self._order.popleft()
            item = queue.items.popleft()
            self._n_bytes -= size_of(item)
            return queue, item

    def forget(self, queue: SubscriptionQueue) -> None:
        """Drop the messages of a subscription."""
        with self._lock:
            self._n_bytes -= sum(map(size_of, queue.items))
            queue.items.clear()
            self._order = deque(other for other in self._order if other is not queue)


def size_of(item: EncodedMessage | str) -> int:
    """Return the approximate size of an item [bytes]."""
    return item.size if isinstance(item, EncodedMessage) else len(item)
