"""How often messages come on each topic, in simulation time, as ``rostopic hz`` reports it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from ...bus import OBSERVER, Bus


@dataclass(frozen=True, kw_only=True)
class TopicRate:
    """The messages of one topic."""

    topic: str
    """Name of the topic, with a leading slash."""
    message_type: str
    """``package/msg/Name``."""
    is_published: bool
    """Whether anything in the process publishes on it; else it only has subscribers."""
    n_messages: int | None = None
    """Messages that came; None where they were not read."""
    rate: float | None = None
    """Their mean rate [Hz]; None with fewer than two."""
    min_gap: float | None = None
    """Shortest time between two messages [s]."""
    max_gap: float | None = None
    """Longest time between two messages [s]."""
    std_gap: float | None = None
    """Standard deviation of the times between messages [s]."""


class TopicRates:
    """Counts the messages of every topic of a bus.

    Args:
        bus: whose topics are counted, those that come later included.
        clock: returns the simulation time [s].
        reads: whether to subscribe to topics of a message type; others are listed without
            numbers, and images that nothing else reads are not drawn.
    """

    def __init__(
        self,
        bus: Bus,
        clock: Callable[[], float],
        *,
        reads: Callable[[type], bool] = lambda type: True,
    ) -> None:
        self._bus = bus
        self._clock = clock
        self._gaps: dict[str, _Gaps] = {}
        self._reads = reads
        bus.observe(self._count)

    def _count(self, topic: str, type: type) -> None:
        if not self._reads(type):
            return
        gaps = self._gaps[topic] = _Gaps()
        self._bus.subscribe(topic, type, lambda message: gaps.add(self._clock()), owner=OBSERVER)

    def rates(self) -> list[TopicRate]:
        """Return what came on each topic, sorted by name."""
        return [self._of(topic, type_name) for topic, type_name in self._bus.topics.items()]

    def _of(self, topic: str, type_name: str) -> TopicRate:
        is_published = self._bus.without_publisher(topic) is None
        topic_rate = TopicRate(topic=f"/{topic}", message_type=type_name, is_published=is_published)
        return self._gaps[topic].counted(topic_rate) if topic in self._gaps else topic_rate


class _Gaps:
    """Times between messages, as sums."""

    def __init__(self) -> None:
        self._n, self._first, self._last = 0, math.nan, math.nan
        self._squares = 0.0
        self._least, self._greatest = math.inf, 0.0

    def add(self, now: float) -> None:
        if self._n:
            gap = now - self._last
            self._squares += gap * gap
            self._least, self._greatest = min(self._least, gap), max(self._greatest, gap)
        else:
            self._first = now
        self._n, self._last = self._n + 1, now

    def counted(self, topic_rate: TopicRate) -> TopicRate:
        counted = replace(topic_rate, n_messages=self._n)
        n_gaps, span = self._n - 1, self._last - self._first
        if n_gaps < 1:
            return counted
        mean = span / n_gaps
        return replace(
            counted,
            rate=n_gaps / span if span > 0.0 else None,
            min_gap=self._least,
            max_gap=self._greatest,
            std_gap=math.sqrt(max(0.0, self._squares / n_gaps - mean * mean)),
        )
