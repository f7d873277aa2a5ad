"""The submissions of a page: verified ones, those without rank, and the excluded with reasons."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ...analysis.comparison import Entry
from ...analysis.overview.tasks import OverviewTask
from ...base.files.input_files import compute_hash
from ...base.terminal import clean_text
from ...errors import ResultError, UnknownName, UwsimError
from ...results.journal_check import check_rows
from ...results.result import Result
from ...results.result_file import load
from ..claims import false_claims, false_kind
from ..entry import Seeds
from ..entry_files import VERDICT_FILE, entry_hash, read_plain_file
from ..submission import FILE, Submission, load_submission
from ..suite import TEST_SPLIT, Suite
from ..suite_spec import SuiteSpec
from ..verification import DIFFERING_VERDICT, UNKNOWN_VERDICT, VERIFIED_VERDICT
from .board import Candidate, Exclusion, Leaderboard
from .standings import rank_candidates

CHANGED_VERDICT = "changed since verification"
"""The verdict on an entry of which a file was changed after it was verified."""
MAX_VERDICT_BYTES = 1_000_000
"""The greatest size of ``verification.json`` [bytes]."""
MAX_RESULT_BYTES = 64 * 2**20
"""The greatest size of ``result.json`` [bytes]."""


@dataclass(frozen=True, kw_only=True)
class Conditions:
    """The suite and seeds of all submissions of a page, which the organiser states."""

    suite: Suite
    """The suite."""
    seeds: Seeds
    """The seeds."""
    is_short: bool = False
    """A flag for the middle level of each task alone."""


def collect_submissions(directory: Path, conditions: Conditions) -> Leaderboard:
    """Read all submissions in the subfolders of a folder.

    A submission is excluded if it has other seeds or tasks than the conditions, if its results or
    the suite prove a claim false, or if its verification found a difference. Tasks must have the
    files of those verified; of most submissions, if none is verified.

    Args:
        directory: the folder.
        conditions: the suite and the seeds of the page.

    Raises:
        ResultError: no submission can be shown.
    """
    folders = sorted(path.parent for path in directory.glob(f"*/{FILE}"))
    candidates, exclusions = [], []
    for folder in folders:
        try:
            candidates.append(_read_candidate(folder, conditions))
        except (UwsimError, OSError) as error:
            exclusions.append(_exclude(folder, str(error)))
    candidates, more_exclusions = _select_equal(candidates)
    candidates = _distinguish(candidates)
    exclusions += more_exclusions
    if not candidates:
        texts = [f" {entry.name}: {entry.reasons[0]}" for entry in exclusions[:1]]
        raise ResultError(f"{directory}: no folder in it has a valid {FILE}.{''.join(texts)}")
    suite = conditions.suite.spec
    ordered_candidates = rank_candidates(candidates, _group_tasks(candidates, suite)).all_candidates
    return Leaderboard(
        suite=suite,
        seeds=conditions.seeds,
        is_short=conditions.is_short,
        candidates=tuple(ordered_candidates),
        exclusions=tuple(sorted(exclusions, key=lambda entry: entry.name)),
        tasks=_group_tasks(ordered_candidates, suite),
    )


def _exclude(folder: Path, reason: str) -> Exclusion:
    return Exclusion(
        name=clean_text(ascii(folder.name)[1:-1] if not _is_text(folder.name) else folder.name),
        reasons=(clean_text(" ".join(reason.split())),),
    )


def _is_text(name: str) -> bool:
    """Return whether the name of a folder can be printed; one that is no UTF-8 cannot."""
    return name.isprintable()


def _read_candidate(folder: Path, conditions: Conditions) -> Candidate:
    """Read a submission; raise UwsimError if it cannot be shown by itself."""
    if not _is_text(folder.name):
        raise ResultError("the name of its folder cannot be printed.")
    sha256 = entry_hash(folder)  # also refuses links, pipes and devices before any is opened
    submission = load_submission(folder)
    verdict, reasons = _read_verdict(folder, submission, sha256)
    if verdict == DIFFERING_VERDICT:
        raise ResultError(f"it differs from its replay: {' '.join(reasons)}")
    _check_conditions(submission, conditions)
    results = {
        name: _read_result(folder, name, submission, conditions.suite) for name in submission.tasks
    }
    name = submission.name.strip() or folder.name
    return Candidate(
        name=name if verdict == VERIFIED_VERDICT else f"{name} ({UNKNOWN_VERDICT})",
        directory=folder,
        submission=submission,
        results=results,
        verdict=verdict,
    )


def _check_conditions(submission: Submission, conditions: Conditions) -> None:
    """Raise UwsimError if a submission has other seeds or tasks than the page, or is of no task."""
    suite = conditions.suite
    expected = _condition(suite.spec.name, conditions.seeds, is_short=conditions.is_short)
    condition = _condition(submission.suite, submission.seeds, is_short=submission.is_short)
    if condition != expected or submission.seeds != conditions.seeds:
        raise ResultError(
            f"it has {condition}; this page compares {expected} (--suite, --split, --seeds, "
            "--short)."
        )
    if submission.seeds.split == TEST_SPLIT and submission.suite_hash != suite.sha256:
        raise ResultError("its test seeds are those of another suite file.")
    if not submission.tasks:
        raise ResultError("it has no task.")
    names = [task.name for task in suite.spec.tasks]
    for name in submission.tasks:
        if name not in names:
            raise UnknownName("task", name, names)
    if reason := false_kind(submission, suite):
        raise ResultError(f"{reason}.")


def _read_result(folder: Path, name: str, submission: Submission, suite: Suite) -> Result:
    """Read the result of a task; raise ResultError if it is not what the submission claims."""
    task, path = submission.tasks[name], folder / name / "result.json"
    if not path.is_file() or compute_hash(path) != task.result:
        raise ResultError(f"{name}/result.json is not the file that {FILE} lists.")
    if path.stat().st_size > MAX_RESULT_BYTES:
        raise ResultError(f"{name}/result.json is larger than {MAX_RESULT_BYTES >> 20} MiB.")
    result = load(path)
    check_rows(result, folder / name)
    status_columns = result.columns_of_kind("status")
    statuses = result.values(status_columns[0].name) if status_columns else ()
    if not statuses or (len(statuses), statuses.count("ok")) != (task.n_trials, task.n_ok):
        raise ResultError(f"{name}: the numbers of trials are not those in {FILE}.")
    if claims := false_claims(submission, name, result, suite):
        raise ResultError(f"{'; '.join(claims)}.")
    return result


def _read_verdict(folder: Path, submission: Submission, sha256: str) -> tuple[str, list[str]]:
    """Return the verdict of the last verification, and its reasons.

    Args:
        folder: the folder of the submission.
        submission: the content of ``submission.json``.
        sha256: the hash of all files of the entry.
    """
    try:
        document = json.loads(read_plain_file(folder / VERDICT_FILE, MAX_VERDICT_BYTES))
        verdict, reasons = document["verdict"], [str(reason) for reason in document["reasons"]]
        is_of_submission = document["submission"] == submission.sha256
        is_current = is_of_submission and document["entry"] == sha256
    except (ResultError, OSError, ValueError, KeyError, TypeError, RecursionError):
        return UNKNOWN_VERDICT, []
    if verdict == DIFFERING_VERDICT and is_of_submission:
        return verdict, reasons
    if verdict != VERIFIED_VERDICT:
        return UNKNOWN_VERDICT, []
    return (VERIFIED_VERDICT if is_current else CHANGED_VERDICT), []


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
    """Return the submissions whose tasks have equal files, and the others."""
    references = [c for c in candidates if c.is_verified] or candidates
    hashes: dict[str, str] = {}
    for name in {name for c in references for name in c.results}:
        counts = Counter(
            c.submission.tasks[name].task_hash for c in references if name in c.results
        )
        hashes[name] = counts.most_common(1)[0][0]
    chosen_candidates, exclusions = [], []
    for candidate in candidates:
        reasons = [
            f"{name}: has other files than the task on this page."
            for name, task in candidate.submission.tasks.items()
            if task.task_hash != hashes.get(name, task.task_hash)
        ]
        if reasons:
            exclusions.append(Exclusion(name=candidate.directory.name, reasons=tuple(reasons)))
        else:
            chosen_candidates.append(candidate)
    return chosen_candidates, exclusions


def _condition(suite: str, seeds: Seeds, *, is_short: bool) -> str:
    """Return a suite and its seeds in words."""
    length = "one level a task" if is_short else "all levels"
    return f"the suite {suite:.60}, {seeds.text} ({seeds.split:.60}), {length}"


def _group_tasks(candidates: Iterable[Candidate], suite: SuiteSpec) -> tuple[OverviewTask, ...]:
    """Return the results by task, in the order of the suite."""
    entries: dict[str, list[Entry]] = {task.name: [] for task in suite.tasks}
    for candidate in candidates:
        for name, result in candidate.results.items():
            entry = Entry(
                name=candidate.name,
                source=f"{candidate.directory.name}/{name}",
                result=result,
                sha256=candidate.submission.tasks[name].result,
            )
            entries[name].append(entry)
    return tuple(
        OverviewTask(name=name, entries=tuple(task_entries))
        for name, task_entries in entries.items()
        if task_entries
    )
