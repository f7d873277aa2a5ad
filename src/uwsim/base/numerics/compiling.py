"""A count of the functions that a process compiles, to report a slow first start on a machine."""

from __future__ import annotations

import sys
from collections.abc import Callable

from ..interrupts import raise_pending_interrupt

SLOW_START_COUNT = 3
"""The number of compiled functions from which a start counts as slow; each takes up to 2 s."""
COMPILATION_MESSAGE = "uwsim: compiling for this processor (up to a minute, the first time only)"


def report_compilation() -> None:
    """Print to a terminal that the start takes longer because of compilation.

    Worker processes print nothing, so that a terminal has the line once.
    """
    import multiprocessing

    if sys.stderr.isatty() and multiprocessing.parent_process() is None:
        print(COMPILATION_MESSAGE, file=sys.stderr)


_listeners: list[Callable[[], None]] = [report_compilation]
_n_compiled = 0


def on_slow_start(callback: Callable[[], None]) -> None:
    """Call ``callback`` once if this process compiles `SLOW_START_COUNT` functions.

    By default this is `report_compilation`.
    """
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
