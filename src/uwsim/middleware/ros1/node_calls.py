"""Calls to many nodes, some of which answer slowly or never."""

from __future__ import annotations

import threading
from collections.abc import Callable
from queue import SimpleQueue

MAX_THREADS = 32
"""The maximum number of nodes that are called at the same time."""


class NodeCalls:
    """A queue of calls in daemon threads; each node is called one call at a time, in order.

    A node that does not answer occupies one thread, but delays neither calls to other nodes nor the
    end of the program.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._calls: dict[str, dict[str, Callable[[], None]]] = {}  # by node and key
        self._ready_nodes: SimpleQueue[str | None] = SimpleQueue()  # whose next call may begin
        self._n_threads = 0
        self._is_closed = False

    def add(self, node: str, key: str, call: Callable[[], None]) -> None:
        """Add a call to a node; it replaces a call with the same key that has not begun."""
        with self._lock:
            if self._is_closed:
                return
            if node not in self._calls:
                self._calls[node] = {}
                self._ready_nodes.put(node)
            self._calls[node][key] = call
            if self._n_threads < min(MAX_THREADS, len(self._calls)):
                self._n_threads += 1
                threading.Thread(target=self._run, name="ros1-master", daemon=True).start()

    def close(self) -> None:
        """Begin no more calls."""
        with self._lock:
            self._is_closed = True
            for _ in range(self._n_threads):
                self._ready_nodes.put(None)

    def _run(self) -> None:
        while (node := self._ready_nodes.get()) is not None and not self._is_closed:
            with self._lock:
                calls = self._calls[node]
                call = calls.pop(next(iter(calls)))
            call()
            with self._lock:
                if self._calls[node]:
                    self._ready_nodes.put(node)
                else:
                    del self._calls[node]
