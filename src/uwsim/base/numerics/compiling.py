"""Word of functions that are compiled: the first start on a machine takes long, others do not."""

from __future__ import annotations

from collections.abc import Callable

from ..interrupts import raise_pending_interrupt

SLOW_START_COUNT = 3
"""So many functions make a start a slow one; a single one takes less than a second or two."""
_listeners: list[Callable[[], None]] = []
_n_compiled = 0


def on_slow_start(callback: Callable[[], None]) -> None:
    """Have ``callback`` called once if this process compiles `SLOW_START_COUNT` functions."""
    _listeners[:] = [callback]


def count_compilation() -> None:
    """Count a function that is not on the disk: what follows compiles it.

    Between two functions is where an interrupt can come in: numba works for seconds at each.
    """
    raise_pending_interrupt()
    global _n_compiled
    _n_compiled += 1
    if _n_compiled >= SLOW_START_COUNT and _listeners:
        _listeners.pop()()
