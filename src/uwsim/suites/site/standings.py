"""The standings of submissions: ranks of those with all tasks, and comparisons with references.

A submission with a part of the tasks has no rank over all tasks: a task that was not run says
nothing about the algorithm. Neither have the references (baselines, experts and control conditions
of the suite), which are several algorithms under one name. Both are compared on common tasks.
A submission that nobody has verified has no rank at all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...analysis.overview.ranks import TaskRanks, rank_algorithms, success_of
from ...analysis.overview.tasks import OverviewTask
from ...statistics import Rank
from .board import Candidate


@dataclass(frozen=True, kw_only=True)
class Standings:
    """The submissions of one ranking, in three groups."""

    ranked_candidates: tuple[Candidate, ...]
    """The submissions with all tasks, by rank and then by success; in one task without any
    submission, the references."""
    ranks: TaskRanks | None
    """The ranks of these; None for fewer than two, or without a shared seed and level."""
    partial_candidates: tuple[Candidate, ...]
    """The submissions without all tasks, by the number of tasks and then by success."""
    references: tuple[Candidate, ...]
    """The references that are not ranked, in this order, too."""
    unverified_candidates: tuple[Candidate, ...]
    """The submissions that nobody has verified, which have no rank, in this order, too."""

    @property
    def all_candidates(self) -> tuple[Candidate, ...]:
        """The submissions of all groups."""
        return (
            *self.ranked_candidates,
            *self.partial_candidates,
            *self.references,
            *self.unverified_candidates,
        )

    def rank_of(self, candidate: Candidate) -> Rank | None:
        """Return the rank of a submission; None if it has none."""
        if self.ranks is None or candidate.name not in self.ranks.algorithms:
            return None
        return self.ranks.ranks[self.ranks.algorithms.index(candidate.name)]

    def rank_text(self, candidate: Candidate) -> str:
        """Return the rank as text: a dash for a submission that is not ranked."""
        rank = self.rank_of(candidate)
        if rank is not None:
            return str(rank.rank)
        return "1" if self.ranked_candidates == (candidate,) else "–"


def rank_candidates(candidates: Sequence[Candidate], tasks: Sequence[OverviewTask]) -> Standings:
    """Rank the verified submissions that have results of all tasks that a verified one ran.

    Args:
        candidates: the submissions.
        tasks: the tasks; their results of other submissions do not count. In one task without a
            submission, the references are ranked: each is one algorithm there.
    """
    names = {candidate.name for candidate in candidates}
    own_tasks = [select_entries(task, names) for task in tasks]
    success = {name: success_of(own_tasks, name) for name in names}
    n_tasks = {
        name: sum(any(e.name == name for e in task.entries) for task in own_tasks) for name in names
    }
    ordered_candidates = sorted(candidates, key=lambda c: (-n_tasks[c.name], -success[c.name]))
    verified_candidates = [c for c in ordered_candidates if c.is_verified]
    verified_names = {candidate.name for candidate in verified_candidates}
    n_required = sum(bool(select_entries(task, verified_names).entries) for task in own_tasks)
    ranks_references = len(tasks) == 1 and all(c.is_reference for c in verified_candidates)
    ranked_candidates = [
        candidate
        for candidate in verified_candidates
        if n_tasks[candidate.name] == n_required
        and (ranks_references or not candidate.is_reference)
    ]
    ranked_names = {candidate.name for candidate in ranked_candidates}
    ranked_tasks = [select_entries(task, ranked_names) for task in own_tasks]
    ranks = rank_algorithms([task for task in ranked_tasks if task.entries])
    if ranks is not None:
        ranked_candidates.sort(key=lambda c: ranks.algorithms.index(c.name))
    other_candidates = [
        candidate for candidate in verified_candidates if candidate.name not in ranked_names
    ]
    return Standings(
        ranked_candidates=tuple(ranked_candidates),
        ranks=ranks,
        partial_candidates=tuple(c for c in other_candidates if not c.is_reference),
        references=tuple(c for c in other_candidates if c.is_reference),
        unverified_candidates=tuple(c for c in ordered_candidates if not c.is_verified),
    )


def select_entries(task: OverviewTask, names: set[str]) -> OverviewTask:
    """Return a task with the results of some submissions."""
    entries = tuple(entry for entry in task.entries if entry.name in names)
    return OverviewTask(name=task.name, entries=entries)
