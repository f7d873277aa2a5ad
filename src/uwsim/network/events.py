"""A queue of events in the order of time, then rank, then insertion."""

from __future__ import annotations

import heapq
from dataclasses import dataclass, field
from typing import Generic, TypeVar

from ..base.record import Record

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


@dataclass(slots=True)
class EventsState(Record, Generic[T]):
    """The events of a queue."""

    heap: list[_Entry[T]] = field(default_factory=list)
    """The events, as a heap."""
    n_added: int = 0
    """The number of events added so far."""


class EventQueue(Generic[T]):
    """Events with integer times [ns]."""

    def __init__(self) -> None:
        self.state: EventsState[T] = EventsState()
        """The events."""

    def add(self, time: int, event: T, *, rank: int = 0) -> None:
        """Add an event at ``time`` [ns]; at equal times the lowest rank comes first."""
        self.state.n_added += 1
        heapq.heappush(self.state.heap, _Entry(time, rank, self.state.n_added, event))

    def __len__(self) -> int:
        return len(self.state.heap)

    def take(self, latest_time: int) -> tuple[int, T] | None:
        """Take out the next event and its time, if that is not after ``latest_time`` [ns]."""
        if not self.state.heap or self.state.heap[0].time > latest_time:
            return None
        entry = heapq.heappop(self.state.heap)
        return entry.time, entry.event
