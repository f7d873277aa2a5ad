"""Endpoints of a node of rclpy, and how its own messages are distinguished from others'."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from typing import Any

from rclpy.duration import Duration
from rclpy.exceptions import InvalidHandle
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from ...errors import UwsimError
from ..queues import MAX_ITEMS
from .quality import Quality

Drop = Callable[[Any], None]
"""Takes what an endpoint is made of off the graph."""


class Echoes:
    """What this node has sent on a topic that it reads as well: rclpy gives it back to it.

    Messages are compared by their bytes. Of two equal ones it does not matter which was whose.
    """

    def __init__(self) -> None:
        self.n_readers = 0
        """Readers of this node."""
        self._sent: deque[int] = deque(maxlen=MAX_ITEMS)
        self._lock = threading.Lock()

    def count_reader(self, change: int) -> None:
        """One more reader of this node (1), or one fewer (-1)."""
        with self._lock:
            self.n_readers += change

    def add(self, data: bytes) -> None:
        """Note what is being sent."""
        with self._lock:
            self._sent.append(hash(data))

    def is_own(self, data: bytes) -> bool:
        """Whether a message that has come is one of ours, and forget it."""
        if not self._sent:
            return False
        with self._lock:
            try:
                self._sent.remove(hash(data))
            except ValueError:
                return False
            return True


class Nowhere:
    """An endpoint of a type that rclpy does not have."""

    n_writers = 0

    def write(self, data: bytes) -> bool:
        """Nobody reads it."""
        return True

    def close(self) -> None:
        """There is nothing to close."""


class RclpyWriter:
    """A publisher, and how many others read it."""

    publisher: Any

    def __init__(self, drop: Drop, echoes: Echoes, *, is_latched: bool) -> None:
        self._drop, self.echoes, self._is_latched = drop, echoes, is_latched
        self._on_readers: Callable[[int], None] = lambda n: None
        self._n, self._lock = 0, threading.Lock()

    def follow(self, on_readers: Callable[[int], None]) -> None:
        """Have ``on_readers`` called with the number of readers outside, when it changes."""
        self._on_readers = on_readers
        self.look()

    def look(self) -> None:
        """Count the readers outside."""
        with self._lock:
            try:
                n = max(0, self.publisher.get_subscription_count() - self.echoes.n_readers)
            except (InvalidHandle, AttributeError):  # gone already, or not there yet
                return
            if n != self._n:
                self._n = n
                self._on_readers(n)

    def write(self, data: bytes) -> bool:
        """Publish a message; the middleware keeps the newest for readers that are behind."""
        if self._is_latched or self.echoes.n_readers:
            self.echoes.add(data)
        try:
            self.publisher.publish(data)
        except InvalidHandle:  # gone meanwhile
            return True
        except RuntimeError as error:
            raise UwsimError(f"rclpy refuses a message: {error}") from error
        return True

    def wait(self, limit_s: float) -> None:
        """Wait until readers have acknowledged what was sent, at most ``limit_s``."""
        with suppress(RuntimeError):  # not every middleware can tell
            self.publisher.wait_for_all_acked(Duration(seconds=max(0.0, limit_s)))

    def close(self) -> None:
        """Take it off the graph."""
        self._drop(self)


class RclpyReader:
    """A subscription."""

    subscription: Any

    def __init__(self, drop: Drop, n_own: Callable[[], int]) -> None:
        self._drop, self._n_own = drop, n_own
        self.is_open = True
        """Whether it still takes messages."""

    @property
    def n_writers(self) -> int:
        """How many writers outside it reads."""
        found: int = self.subscription.get_publisher_count()
        return max(0, found - self._n_own())

    def close(self) -> None:
        """Take it off the graph."""
        self.is_open = False
        self._drop(self.subscription)


class RclpyServer:
    """A service."""

    def __init__(self, drop: Drop, service: Any) -> None:
        self._drop, self._service = drop, service

    def close(self) -> None:
        """Offer it no more."""
        self._drop(self._service)


def profile(quality: Quality) -> Any:
    """Return a quality of service for rclpy."""
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST if quality.depth else HistoryPolicy.KEEP_ALL,
        depth=quality.depth,
        reliability=ReliabilityPolicy.RELIABLE
        if quality.is_reliable
        else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL
        if quality.is_latched
        else DurabilityPolicy.VOLATILE,
    )
