"""The rate of messages on each topic, in simulation time, as ``rostopic hz`` reports it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from ...bus import OBSERVER, Bus


@dataclass(frozen=True, kw_only=True)
class TopicRate:
    """The number and rate of the messages of one topic."""

    topic: str
    """The name of the topic, with a leading slash."""
    message_type: str
    """The name of the message type, ``package/msg/Name``."""
    is_published: bool
    """True if the process publishes on the topic; else it only has subscribers."""
    n_messages: int | None = None
    """The number of messages; None if they were not read."""
    rate: float | None = None
    """The mean rate [Hz]; None with fewer than two messages."""
    min_gap: float | None = None
    """The shortest time between two messages [s]."""
    max_gap: float | None = None
    """The longest time between two messages [s]."""
    std_gap: float | None = None
    """The standard deviation of the times between messages [s]."""


class TopicRates:
    """The rates of messages on every topic of a bus.

    Args:
        bus: the bus, including topics that are created later.
        clock: a function that returns the simulation time [s].
        is_counted: a function that returns whether to count the messages of a type. Topics of other
            types are listed without numbers; no image is rendered for them.
    """

    def __init__(
        self,
        bus: Bus,
        clock: Callable[[], float],
        *,
        is_counted: Callable[[type], bool] = lambda type: True,
    ) -> None:
        self._bus = bus
        self._clock = clock
        self._gaps: dict[str, _Gaps] = {}
        self._is_counted = is_counted
        bus.observe(self._count)

    def _count(self, topic: str, type: type) -> None:
        if not self._is_counted(type):
            return
        gaps = self._gaps[topic] = _Gaps()
        self._bus.subscribe(topic, type, lambda message: gaps.add(self._clock()), owner=OBSERVER)

    def rates(self) -> list[TopicRate]:
        """Return the rate of each topic, sorted by name."""
        return [self._rate_of(topic, type_name) for topic, type_name in self._bus.topics.items()]

    def _rate_of(self, topic: str, type_name: str) -> TopicRate:
        is_published = self._bus.describe_missing_publisher(topic) is None
        topic_rate = TopicRate(topic=f"/{topic}", message_type=type_name, is_published=is_published)
        return self._gaps[topic].add_statistics(topic_rate) if topic in self._gaps else topic_rate


class _Gaps:
    """The statistics of the times between the messages of a topic."""

    def __init__(self) -> None:
        self._n, self._first_time, self._last_time = 0, math.nan, math.nan
        self._squares = 0.0
        self._min_gap, self._max_gap = math.inf, 0.0

    def add(self, now: float) -> None:
        if self._n:
            gap = now - self._last_time
            self._squares += gap * gap
            self._min_gap, self._max_gap = min(self._min_gap, gap), max(self._max_gap, gap)
        else:
            self._first_time = now
        self._n, self._last_time = self._n + 1, now

    def add_statistics(self, topic_rate: TopicRate) -> TopicRate:
        rate = replace(topic_rate, n_messages=self._n)
        n_gaps, span = self._n - 1, self._last_time - self._first_time
        if n_gaps < 1:
            return rate
        mean = span / n_gaps
        return replace(
            rate,
            rate=n_gaps / span if span > 0.0 else None,
            min_gap=self._min_gap,
            max_gap=self._max_gap,
            std_gap=math.sqrt(max(0.0, self._squares / n_gaps - mean * mean)),
        )
