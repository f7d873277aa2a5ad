"""The status of a level, from the algorithm's reports and failures and from the measures."""

from __future__ import annotations

from collections.abc import Sequence

from ...base.inbox import Inbox
from ...benchmark.measures.outcome import MISSED_STATUS
from ...messages import String
from ...simulation import STOPPED_VERB, InProcessNode
from ..own_process.process import PROCESS_ENDED
from .triggered_measure import TriggeredMeasure, find_outcome

SIMULATION_ERROR = "simulation error"
"""The status of a level in which, or before which, the simulation failed; it has no values."""
MAX_SILENCE = 1.0
"""The longest time for which a measure may wait for an estimate [s of simulation time]; after a
longer wait the status of the level is ``timeout``."""


def was_stopped(name: str, reason: str | None) -> bool:
    """Return whether the reason of a row is that its algorithm can no longer be called."""
    return reason is not None and reason.startswith(f"{name} {STOPPED_VERB} at ")


def ended_its_process(name: str, reason: str | None) -> bool:
    """Return whether the reason of a row is that the algorithm's process ended."""
    return was_stopped(name, reason) and f" s: {PROCESS_ENDED}" in str(reason)


class StatusMonitor:
    """A monitor of the algorithm's status reports and its failures.

    A report ``lost: reason`` holds until the algorithm reports ``tracking``. A level has the status
    ``lost`` if the loss was reported in it, or still holds at its end. A report ``failed: reason``
    holds for all later levels.

    Args:
        node: the node of the algorithm.
        inbox: the messages on the topic of status reports.
    """

    def __init__(self, node: InProcessNode, inbox: Inbox[String]) -> None:
        self._node, self._inbox = node, inbox
        # the reason and time of a loss that still holds, and of the first loss in this level
        self._current_loss: str | None = None
        self._first_loss: str | None = None
        self.failure: str | None = None
        """The reason and time of the algorithm's failure or exception; None without a failure."""

    @property
    def lost(self) -> str | None:
        """The reason and time of the first loss in this level, or of an earlier one that holds."""
        return self._first_loss or self._current_loss

    def begin_level(self) -> None:
        """Reset the reports of the last level, except those that still hold."""
        self._first_loss = None

    def read_reports(self, time: float) -> None:
        """Read the reports since the last call; ``time`` is the simulation time [s]."""
        if self._inbox.last_message is None and self._node.error is None:
            return
        for message in self._inbox.take():
            state, _, reason = message.data.partition(":")
            text = to_line(f"{self._node.name} {state.strip()} at {time:g} s: {reason.strip()}")
            if state.strip() == "lost":
                self._current_loss = self._current_loss or text
                self._first_loss = self._first_loss or text
            elif state.strip() == "tracking":
                self._current_loss = None
            elif state.strip() == "failed" and self.failure is None:
                self.failure = text
        if self._node.error is not None and self.failure is None:
            text = f"{self._node.name} {self._node.failure_verb} at {time:g} s: {self._node.error}"
            self.failure = to_line(text)

    def status(
        self, measures: Sequence[TriggeredMeasure], *, cutoff: float | None, ending: str | None
    ) -> tuple[str, str | None]:
        """Return the first status of a row that applies and, unless it is ``ok``, its reason.

        An algorithm that reported itself lost or failed need not send estimates. If a measure
        assesses the level as a task, the status of that measure counts. If there is an outcome, the
        level has its declared failures first, then those of the algorithm's estimates and reports.

        Args:
            measures: the measures of the level.
            cutoff: the time after which a level that only stopOn ends was cut off [s of simulation
                time]; None if it was not cut off.
            ending: the reason for which a measure ended the level; None if no measure did.
        """
        if self.failure is not None:
            return "algorithm error", self.failure
        outcome = find_outcome(measures)
        tasks = [measure.measure for measure in measures] if outcome is None else [outcome]
        task_status = next((s for task in tasks if (s := task.task_status) is not None), None)
        if task_status is not None and (
            outcome is None or task_status[0] not in ("ok", MISSED_STATUS)
        ):
            return task_status
        if cutoff is not None:
            return "timeout", f"stopOn did not go on within {cutoff:g} s"
        if self.lost is None:
            for measure in measures:
                if measure.measure.longest_silence > MAX_SILENCE:
                    reason = measure.measure.missing_reason
                    return "timeout", reason or f"no estimate for more than {MAX_SILENCE:g} s"
        if ending is not None and (task_status is None or _is_ended_by_contact(measures)):
            return "collision", ending
        if self.lost is not None:
            return "lost", self.lost
        return task_status or ("ok", None)


def _is_ended_by_contact(measures: Sequence[TriggeredMeasure]) -> bool:
    """Return whether a measure that assesses no task ended the level."""
    judges = (m.measure for m in measures if m.measure.ends_level is not None)
    return any(measure.task_status is None for measure in judges)


def to_line(text: str) -> str:
    """Return a text of an algorithm as one printable line of at most 300 characters."""
    line = "".join(c if c.isprintable() else repr(c)[1:-1] for c in text[:301])
    return line if len(line) <= 300 else line[:297] + "..."
