"""A queue of events in the order of time, then rank, then insertion."""

from __future__ import annotations

import heapq
from dataclasses import dataclass, field
from typing import Generic, TypeVar

NANOSECONDS = 1_000_000_000

T = TypeVar("T")


def nanoseconds(time: float) -> int:
    """Return a time [s] in nanoseconds, to the nearest."""
    return round(time * NANOSECONDS)


@dataclass(order=True, frozen=True)
class _Entry(Generic[T]):
    time: int
    rank: int
    number: int
    event: T = field(compare=False)


class EventQueue(Generic[T]):
    """Events with integer times [ns]."""

    STATE = ("_heap", "_n_added")
    """Attributes of its state, for snapshots."""

    def __init__(self) -> None:
        self._heap: list[_Entry[T]] = []
        self._n_added = 0

    def add(self, time: int, event: T, *, rank: int = 0) -> None:
        """Add an event at ``time`` [ns]; at equal times the lowest rank comes first."""
        self._n_added += 1
        heapq.heappush(self._heap, _Entry(time, rank, self._n_added, event))

    def __len__(self) -> int:
        return len(self._heap)

    def take(self, until: int) -> tuple[int, T] | None:
        """Take out the next event and its time, if that is not after ``until`` [ns]."""
        if not self._heap or self._heap[0].time > until:
            return None
        entry = heapq.heappop(self._heap)
        return entry.time, entry.event
