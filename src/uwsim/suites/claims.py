"""The claims of a submission that its own results and its suite can prove false."""

from __future__ import annotations

import json
from collections.abc import Iterator

from ..results.result import Result
from ..runs.own_process.program import is_outside
from .entry import task_hash
from .submission import Submission, TaskEntry
from .suite import Suite
from .suite_spec import TaskSpec


def false_kind(submission: Submission, suite: Suite) -> str | None:
    """Return why a submission is not of its kind; None if it may be.

    Baselines, experts and control conditions are the algorithms that the suite names.
    """
    kind = submission.kind
    for task in suite.spec.tasks:
        if kind == "entry" or task.name not in submission.tasks:
            continue
        names = reference_names(task, kind)
        algorithm = submission.tasks[task.name].algorithm
        if algorithm not in names or submission.settings:
            choices = f"; the suite has {', '.join(names)}" if names else ""
            return f"{task.name}: {algorithm!r:.60} is no {kind} of the suite{choices}"
    return None


def reference_names(task: TaskSpec, kind: str) -> tuple[str, ...]:
    """Return the algorithms that the suite names for a task: baselines, the expert or control."""
    if kind == "baseline":
        return task.baselines
    name = task.expert if kind == "expert" else task.control
    return () if name is None else (name,)


def false_claims(submission: Submission, name: str, result: Result, suite: Suite) -> list[str]:
    """Return the claims about a task that its result or the suite proves false, one a line.

    The result itself may be forged; that, only a verification finds.

    Args:
        submission: the submission.
        name: the name of the task.
        result: its result.
        suite: the suite of the page, or of the verifier.
    """
    task = submission.tasks[name]
    return [f"{name}: {text}" for text in _differences(submission, task, result, suite)]


def _differences(
    submission: Submission, task: TaskEntry, result: Result, suite: Suite
) -> Iterator[str]:
    run, seeds = result.run.as_dict(), submission.seeds
    tracks = [track for track in suite.spec.tracks if track.name == submission.track]
    rule = tracks[0].rule if tracks else None
    expected = {
        "version": submission.version,
        "seed": seeds.first,
        "repeats": seeds.count,
        "track": None if rule is None else [rule.name, list(rule.sources)],
        "algorithm": task.algorithm,
    }
    if not tracks:
        yield f"the suite has no track {submission.track!r:.60}"
    for key, value in expected.items():
        stored_text, claimed_text = json.dumps(run.get(key)), json.dumps(value)
        is_pilot = key == "algorithm" and submission.is_human
        if stored_text != claimed_text and not is_pilot:
            yield (
                f"{key} is {stored_text:.80} in its result, and {claimed_text:.80} in "
                "submission.json"
            )
    if task.task_hash != task_hash(result.inputs):
        yield "the hash of the task is not that of its result"
    is_program = ":" in task.algorithm or task.algorithm.endswith(".py")
    if is_program and any(is_outside(text) for _, text in result.run.clients or ()):
        yield f"{task.algorithm!r:.60} is a class, and its result states a program outside"
    levels = result.columns_of_kind("level")
    n_levels = len(set(zip(*(result.values(c.name) for c in levels), strict=True))) if levels else 1
    if submission.is_short and n_levels > 1:
        yield f"it has {n_levels} levels; a short entry has one"
    if len(result.rows) != n_levels * seeds.count:
        yield f"{len(result.rows)} rows; expected {n_levels * seeds.count}"
