"""The verification of a submission: its claims are checked, and some trials run again.

The submission names a suite. The suite and the files of its tasks are those of the verifier, never
those of the submission; a suite may have got further tasks meanwhile. Each result must be one of
these files, seeds, levels, settings and track, and complete. Its rows, tables and logs are computed
again from its trials. A share of the trials of each task is run again and compared byte for byte
(`uwsim.verify`).

The trials are drawn by a hash of the submission and of a text of the verifier. By a hash of the
submission alone, an author could change a description until the drawn trials suit.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from ..base.files.input_files import compute_hash
from ..errors import PluginError, ResultError, UnknownName, UwsimError
from ..results.atomic_file import write_text
from ..results.inputs import input_differences
from ..results.result import Result
from ..results.result_file import load
from ..runs.executors.executor import Executor, OnLevel
from ..runs.own_process.program import is_outside
from ..runs.planning.plan import Trial
from ..runs.planning.stored_pilot import PILOT, PREFIX
from ..runs.run import Run
from ..verify.environment import environment_differences
from ..verify.verify import ENVIRONMENT, choose_trials, complete_trials, verify
from ..version import __version__
from .campaign import code_folder
from .claims import false_kind
from .entry import Entry, Seeds, check_settings, plan_entry, prepare_entry, task_hash
from .entry_files import VERDICT_FILE, entry_hash
from .seeds import draw_test_seeds
from .submission import Submission, load_submission
from .suite import TEST_SPLIT, Suite

FILE = VERDICT_FILE
"""The name of the file with the verdict."""
FORMAT = "uwsim-verification/1"
"""The format of the file."""
SHARE = 0.01
"""The default share of the trials of a task that are run again; at least one is."""
VERIFIED_VERDICT, DIFFERING_VERDICT, UNKNOWN_VERDICT = "verified", "differs", "not verified"
"""The verdicts: the same bytes; not the same, or a false claim; not decidable here."""
MAX_REASONS = 10
"""The greatest number of reasons of a task that are stored."""
NOT_COMPARED = {*ENVIRONMENT, "units", "notes", "parameters"}
"""The keys of ``run`` that are not claims: versions, which have their own check, and outcomes."""


class NotVerifiable(UwsimError):
    """A submission that cannot be run again here, which says nothing about its results."""


@dataclass(frozen=True, kw_only=True)
class Verification:
    """The verdict on a submission."""

    submission: str
    """The hash of the submission."""
    entry: str = ""
    """The hash of all files of the entry (`entry_hash`), its code and its motion among them."""
    verdict: str
    """``verified``, ``differs`` or ``not verified``."""
    reasons: tuple[str, ...] = ()
    """The reasons of a verdict other than ``verified``, each in one line."""
    sample: str = ""
    """The text of the verifier that, with the hash of the submission, draws the trials."""
    trials: Mapping[str, tuple[int, ...]]
    """The indices of the trials that were run again, by task."""
    version: str = __version__
    """The version of uwsim."""


def verify_submission(
    directory: Path,
    suite: Suite,
    sample: str,
    *,
    test_seeds: tuple[str, str] | None = None,
    share: float = SHARE,
    executor: Executor | None = None,
    open_progress: Callable[[str, int], OnLevel] = lambda title, total: lambda: None,
) -> Verification:
    """Check the claims of a submission, and run some of its trials again.

    Args:
        directory: the folder of the submission.
        suite: the suite of the verifier.
        sample: a text that the author could not know.
        test_seeds: the date and the public text of the split test, which the organiser states;
            None: an entry with test seeds is not verified.
        share: the share of the trials of each task to run again; at least one trial is.
        executor: the executor of the trials; None for this process.
        open_progress: returns the function to call for each level, for a title and their number.

    Raises:
        ResultError: there is no submission, or a file of the entry is no plain file.
    """
    directory = directory.absolute()
    entry_sha256 = entry_hash(directory)
    submission = load_submission(directory)
    trials: dict[str, tuple[int, ...]] = {}
    verdict, reasons = VERIFIED_VERDICT, list[str]()
    try:
        entry = _claimed_entry(submission, suite, directory, test_seeds)
        for name, run in _prepare(entry, directory):
            result = load(run.out)
            reasons += _false_claims(submission, name, result, run)
            if reasons:
                continue
            chosen_trials = _draw_trials(submission, name, run, result, sample, share)
            trials[name] = tuple(trial.index for trial in chosen_trials)
            on_level = open_progress(name, sum(len(trial.levels) for trial in chosen_trials))
            reasons += _compare(name, run, result, chosen_trials, executor, on_level)
    except NotVerifiable as error:
        verdict, reasons = UNKNOWN_VERDICT, [str(error)]
    except PluginError as error:  # code that cannot be imported here proves nothing
        verdict, reasons = UNKNOWN_VERDICT, [" ".join(str(error).split())]
    except UwsimError as error:
        reasons.append(" ".join(str(error).split()))
    if reasons and verdict == VERIFIED_VERDICT:
        verdict = DIFFERING_VERDICT
    return Verification(
        submission=submission.sha256,
        entry=entry_sha256,
        verdict=verdict,
        reasons=tuple(reasons),
        sample=sample,
        trials=trials,
    )


def save_verification(verification: Verification, directory: Path) -> Path:
    """Write ``verification.json`` into the folder of a submission."""
    path = directory / FILE
    document = {"format": FORMAT, **asdict(verification)}
    write_text(path, json.dumps(document, indent=1, ensure_ascii=False) + "\n")
    return path


def _claimed_entry(
    submission: Submission, suite: Suite, directory: Path, test_seeds: tuple[str, str] | None
) -> Entry:
    """Return the entry that a submission claims to be.

    Raises:
        NotVerifiable: it is of another suite or version of uwsim.
        UwsimError: a claim is false.
    """
    _check_results(submission, suite, directory)
    if submission.version != __version__:
        raise NotVerifiable(
            f"it was made with uwsim {submission.version}, and this is {__version__}; results of "
            "other versions may differ."
        )
    if submission.seeds.split == TEST_SPLIT and submission.suite_hash != suite.sha256:
        raise NotVerifiable(
            f"its test seeds are of a suite file {submission.suite_hash[:19]}; this is "
            f"{suite.sha256[:19]}."
        )
    check_settings(submission.settings)
    _check_seeds(submission.seeds, suite, test_seeds)
    return Entry(
        suite=suite,
        algorithms={
            name: f"{PREFIX}{(directory / name).absolute()}"
            if task.algorithm == PILOT
            else task.algorithm
            for name, task in submission.tasks.items()
        },
        track=suite.track(submission.track),
        seeds=submission.seeds,
        is_short=submission.is_short,
        settings=submission.settings,
        folder=code_folder(directory),
    )


def _check_results(submission: Submission, suite: Suite, directory: Path) -> None:
    """Raise UwsimError for a claim that the results or the suite prove false."""
    if not submission.tasks:
        raise ResultError("it has no task.")
    if submission.suite != suite.spec.name:
        raise NotVerifiable(
            f"it is of the suite {submission.suite!r:.60}; expected {suite.spec.name!r}."
        )
    if reason := false_kind(submission, suite):
        raise ResultError(f"{reason}.")
    known_names = {task.name for task in suite.spec.tasks}
    for name, task in submission.tasks.items():
        if name not in known_names:
            raise UnknownName("task", name, known_names)
        file = task.algorithm.partition(":")[0]
        if file.endswith(".py") and Path(file).name != file:
            raise ResultError(f"{name}: {file!r:.60} is not in code/.")
        version = load(directory / name).run.version
        if version != submission.version:
            raise ResultError(f"{name}: its result is of uwsim {version}.")


def _check_seeds(seeds: Seeds, suite: Suite, test_seeds: tuple[str, str] | None) -> None:
    """Raise UwsimError if the seeds are not those of their split."""
    if seeds.split == TEST_SPLIT:
        if test_seeds is None:
            raise NotVerifiable(
                "it has test seeds; add --date and --beacon of the organiser, not of its author."
            )
        if (seeds.date, seeds.beacon) != test_seeds:
            raise ResultError(
                f"its date and text are {seeds.date!r:.20} and {seeds.beacon!r:.60}; expected "
                f"{test_seeds[0]!r} and {test_seeds[1]!r:.60}."
            )
        expected = draw_test_seeds(suite, seeds.date, seeds.beacon, seeds.count)
    else:
        split = suite.split(seeds.split)
        expected = replace(
            Seeds(split=split.name, first=split.first, count=seeds.count),
            count=min(seeds.count, split.count),
        )
    if seeds != expected or seeds.count < 1:
        raise ResultError(
            f"its seeds are {seeds.first} to {seeds.first + seeds.count - 1}; the split "
            f"{seeds.split!r} has {expected.first} to {expected.first + expected.count - 1}."
        )


def _prepare(entry: Entry, directory: Path) -> Iterator[tuple[str, Run]]:
    """Yield the name and the run of each task, made from the verifier's files."""
    out = directory.absolute()
    for task in entry.tasks:
        for client, participation in load(out / task.name).run.clients or ():
            if is_outside(participation):
                raise NotVerifiable(
                    f"{task.name}: {client!r} is a program outside ({participation}); its author "
                    "has to run it again."
                )
    plans = plan_entry(entry)
    yield from zip((task.name for task, _ in plans), prepare_entry(plans, out), strict=True)


