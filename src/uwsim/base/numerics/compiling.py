"""A count of the functions that a process compiles, to report a slow first start on a machine."""

from __future__ import annotations

from collections.abc import Callable

from ..interrupts import raise_pending_interrupt

SLOW_START_COUNT = 3
"""The number of compiled functions from which a start counts as slow; each takes up to 2 s."""
_listeners: list[Callable[[], None]] = []
_n_compiled = 0


def on_slow_start(callback: Callable[[], None]) -> None:
    """Call ``callback`` once if this process compiles `SLOW_START_COUNT` functions."""
    _listeners[:] = [callback]


def count_compilation() -> None:
    """Count a function that will be compiled, because the cache on disk does not contain it.

    A pending interrupt is raised here, because the compilation of one function may take seconds.
    """
    raise_pending_interrupt()
    global _n_compiled
    _n_compiled += 1
    if _n_compiled >= SLOW_START_COUNT and _listeners:
        _listeners.pop()()
