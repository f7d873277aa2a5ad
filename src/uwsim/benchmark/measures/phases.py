"""The phases of an algorithm under test, as it publishes them, and how long each lasted."""

from __future__ import annotations

from collections.abc import Sequence

from ...base.inbox import Inbox
from ...messages import String
from ...world import World

GAVE_UP = "aborted"
"""A message ``aborted: why`` says that the algorithm gave up."""


class Phases:
    """Listens to a topic with the name of the present phase.

    A message is the name of a phase, with or without ``: more about it``; other names are no
    phase. ``aborted: why`` says that the algorithm gave up.

    Args:
        names: the phases that count, in their order.
        world: the simulation.
        inbox: what was published; None: nothing is.
    """

    def __init__(self, names: Sequence[str], world: World, inbox: Inbox[String] | None) -> None:
        self._names, self._world, self._inbox = list(names), world, inbox
        self._seconds = dict.fromkeys(self._names, 0.0)
        self._now: str | None = None
        self._since = world.time
        self._farthest = 0  # 1 is the first
        self.gave_up: str | None = None
        """Why the algorithm gave up; None: it did not."""

    def update(self) -> None:
        """Take note of what was published since the last call."""
        if self._inbox is None:
            return
        for message in self._inbox.take():
            name, _, more = (part.strip() for part in message.data.partition(":"))
            if name == GAVE_UP:
                self.gave_up = self.gave_up or (more or "the algorithm gave up")[:200]
            elif name in self._seconds:
                self._count()
                self._now = name
                self._farthest = max(self._farthest, self._names.index(name) + 1)

    def _count(self) -> None:
        """Add the time since the last look to the present phase."""
        time = self._world.time
        if self._now is not None:
            self._seconds[self._now] += time - self._since
        self._since = time

    @property
    def name(self) -> str | None:
        """The present phase; None before any."""
        return self._now

    @property
    def number(self) -> int:
        """Number of the present phase, 1 the first; 0 before any."""
        return 0 if self._now is None else self._names.index(self._now) + 1

    @property
    def is_at_first(self) -> bool:
        """Whether nothing but the first phase was ever reached."""
        return self._farthest == 1

    @property
    def details(self) -> dict[str, float | None]:
        """The number of the farthest phase, 1 the first, and the time in each [s]."""
        if not self._names:
            return {}
        self._count()
        return {
            "phase": float(self._farthest),
            **{f"time.{name}": self._seconds[name] for name in self._names},
        }

    def close(self) -> None:
        """Unsubscribe."""
        if self._inbox is not None:
            self._inbox.close()
