"""Endpoints of a node on rclpy, and the recognition of the node's own messages."""

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

Remove = Callable[[Any], None]
"""A function that removes an endpoint from the graph."""


class Echoes:
    """The hashes of messages that this node has sent on a topic that it also reads.

    They include latched messages, which a later reader of this node would receive. rclpy delivers
    such messages to the node itself, too, which then ignores them. Two equal messages need not be
    distinguished.
    """

    def __init__(self) -> None:
        self.n_readers = 0
        """The number of readers of this node."""
        self._hashes: deque[int] = deque(maxlen=MAX_ITEMS)
        self._lock = threading.Lock()

    def count_reader(self, change: int) -> None:
        """Count one more reader of this node (1), or one fewer (-1)."""
        with self._lock:
            self.n_readers += change

    def add(self, data: bytes) -> None:
        """Store the hash of a message that is being sent."""
        with self._lock:
            self._hashes.append(hash(data))

    def is_own(self, data: bytes) -> bool:
        """Return whether an arrived message was sent by this node, and remove its hash."""
        if not self._hashes:
            return False
        with self._lock:
            try:
                self._hashes.remove(hash(data))
            except ValueError:
                return False
            return True


class NullEndpoint:
    """An endpoint of a type that rclpy does not have."""

    n_writers = 0
    """The number of external writers."""

    def write(self, data: bytes) -> bool:
        """Discard a message, which has no readers; return True, as if it was accepted."""
        return True

    def close(self) -> None:
        """Do nothing."""


class RclpyWriter:
    """A publisher, and the number of its external readers."""

    publisher: Any

    def __init__(self, drop: Remove, echoes: Echoes, *, is_latched: bool) -> None:
        self._drop, self.echoes, self._is_latched = drop, echoes, is_latched
        self._on_readers: Callable[[int], None] = lambda n: None
        self._n, self._lock = 0, threading.Lock()

    def follow(self, on_readers: Callable[[int], None]) -> None:
        """Call ``on_readers`` with the number of external readers, when it changes."""
        self._on_readers = on_readers
        self.count_readers()

    def count_readers(self) -> None:
        """Count the external readers, and report a changed number."""
        with self._lock:
            try:
                n = max(0, self.publisher.get_subscription_count() - self.echoes.n_readers)
            except (InvalidHandle, AttributeError):  # destroyed already, or not created yet
                return
            if n != self._n:
                self._n = n
                self._on_readers(n)

    def write(self, data: bytes) -> bool:
        """Publish a message; the middleware keeps the newest for slow readers. Return True."""
        if self._is_latched or self.echoes.n_readers:
            self.echoes.add(data)
        try:
            self.publisher.publish(data)
        except InvalidHandle:  # destroyed meanwhile
            return True
        except RuntimeError as error:
            raise UwsimError(f"rclpy refuses a message: {error}") from error
        return True

    def wait(self, limit_s: float) -> None:
        """Wait until readers have acknowledged all messages, at most ``limit_s``."""
        with suppress(RuntimeError):  # not every middleware supports it
            self.publisher.wait_for_all_acked(Duration(seconds=max(0.0, limit_s)))

    def close(self) -> None:
        """Remove the writer from the graph."""
        self._drop(self)


class RclpyReader:
    """A subscription."""

    subscription: Any

    def __init__(self, drop: Remove, n_own: Callable[[], int]) -> None:
        self._drop, self._n_own = drop, n_own
        self.is_open = True
        """True if the reader accepts messages."""

    @property
    def n_writers(self) -> int:
        """The number of external writers that match the reader."""
        n_publishers: int = self.subscription.get_publisher_count()
        return max(0, n_publishers - self._n_own())

    def close(self) -> None:
        """Remove the reader from the graph."""
        self.is_open = False
        self._drop(self.subscription)


class RclpyServer:
    """A service that the node offers."""

    def __init__(self, drop: Remove, service: Any) -> None:
        self._drop, self._service = drop, service

    def close(self) -> None:
        """Withdraw the service."""
        self._drop(self._service)


def profile(quality: Quality) -> Any:
    """Convert a quality of service for rclpy."""
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST if quality.depth else HistoryPolicy.KEEP_ALL,
        depth=quality.depth,  # without effect with KEEP_ALL
        reliability=ReliabilityPolicy.RELIABLE
        if quality.is_reliable
        else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL
        if quality.is_latched
        else DurabilityPolicy.VOLATILE,
    )
