"""The times to success of the trials of a task, from the statuses and times of its rows."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ...results.result import Result
from ...statistics import TrialTime
from ..plots import repeats_of
from .cells import JUDGING_DETAIL

UNDECIDED_STATUSES = ("timeout", "simulation error")
"""The statuses of trials that end without success or failure: they are censored."""
MAX_DELAY = 1.0
"""The time after a success up to which its level ends [s]."""


def success_times(result: Result) -> tuple[TrialTime, ...] | None:
    """Return the time to success of each row [s of simulation time]; None without statuses.

    The time is that from the beginning of the level to its end. It counts as follows:

    - ``ok``: the trial succeeded at this time, or at the latest ``time_done`` of its measures
      [s after their start]: a level may go on after the success (`Outcome`).
    - ``timeout``, ``simulation error``: without success up to this time, and unknown after it.
    - any other status (``collision``, ``dropped``, ``lost``, ...): the trial failed for good. It
      counts as without success for ever, so its time is infinite. Censored at its end, it would
      count as if it could still have succeeded.

    Use it for results of tasks (`task_measure`), whose levels end with success.
    """
    status_columns, time_columns = (result.columns_of_kind(kind) for kind in ("status", "time"))
    if not status_columns or not time_columns:
        return None
    statuses = result.values(status_columns[0].name)
    durations = _durations(result, result.numbers(time_columns[0].name))
    trials = []
    for status, duration, done_time in zip(statuses, durations, _done_times(result), strict=True):
        if status == "ok":
            trials.append(TrialTime(time=min(duration, done_time), has_succeeded=True))
        else:
            time = duration if status in UNDECIDED_STATUSES else math.inf
            trials.append(TrialTime(time=time, has_succeeded=False))
    return tuple(trials)


def is_judged_at_end(result: Result) -> bool:
    """Return whether successes are judged at the end of a level, so that they have no time.

    That is so if an outcome alone judges (`Outcome`), and levels go on after its condition holds:
    to stay at a place is no event, and the condition may hold from the first step.
    """
    suffix = f".{JUDGING_DETAIL}"
    details = [column.name for column in result.columns_of_kind("detail")]
    judges = [name.removesuffix(suffix) for name in details if name.endswith(suffix)]
    if len(judges) != 1 or sum(name.startswith(f"{judges[0]}.") for name in details) > 1:
        return False
    times = result.numbers(result.columns_of_kind("time")[0].name)
    statuses = result.values(result.columns_of_kind("status")[0].name)
    return any(
        status == "ok" and done_time < duration - MAX_DELAY
        for status, duration, done_time in zip(
            statuses, _durations(result, times), _done_times(result), strict=True
        )
    )


def longest_level(result: Result) -> float:
    """Return the longest duration of a level of any row [s]; 0 without times."""
    columns = result.columns_of_kind("time")
    return max(_durations(result, result.numbers(columns[0].name)), default=0.0) if columns else 0.0


def time_limit(trials: Sequence[TrialTime]) -> float | None:
    """Return the latest finite time of any trial [s]: the time limit, or the last success."""
    return max((trial.time for trial in trials if math.isfinite(trial.time)), default=None)


def restricted_time(trial: TrialTime, limit: float) -> float | None:
    """Return the time to success, at most ``limit`` [s]; None for a trial censored before.

    A trial without success up to the limit counts with the limit. The mean is the area above the
    curve of successes up to the limit (Royston and Parmar 2013).
    """
    if not trial.has_succeeded and trial.time < limit - 1e-6:
        return None
    return min(trial.time, limit)


def _done_times(result: Result) -> list[float]:
    """Return the latest ``time_done`` of the measures of each row [s]; infinite without one."""
    names = [
        column.name
        for column in result.columns_of_kind("detail")
        if column.name.endswith(f".{JUDGING_DETAIL}")
    ]
    columns = [result.numbers(name) for name in names]
    if not columns:
        return [math.inf] * len(result.rows)
    return [
        max((time for time in times if time is not None), default=math.inf)
        for times in zip(*columns, strict=True)
    ]


def _durations(result: Result, end_times: Sequence[float | None]) -> list[float]:
    """Return the duration of each row [s]; times of a sequence are summed over its levels."""
    if result.run.mode == "independent":
        return [max(0.0, time or 0.0) for time in end_times]
    last_times: dict[tuple[object, ...], float] = {}
    durations = []
    for repeat, time in zip(repeats_of(result), end_times, strict=True):
        start_time = last_times.get(repeat, 0.0)
        last_times[repeat] = start_time if time is None else time
        durations.append(max(0.0, last_times[repeat] - start_time))
    return durations
