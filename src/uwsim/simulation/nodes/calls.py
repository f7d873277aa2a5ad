"""Calls into an algorithm, counted in memory shared with the parent process.

The counter remains readable when the process dies: an odd number means that a call of the algorithm
has not returned. The parent runs the trial again without that call: everything before it is the
same, and the algorithm is not called any more.
"""

from __future__ import annotations

from dataclasses import dataclass
from types import TracebackType
from typing import Protocol

NO_CALLS = 0
"""The value of a counter before the first call."""


class Counter(Protocol):
    """A number that outlives this process."""

    value: int
    """``2 n + 1`` within call number n, ``2 n + 2`` after it."""


@dataclass(frozen=True)
class Cut:
    """The first call that is no longer made."""

    call: int
    """The number of the call."""
    reason: str
    """The failure of the call in the process before."""


class CallStopped(Exception):
    """An exception instead of a call: the algorithm is not called any more."""


class Calls:
    """The calls into an algorithm: each ``with`` block is one, with the calls made within it.

    Args:
        counter: the counter in shared memory; None: none.
        cut: the call that is not made.
        limit: the time limit of a call [s of wall time], if the algorithm has its own process;
            None: no limit.
    """

    def __init__(
        self,
        counter: Counter | None = None,
        cut: Cut | None = None,
        *,
        limit: float | None = None,
    ) -> None:
        self._counter, self._cut = counter, cut
        self.limit = limit
        """The time limit of a call [s of wall time]; None: no limit."""
        self._n, self._depth = 0, 0
        if counter is not None:
            counter.value = NO_CALLS

    def __enter__(self) -> None:
        """Begin a call; raises Stopped if it is the one that is not made."""
        if self._depth == 0:
            if self._cut is not None and self._n >= self._cut.call:
                raise CallStopped(self._cut.reason)
            if self._counter is not None:
                self._counter.value = 2 * self._n + 1
        self._depth += 1

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """End a call."""
        self._depth -= 1
        if self._depth == 0:
            self._n += 1
            if self._counter is not None:
                self._counter.value = 2 * self._n


def unfinished_call(count: int) -> int | None:
    """Return the number of the call that has not returned; None if there is none."""
    return count // 2 if count % 2 else None
