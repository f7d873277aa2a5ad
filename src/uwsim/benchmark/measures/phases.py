"""The phases of a task that an algorithm under test publishes, and the duration of each phase."""

from __future__ import annotations

from collections.abc import Sequence

from ...base.inbox import Inbox
from ...messages import String
from ...world import World

ABORT_NAME = "aborted"
"""The name in a message ``aborted: why``, with which the algorithm gives up."""


class Phases:
    """A subscription to the topic on which an algorithm publishes its present phase.

    A message is the name of a phase, optionally followed by ``: details``; unknown names are
    ignored. ``aborted: why`` states that the algorithm gave up.

    Args:
        names: the names of the phases, in their order.
        world: the simulation, whose time is measured.
        inbox: the received messages; None: the algorithm publishes no phases.
    """

    def __init__(self, names: Sequence[str], world: World, inbox: Inbox[String] | None) -> None:
        self._names, self._world, self._inbox = list(names), world, inbox
        self._durations = dict.fromkeys(self._names, 0.0)  # of each phase [s]
        self._name: str | None = None  # the present phase
        self._last_time = world.time  # up to which the durations are complete [s]
        self._max_number = 0  # of the farthest phase; 1 is the first
        self.abort_reason: str | None = None
        """The reason why the algorithm gave up; None: it did not give up."""

    def update(self) -> None:
        """Read the messages since the last call."""
        if self._inbox is None:
            return
        for message in self._inbox.take():
            name, _, details = (part.strip() for part in message.data.partition(":"))
            if name == ABORT_NAME:
                self.abort_reason = self.abort_reason or (details or "the algorithm gave up")[:200]
            elif name in self._durations:
                self._add_time()
                self._name = name
                self._max_number = max(self._max_number, self._names.index(name) + 1)

    def _add_time(self) -> None:
        time = self._world.time
        if self._name is not None:
            self._durations[self._name] += time - self._last_time
        self._last_time = time

    @property
    def name(self) -> str | None:
        """The present phase; None before the first message."""
        return self._name

    @property
    def number(self) -> int:
        """The number of the present phase: 1 is the first phase, 0 is before the first message."""
        return 0 if self._name is None else self._names.index(self._name) + 1

    @property
    def is_at_first(self) -> bool:
        """True if the first phase was reached, and no later one."""
        return self._max_number == 1

    @property
    def details(self) -> dict[str, float | None]:
        """The number of the farthest phase (1 is the first), and the duration of each phase [s]."""
        if not self._names:
            return {}
        self._add_time()
        return {
            "phase": float(self._max_number),
            **{f"time.{name}": self._durations[name] for name in self._names},
        }

    def close(self) -> None:
        """Unsubscribe."""
        if self._inbox is not None:
            self._inbox.close()
