"""A queue of events, in the order of their times, then of their ranks, then of insertion."""

from __future__ import annotations

import heapq
from dataclasses import dataclass, field
from typing import Generic, TypeVar

from ..base.record import Record

NANOSECONDS = 1_000_000_000
"""The number of nanoseconds in a second."""

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


@dataclass(slots=True)
class EventsState(Record, Generic[T]):
    """The state of a queue of events."""

    heap: list[_Entry[T]] = field(default_factory=list)
    """The future events, as a heap (`heapq`)."""
    n_added: int = 0
    """The number of events added so far; it numbers them."""


class EventQueue(Generic[T]):
    """A queue of events with integer times [ns]."""

    def __init__(self) -> None:
        self.state: EventsState[T] = EventsState()
        """The state of the queue."""

    def add(self, time: int, event: T, *, rank: int = 0) -> None:
        """Add an event at ``time`` [ns]; at equal times the lowest rank comes first."""
        self.state.n_added += 1
        heapq.heappush(self.state.heap, _Entry(time, rank, self.state.n_added, event))

    def __len__(self) -> int:
        return len(self.state.heap)

    def take(self, latest_time: int) -> tuple[int, T] | None:
        """Remove and return the next event with its time, if not after ``latest_time`` [ns]."""
        if not self.state.heap or self.state.heap[0].time > latest_time:
            return None
        entry = heapq.heappop(self.state.heap)
        return entry.time, entry.event
