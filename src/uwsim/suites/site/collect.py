"""The submissions of a page: those that can be ranked, and the others with the reason."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

from ...analysis.comparison import Entry
from ...analysis.overview.tasks import OverviewTask
from ...assets.bundled import bundled_files
from ...base.files.input_files import compute_hash
from ...errors import ResultError, UwsimError
from ...results.journal_check import check_rows
from ...results.result_file import load
from ..submission import FILE, Submission, load_submission
from ..suite import SuiteSpec, find_suite, read_suite
from ..verification import DIFFERING_VERDICT, UNKNOWN_VERDICT, VERIFIED_VERDICT
from ..verification import FILE as VERIFICATION_FILE
from .board import Candidate, Exclusion, Leaderboard
from .standings import rank_candidates


def collect_submissions(directory: Path, suite_name: str | None = None) -> Leaderboard:
    """Read all submissions in the subfolders of a folder.

    Compared are submissions of one suite, with equal seeds, and tasks with equal files: those of
    the baselines, or of most submissions if there is no baseline.

    Args:
        directory: the folder.
        suite_name: the suite, for descriptions and the order of tasks: a file or a bundled name.
            None: the bundled suite of the name that the submissions state, if there is one.

    Raises:
        ResultError: no submission can be ranked.
        UwsimError: there is no such suite, or its file is invalid.
    """
    folders = sorted(path.parent for path in directory.glob(f"*/{FILE}"))
    candidates, exclusions = [], []
    for folder in folders:
        try:
            candidates.append(_read_candidate(folder))
        except UwsimError as error:
            reason = " ".join(str(error).split())
            exclusions.append(Exclusion(name=folder.name, reasons=(reason,)))
    candidates, more_exclusions = _select_equal(candidates)
    candidates = _distinguish(candidates)
    exclusions += more_exclusions
    if not candidates:
        texts = [f" {entry.name}: {entry.reasons[0]}" for entry in exclusions[:1]]
        raise ResultError(f"{directory}: no folder in it has a valid {FILE}.{''.join(texts)}")
    suite: SuiteSpec | None = None
    name = candidates[0].submission.suite
    if suite_name is not None:
        suite = read_suite(find_suite(suite_name)).spec
    elif name in bundled_files("suites"):
        suite = read_suite(find_suite(name)).spec
    ordered_candidates = rank_candidates(candidates, _group_tasks(candidates, suite)).all_candidates
    return Leaderboard(
        suite=suite,
        candidates=tuple(ordered_candidates),
        exclusions=tuple(sorted(exclusions, key=lambda entry: entry.name)),
        tasks=_group_tasks(ordered_candidates, suite),
    )


def _read_candidate(folder: Path) -> Candidate:
    """Read a submission; raise UwsimError if it cannot be ranked by itself."""
    submission = load_submission(folder)
    verdict, reasons = _read_verdict(folder, submission)
    if verdict == DIFFERING_VERDICT:
        raise ResultError(f"it differs from its replay: {' '.join(reasons)}")
    results = {}
    for name, task in submission.tasks.items():
        if Path(name).name != name:
            raise ResultError(f"{name!r} is no name of a task.")
        path = folder / name / "result.json"
        if not path.is_file() or compute_hash(path) != task.result:
            raise ResultError(f"{name}/result.json is not the file that {FILE} lists.")
        results[name] = result = load(path)
        check_rows(result, folder / name)
        status_columns = result.columns_of_kind("status")
        statuses = result.values(status_columns[0].name) if status_columns else ()
        if not statuses or (len(statuses), statuses.count("ok")) != (task.n_trials, task.n_ok):
            raise ResultError(f"{name}: the numbers of trials are not those in {FILE}.")
    if not results:
        raise ResultError("it has no task.")
    return Candidate(
        name=submission.name.strip() or folder.name,
        directory=folder,
        submission=submission,
        results=results,
        verdict=verdict,
    )


def _read_verdict(folder: Path, submission: Submission) -> tuple[str, list[str]]:
    """Return the verdict of a verification of this content, and its reasons."""
    try:
        document = json.loads((folder / VERIFICATION_FILE).read_bytes())
        verdict, reasons = document["verdict"], [str(reason) for reason in document["reasons"]]
        is_current = document["submission"] == submission.sha256
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return UNKNOWN_VERDICT, []
    return (
        (verdict, reasons)
        if is_current and verdict in (VERIFIED_VERDICT, DIFFERING_VERDICT)
        else (UNKNOWN_VERDICT, [])
    )


def _distinguish(candidates: Sequence[Candidate]) -> list[Candidate]:
    """Add the folder to names that are not unique."""
    names = Counter(candidate.name for candidate in candidates)
    return [
        replace(candidate, name=f"{candidate.name} ({candidate.directory.name})")
        if names[candidate.name] > 1
        else candidate
        for candidate in candidates
    ]


def _select_equal(candidates: Sequence[Candidate]) -> tuple[list[Candidate], list[Exclusion]]:
    """Return the submissions with equal suite, seeds and task files, and the others."""
    references = [c for c in candidates if c.submission.kind == "baseline"] or candidates
    conditions = Counter(_condition(c.submission) for c in references).most_common(1)
    hashes: dict[str, str] = {}
    for name in {name for c in references for name in c.results}:
        counts = Counter(
            c.submission.tasks[name].task_hash for c in references if name in c.results
        )
        hashes[name] = counts.most_common(1)[0][0]
    chosen_candidates, exclusions = [], []
    for candidate in candidates:
        submission = candidate.submission
        reasons = []
        if _condition(submission) != conditions[0][0]:
            reasons.append(
                f"it has {_condition(submission)}; this page compares {conditions[0][0]}."
            )
        reasons += [
            f"{name}: has other files than the task on this page."
            for name, task in submission.tasks.items()
            if task.task_hash != hashes.get(name, task.task_hash)
        ]
        if reasons:
            exclusions.append(Exclusion(name=candidate.directory.name, reasons=tuple(reasons)))
        else:
            chosen_candidates.append(candidate)
    return chosen_candidates, exclusions


def _condition(submission: Submission) -> str:
    """Return the suite and the seeds of a submission in words."""
    seeds = submission.seeds
    length = "one level a task" if submission.is_short else "all levels"
    return f"the suite {submission.suite}, {seeds.text}, {length}"


def _group_tasks(
    candidates: Iterable[Candidate], suite: SuiteSpec | None
) -> tuple[OverviewTask, ...]:
    """Return the results by task, in the order of the suite."""
    entries: dict[str, list[Entry]] = {
        task.name: [] for task in (() if suite is None else suite.tasks)
    }
    for candidate in candidates:
        for name, result in candidate.results.items():
            entry = Entry(
                name=candidate.name,
                source=f"{candidate.directory.name}/{name}",
                result=result,
                sha256=candidate.submission.tasks[name].result,
            )
            entries.setdefault(name, []).append(entry)
    return tuple(
        OverviewTask(name=name, entries=tuple(task_entries))
        for name, task_entries in entries.items()
        if task_entries
    )
