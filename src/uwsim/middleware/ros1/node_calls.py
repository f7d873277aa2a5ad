"""Calls of many nodes, of which some answer slowly or never."""

from __future__ import annotations

import threading
from collections.abc import Callable
from queue import SimpleQueue

MAX_THREADS = 32
"""Nodes that are called at the same time."""


class NodeCalls:
    """Makes calls in daemon threads: of each node one at a time, in their order.

    So a node that does not answer takes one thread, and holds up no other node and no exit.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiting: dict[str, dict[str, Callable[[], None]]] = {}  # of nodes with work, by key
        self._ready: SimpleQueue[str | None] = SimpleQueue()  # those whose next call may begin
        self._n_threads = 0
        self._is_closed = False

    def add(self, node: str, key: str, call: Callable[[], None]) -> None:
        """Make a call later, in the place of one with the same key that has not begun."""
        with self._lock:
            if self._is_closed:
                return
            if node not in self._waiting:
                self._waiting[node] = {}
                self._ready.put(node)
            self._waiting[node][key] = call
            if self._n_threads < min(MAX_THREADS, len(self._waiting)):
                self._n_threads += 1
                threading.Thread(target=self._run, name="ros1-master", daemon=True).start()

    def close(self) -> None:
        """Begin no more calls."""
        with self._lock:
            self._is_closed = True
            for _ in range(self._n_threads):
                self._ready.put(None)

    def _run(self) -> None:
        while (node := self._ready.get()) is not None and not self._is_closed:
            with self._lock:
                waiting = self._waiting[node]
                call = waiting.pop(next(iter(waiting)))
            call()
            with self._lock:
                if self._waiting[node]:
                    self._ready.put(node)
                else:
                    del self._waiting[node]