def _false_claims(submission: Submission, name: str, result: Result, run: Run) -> list[str]:
    """Return the claims of a result that are not true, each in one line."""
    task = submission.tasks[name]
    reasons = []
    if compute_hash(run.out / "result.json") != task.result:
        reasons.append("result.json is not the file that submission.json lists")
    if task.task_hash != task_hash(run.inputs):
        reasons.append("the task has other files than here")
    reasons += input_differences(result.inputs, run.inputs)
    stored_info, info = result.run.as_dict(), run.info.as_dict()
    for key in sorted((stored_info.keys() | info.keys()) - NOT_COMPARED):
        stored_text, expected_text = (json.dumps(values.get(key)) for values in (stored_info, info))
        if stored_text != expected_text:
            reasons.append(f"{key} is {stored_text:.80}; expected {expected_text:.80}")
    statuses = result.values("status")
    n_levels = sum(len(trial.levels) for trial in run.plan.trials())
    if len(statuses) != n_levels or len(complete_trials(run.out, run.plan, result)) != len(
        run.plan.trials()
    ):
        reasons.append(f"{len(statuses)} rows; expected {n_levels}, of trials that all ended")
    counts = (len(statuses), statuses.count("ok"))
    if counts != (task.n_trials, task.n_ok):
        reasons.append(
            f"{counts[1]} of {counts[0]} rows are ok, not {task.n_ok} of {task.n_trials}"
        )
    if not (run.out / "units").is_dir():
        reasons.append("units/ is absent")
    return [f"{name}: {reason}." for reason in reasons[:MAX_REASONS]]


def _draw_trials(
    submission: Submission, name: str, run: Run, result: Result, sample: str, share: float
) -> tuple[Trial, ...]:
    trials = complete_trials(run.out, run.plan, result)
    text = f"{submission.sha256}\n{sample}\n{name}"
    seed = int.from_bytes(hashlib.sha256(text.encode()).digest()[:4], "big")
    return choose_trials(trials, max(1, math.ceil(share * len(trials))), seed)


def _compare(
    name: str,
    run: Run,
    result: Result,
    trials: tuple[Trial, ...],
    executor: Executor | None,
    on_level: OnLevel,
) -> list[str]:
    """Run trials again; return the differences, each in one line."""
    outcome = verify(
        run.out, result, run, trials, executor=executor, on_level=on_level, compares_tracks=True
    )
    reasons = [f"{name}: {difference}" for difference in outcome.differences[:MAX_REASONS]]
    changes = environment_differences(result, run.out, run.info) if reasons else {}
    return [*reasons, *(f"{name}: {change}" for change in changes.values())]
