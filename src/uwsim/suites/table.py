"""The public table of a suite: an entry for each family of reference algorithms.

The families are ``baseline-1``, ``baseline-2``, ..., in the order of the baselines of each task;
``expert``; and ``control``. A family has the tasks for which the suite names an algorithm.
"""

from __future__ import annotations

from collections.abc import Iterator

from .entry import Entry, Seeds
from .suite import Suite
from .suite_spec import TaskSpec


def reference_entries(suite: Suite, seeds: Seeds, *, is_short: bool) -> Iterator[tuple[str, Entry]]:
    """Yield the name and the entry of each family, in a track that permits all topics.

    Args:
        suite: the suite.
        seeds: the seeds.
        is_short: True for one seed and the middle level of each task.
    """
    n_baselines = max((len(task.baselines) for task in suite.spec.tasks), default=0)
    families = [*(f"baseline-{i + 1}" for i in range(n_baselines)), "expert", "control"]
    open_track = next(track for track in suite.spec.tracks if track.rule is None)
    for family in families:
        algorithms = {
            task.name: name
            for task in suite.spec.tasks
            if (name := find_reference(task, family)) is not None
        }
        if algorithms:
            yield (
                family,
                Entry(
                    suite=suite,
                    algorithms=algorithms,
                    track=open_track,
                    seeds=seeds,
                    is_short=is_short,
                ),
            )


def describe_family(family: str) -> str:
    """Return what the algorithms of a family have in common, in one sentence."""
    kind, _, number = family.partition("-")
    if kind == "baseline":
        return f"Baseline {number} of each task; the tables of the tasks name the algorithms."
    if kind == "expert":
        return "The scripted expert of each task that has one; it may use the truth."
    return "The control condition of each task, which does not act, or does not look."


def find_reference(task: TaskSpec, family: str) -> str | None:
    """Return the algorithm of a task in a family; None without one."""
    kind, _, number = family.partition("-")
    if kind != "baseline":
        return task.expert if kind == "expert" else task.control
    index = int(number) - 1
    return task.baselines[index] if index < len(task.baselines) else None
