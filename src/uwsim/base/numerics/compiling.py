"""The count of functions that a process compiles: the first start on a machine is slow."""

from __future__ import annotations

from collections.abc import Callable

from ..interrupts import raise_pending_interrupt

SLOW_START_COUNT = 3
"""The number of compiled functions from which a start is slow; one takes up to two seconds."""
_listeners: list[Callable[[], None]] = []
_n_compiled = 0


def on_slow_start(callback: Callable[[], None]) -> None:
    """Call ``callback`` once if this process compiles `SLOW_START_COUNT` functions."""
    _listeners[:] = [callback]


def count_compilation() -> None:
    """Count a function that is compiled next, because it is not on the disk.

    A pending interrupt is raised here, between two functions; each takes numba seconds.
    """
    raise_pending_interrupt()
    global _n_compiled
    _n_compiled += 1
    if _n_compiled >= SLOW_START_COUNT and _listeners:
        _listeners.pop()()
