"""The ranks of algorithms over tasks, from the success under equal seeds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...results.per_level import round_level, rows_by_level, seeds_of
from ...statistics import (
    Rank,
    Strength,
    bradley_terry,
    count_wins,
    holm,
    paired_p,
    paired_ranks,
    seeds_to_rank,
)
from ...statistics.ranking import Scores
from ..comparison import Entry
from .tasks import OverviewTask, algorithm_names

ALPHA = 0.05
"""The significance level of all statements on ranks [1]."""


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

    @property
    def note(self) -> str:
        """The sentence that the seeds are too few to show any difference; empty if they are not."""
        k, n_tasks, n = len(self.algorithms), len(self.tasks), min(self.n_seeds)
        needed_seeds = seeds_to_rank(k, n_tasks, alpha=ALPHA)
        if n >= needed_seeds or any(rank.n_better for rank in self.ranks):
            return ""
        tasks = "" if n_tasks == 1 else f" in each of {n_tasks} tasks"
        return (
            f"{n} seed{'s' * (n != 1)}{tasks} cannot separate {k} algorithms: "
            f"{needed_seeds} are needed. All are tied."
        )


@dataclass(frozen=True, kw_only=True)
class CommonTasks:
    """The comparison of two algorithms over the tasks that both ran under some equal seeds."""

    n_tasks: int
    """The number of these tasks."""
    first: float
    """The mean over these tasks of the share of trials that ended ``ok``, of the first [1]."""
    second: float
    """The same of the second [1]."""
    p: float | None
    """The p-value after Holm's correction; None if too few seeds differ for a test."""

    @property
    def verdict(self) -> str:
        """``better`` or ``worse`` if the first is shown to be, otherwise ``not shown``."""
        if self.p is None or self.p > ALPHA or self.first == self.second:
            return "not shown"
        return "better" if self.first > self.second else "worse"


def places_text(rank: Rank) -> str:
    """Return the interval of a place as text, ``2 to 4``; a dash without one."""
    if rank.low is None or rank.high is None:
        return "–"
    return str(rank.low) if rank.low == rank.high else f"{rank.low} to {rank.high}"


def rank_algorithms(tasks: Sequence[OverviewTask]) -> TaskRanks | None:
    """Rank the algorithms over the tasks that all ran under some equal seeds; None without any.

    The score of a seed is the share of the levels that ended ``ok``, over the levels that all
    algorithms ran.

    Args:
        tasks: the results by task.
    """
    names = algorithm_names(tasks)
    if len(names) < 2:
        return None
    scores = {task.name: _scores(task, names) for task in tasks}
    arrays = {name: array for name, array in scores.items() if array is not None}
    if not arrays:
        return None
    ranks = paired_ranks(list(arrays.values()), alpha=ALPHA)
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


def compare_algorithms(
    tasks: Sequence[OverviewTask], first: str, opponents: Sequence[str]
) -> dict[str, CommonTasks]:
    """Compare an algorithm with each of several others, over the tasks that both ran.

    The test is that of `uwsim.statistics.paired_ranks`, with Holm's correction over the opponents.
    Those without a common task, seed and level are left out.

    Args:
        tasks: the results by task.
        first: the name of the algorithm.
        opponents: the names of the others.
    """
    pairs: dict[str, list[Scores]] = {}
    for opponent in opponents:
        arrays = [_scores(task, (first, opponent)) for task in tasks]
        if shared_arrays := [array for array in arrays if array is not None]:
            pairs[opponent] = shared_arrays
    p_values = holm([paired_p([(a[0], a[1]) for a in arrays], ALPHA) for arrays in pairs.values()])
    means = {
        other: np.mean([array.mean(axis=1) for array in arrays], axis=0)
        for other, arrays in pairs.items()
    }
    return {
        other: CommonTasks(
            n_tasks=len(arrays), first=float(means[other][0]), second=float(means[other][1]), p=p
        )
        for (other, arrays), p in zip(pairs.items(), p_values, strict=True)
    }


def success_of(tasks: Sequence[OverviewTask], name: str) -> float:
    """Return the mean over the tasks of an algorithm of its share of trials that ended ``ok``."""
    arrays = [_scores(task, (name,)) for task in tasks]
    means = [float(array.mean()) for array in arrays if array is not None]
    return sum(means) / len(means) if means else 0.0


def _scores(task: OverviewTask, names: Sequence[str]) -> Scores | None:
    """Return the share of levels that ended ``ok``, (n_algorithms, n_seeds); None if not shared."""
    entries = {entry.name: entry for entry in task.entries}
    if not set(names) <= set(entries):
        return None
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
