"""Calls of an algorithm's methods, counted in memory that is shared with the parent process.

The counter stays readable when the process of the algorithm dies: an odd number means that a call
has not returned. The parent then runs the trial again up to that call: everything before it is the
same, and the algorithm is not called any more.
"""

from __future__ import annotations

from dataclasses import dataclass
from types import TracebackType
from typing import Protocol

NO_CALLS = 0
"""The value of the counter before the first call."""


class Counter(Protocol):
    """A number in memory that stays readable when this process has died."""

    value: int
    """``2 n + 1`` during call number n (from 0), ``2 n + 2`` after it."""


@dataclass(frozen=True)
class Cut:
    """The call before which a repeated trial stops calling the algorithm."""

    call: int
    """The number of the first call that is not made, from 0."""
    reason: str
    """The failure of that call in the earlier process."""


class CallStopped(Exception):
    """An exception raised in place of a call, as the algorithm is not called any more."""


class Calls:
    """A counter of the calls of an algorithm: each outermost ``with`` block is one call.

    Args:
        counter: the counter in shared memory; None: the calls are not reported.
        cut: the first call that is not made; None: all calls are made.
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
        """Begin a call; raise CallStopped from the call of ``cut`` on."""
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
    """Return the number of the call that has not returned; None if all have returned.

    Args:
        count: the value of a `Counter`.
    """
    return count // 2 if count % 2 else None
