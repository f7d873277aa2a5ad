"""The ranks of algorithms over tasks, from the success under equal seeds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...results.per_level import round_level, rows_by_level, seeds_of
from ...statistics import Rank, Strength, bradley_terry, count_wins, paired_ranks
from ...statistics.ranking import Scores
from ..comparison import Entry
from .tasks import OverviewTask, algorithm_names


@dataclass(frozen=True, kw_only=True)
class TaskRanks:
    """The ranks of all algorithms over the tasks that all of them ran."""

    algorithms: tuple[str, ...]
    """The names of the algorithms, by rank and then by score."""
    ranks: tuple[Rank, ...]
    """The rank of each; the score is the share of trials that ended ``ok`` [1]."""
    strengths: tuple[Strength, ...]
    """The strength of each after Bradley and Terry, a game being a task; empty for one task."""
    tasks: tuple[str, ...]
    """The names of the tasks that count."""
    n_seeds: tuple[int, ...]
    """The number of seeds in each of these tasks that all algorithms have at all levels."""


def rank_algorithms(
    tasks: Sequence[OverviewTask], *, absent_tasks_fail: bool = False
) -> TaskRanks | None:
    """Rank the algorithms over the tasks that all ran under some equal seeds; None without any.

    The score of a seed is the share of the levels that ended ``ok``, over the levels that all
    algorithms ran.

    Args:
        tasks: the results by task.
        absent_tasks_fail: True to rank over all tasks; an algorithm has the score 0 in a task that
            it did not run.
    """
    names = algorithm_names(tasks)
    scores = {
        task.name: _scores(task, names, absent_tasks_fail=absent_tasks_fail) for task in tasks
    }
    arrays = {name: array for name, array in scores.items() if array is not None}
    if len(names) < 2 or not arrays:
        return None
    ranks = paired_ranks(list(arrays.values()))
    has_games = len(arrays) > 1
    strengths = bradley_terry(count_wins(list(arrays.values()))) if has_games else ()
    order = sorted(range(len(names)), key=lambda i: (ranks[i].rank, -ranks[i].score))
    return TaskRanks(
        algorithms=tuple(names[i] for i in order),
        ranks=tuple(ranks[i] for i in order),
        strengths=tuple(strengths[i] for i in order) if has_games else (),
        tasks=tuple(arrays),
        n_seeds=tuple(array.shape[1] for array in arrays.values()),
    )


def _scores(task: OverviewTask, names: Sequence[str], *, absent_tasks_fail: bool) -> Scores | None:
    """Return the share of levels that ended ``ok``, (n_algorithms, n_seeds); None if not shared."""
    entries = {entry.name: entry for entry in task.entries}
    if set(entries) != set(names):
        present_names = [name for name in names if name in entries]
        scores = _scores(task, present_names, absent_tasks_fail=False) if present_names else None
        if scores is None or not absent_tasks_fail:
            return None
        rows = dict(zip(present_names, scores, strict=True))
        return np.array([rows.get(name, np.zeros(scores.shape[1])) for name in names])
    flags = [_flags(entries[name]) for name in names]
    levels = set.intersection(*({level for _, level in flag} for flag in flags))
    seeds = sorted(
        seed
        for seed in {seed for seed, _ in flags[0]}
        if all((seed, level) in flag for flag in flags for level in levels)
    )
    if not seeds or not levels:
        return None
    return np.array(
        [
            [sum(flag[seed, level] for level in sorted(levels)) / len(levels) for seed in seeds]
            for flag in flags
        ]
    )


def _flags(entry: Entry) -> dict[tuple[int, tuple[float, ...]], float]:
    """Return the share of ``ok`` for each seed and level, usually of one row."""
    result = entry.result
    status = result.values(result.columns_of_kind("status")[0].name)
    seeds = seeds_of(result)
    outcomes: dict[tuple[int, tuple[float, ...]], list[bool]] = {}
    for level, rows in rows_by_level(result).items():
        for row in rows:
            if (seed := seeds[row]) is not None:
                outcomes.setdefault((seed, round_level(level)), []).append(status[row] == "ok")
    return {key: sum(flags) / len(flags) for key, flags in outcomes.items()}
