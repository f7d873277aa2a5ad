"""The status of a row, from the algorithm's reports and its failures."""

from __future__ import annotations

from collections.abc import Sequence

from ...base.inbox import Inbox
from ...messages import String
from ...simulation import STOPPED, InProcessNode
from ..own_process.process import PROCESS_ENDED
from .triggered_measure import TriggeredMeasure

SIMULATION_ERROR = "simulation error"
"""Status of a level whose simulation failed, in it or before it: nothing of it is known."""
SILENCE = 1.0
"""A measure that waits longer than this for an estimate ends in ``timeout`` [s]."""


def was_stopped(name: str, why: str | None) -> bool:
    """Whether a row failed because its algorithm could not be called any more."""
    return why is not None and why.startswith(f"{name} {STOPPED} at ")


def ended_its_process(name: str, why: str | None) -> bool:
    """Whether that is because the algorithm ended its process."""
    return was_stopped(name, why) and f" s: {PROCESS_ENDED}" in str(why)


class StatusMonitor:
    """Follows the algorithm's status reports and its failures.

    ``lost: why`` holds until the algorithm reports ``tracking``. A level in which it was reported
    has the status ``lost``, and so has one at whose end it still holds; ``failed: why`` holds for
    good.
    """

    def __init__(self, node: InProcessNode, inbox: Inbox[String]) -> None:
        self._node, self._inbox = node, inbox
        self._is_lost: str | None = None  # why and when, until it tracks again
        self._was_lost: str | None = None  # the same of the first time in this level
        self.failed: str | None = None
        """Why and when it failed or raised."""

    @property
    def lost(self) -> str | None:
        """Why and when it was lost: in this level, or before and still."""
        return self._was_lost or self._is_lost

    def begin_level(self) -> None:
        """Reset the reports of the last level, but not those that still hold."""
        self._was_lost = None

    def listen(self, time: float) -> None:
        """Take note of what came in since the last call."""
        if self._inbox.last_message is None and self._node.error is None:
            return
        for message in self._inbox.take():
            state, _, why = message.data.partition(":")
            text = legible(f"{self._node.name} {state.strip()} at {time:g} s: {why.strip()}")
            if state.strip() == "lost":
                self._is_lost = self._is_lost or text
                self._was_lost = self._was_lost or text
            elif state.strip() == "tracking":
                self._is_lost = None
            elif state.strip() == "failed" and self.failed is None:
                self.failed = text
        if self._node.error is not None and self.failed is None:
            text = f"{self._node.name} {self._node.how} at {time:g} s: {self._node.error}"
            self.failed = legible(text)

    def status(
        self, measures: Sequence[TriggeredMeasure], *, overran: float | None, ended: str | None
    ) -> tuple[str, str | None]:
        """Status of a row and, unless it is ``ok``, why: the first that applies.

        An algorithm that declared itself lost or failed owes no more estimates. Where a measure
        judges the level as a task, its own status counts.

        Args:
            measures: those of the level.
            overran: a level without an interval was cut off after this [s].
            ended: what a measure ended the level for.
        """
        if self.failed is not None:
            return "algorithm error", self.failed
        for triggered in measures:
            if (said := triggered.measure.task_status) is not None:
                return said
        if overran is not None:
            return "timeout", f"stopOn did not go on within {overran:g} s"
        if self.lost is None:
            for triggered in measures:
                if triggered.measure.longest_silence > SILENCE:
                    why = triggered.measure.why
                    return "timeout", why or f"no estimate for more than {SILENCE:g} s"
        if ended is not None:
            return "collision", ended
        return ("ok", None) if self.lost is None else ("lost", self.lost)


def legible(text: str) -> str:
    """Return a text of an algorithm as one printable line of at most 300 characters."""
    line = "".join(c if c.isprintable() else repr(c)[1:-1] for c in text[:301])
    return line if len(line) <= 300 else line[:297] + "..."
