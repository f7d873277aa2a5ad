"""Verification of a stored result: are its files consistent, and do replays give the same values?

First, without a run, every total is computed again from its row, and every file of the result is
written again from the journals of the trials (``units/``) and compared. Then whole trials are
replayed from the recorded inputs and compared with the stored trials: every cell, every log sample
and every image without its record, byte for byte. If they differ, fingerprints
(`runs.trial.fingerprint`) identify the step at which they diverge, and the body or image that
differs first.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from ..base.files.image_record import remove_record
from ..base.files.scratch import scratch_folder
from ..base.rng import stream
from ..errors import ResultError
from ..results import journal, measures_file
from ..results.leaves import leaves
from ..results.motion.motion_track import load_track, unpack_track
from ..results.result import Result
from ..results.result_file import dumps
from ..results.stored.stored_row import Record
from ..runs.executors.executor import Executor, Job, JobQueue, OnLevel, SerialExecutor
from ..runs.executors.worker import IMAGES
from ..runs.planning.plan import Plan, Trial
from ..runs.run import Run
from . import differences
from .derived import contradictions
from .differences import Difference

ENVIRONMENT = ("version", "physics", "renderer", "numpy")
"""The keys of ``run`` in ``result.json`` that describe the environment of a result."""


@dataclass(kw_only=True)
class Verification:
    """The outcome of a verification."""

    differences: list[Difference] = field(default_factory=list)
    """The differences between the stored result and what it should be."""
    diverging_parts: list[str] = field(default_factory=list)
    """The bodies and topics in which replays diverge from the stored runs."""
    has_same_motion: bool = True
    """True if every replay had the motion and images of the stored run."""
    has_same_values: bool = True
    """True if every replay gave the stored values of its trial."""
    not_compared: list[str] = field(default_factory=list)
    """A sentence about each file that is absent and was therefore not compared."""
    trials: tuple[Trial, ...] = ()
    """The trials that were replayed."""

    def add(self, location: str, description: str) -> None:
        """Add a difference; see `Difference` for the arguments."""
        self.differences.append(Difference(location=location, description=description))


def complete_trials(directory: Path, plan: Plan, result: Result) -> list[Trial]:
    """Return the trials that ended, by their journals, or without journals by their rows."""
    trials = plan.trials()
    if _has_journals(directory):
        files = [journal.path_of(directory, trial.index) for trial in trials]
        ends = [journal.read_any(file)[1].end for file in files]
        return [trial for trial, end in zip(trials, ends, strict=True) if end is not None]
    rows = rows_by_level(result, plan)
    return [trial for trial in trials if all(key in rows for key in row_keys(trial))]


def choose_trials(trials: Sequence[Trial], sample: int | None, seed: int) -> tuple[Trial, ...]:
    """Return ``sample`` trials, drawn at random with a seed, in their order; None: all trials."""
    if sample is None or sample >= len(trials):
        return tuple(trials)
    indices = stream(seed, "verify").choice(len(trials), size=sample, replace=False)
    return tuple(trials[i] for i in sorted(indices.tolist()))


def verify(
    directory: Path,
    result: Result,
    run: Run,
    trials: Sequence[Trial],
    *,
    executor: Executor | None = None,
    on_level: OnLevel = lambda: None,
    compares_tracks: bool = False,
) -> Verification:
    """Check the consistency of a stored result, and replay some of its trials.

    Args:
        directory: the directory of the result.
        result: the stored result.
        run: the run to execute again, from the recorded inputs; its output directory is not used.
        trials: the trials to replay.
        executor: the executor of the trials; None: they run in this process.
        on_level: the function that is called after each replayed level.
        compares_tracks: True to compare the motion tracks of replays with those stored; an absent
            one is a difference.

    Raises:
        UwsimError: a replay could not be executed.
    """
    report = Verification(trials=tuple(trials))
    report.differences += contradictions(result, run.plan.benchmark)
    with scratch_folder("uwsim-verify-") as scratch:
        if _has_journals(directory):
            _check_files(report, directory, result, replace(run, out=scratch / "stored"))
            _check_tracks(report, directory, run.plan)
        else:
            report.not_compared.append("units/: rows are compared with result.json alone")
        replay = replace(run, out=scratch / "replayed")
        replay.out.mkdir()
        queue = JobQueue([Job(replay, trial) for trial in trials], on_level)
        (executor or SerialExecutor()).execute(queue)
        if queue.failure is not None:
            raise queue.failure
        if _has_journals(directory):
            for trial in trials:
                _check_trial(report, directory, replay, trial)
                if compares_tracks:
                    _compare_track(report, directory, replay, trial)
        else:
            _check_rows(report, result, replay)
        _check_images(report, directory, replay.out)
    return report


def _has_journals(directory: Path) -> bool:
    return (directory / journal.FOLDER).is_dir()


def _check_files(report: Verification, directory: Path, result: Result, run: Run) -> None:
    """Write every file again from the journals of the trials, if all exist, and compare."""
    incomplete_trials = _incomplete_trials(directory, result, run.plan)
    for trial, reason in incomplete_trials.items():
        name = journal.path_of(directory, trial.index).name
        report.add(f"{journal.FOLDER}/{name}", reason)
    if incomplete_trials:
        report.not_compared.append("result.json and the files next to it: units/ is incomplete")
    expected_names = {journal.path_of(directory, trial.index).name for trial in run.plan.trials()}
    for path in sorted((directory / journal.FOLDER).glob("*.jsonl")):
        if path.name not in expected_names:
            report.add(f"{journal.FOLDER}/{path.name}", "this run has no such trial")
    for trial in run.plan.trials():
        path = journal.path_of(directory, trial.index)
        head, content = journal.read_any(path)
        if head is None or trial in incomplete_trials:
            continue
        expected = _expected_head(result, run.head(trial))
        _check_head(report, f"{journal.FOLDER}/{path.name}", head, expected)
        file = journal.Journal(run.out, trial.index, run.head(trial))
        for row in content.rows:
            file.add(row)
        if content.end is not None:
            file.finish(content.end)
        file.close()
    if incomplete_trials:
        return
    try:
        written_result = run.write()
    except Exception as error:
        report.add(journal.FOLDER, f"the stored trials give no result: {error}")
        return
    for path in sorted(run.out.glob("*.*")):
        stored_path = directory / path.name
        if path.name == "result.json":
            _check_result(report, result, written_result)
        elif not stored_path.is_file():
            report.not_compared.append(f"{path.name}: is absent")
        else:
            text = stored_path.read_text(encoding="utf-8", errors="replace")
            expected_text = path.read_text(encoding="utf-8")
            if path.name == measures_file.FILE:
                text, expected_text = map(measures_file.remove_meanings, (text, expected_text))
            if difference := differences.text_difference(text, expected_text):
                report.add(path.name, f"{difference} by units/")


def _check_tracks(report: Verification, directory: Path, plan: Plan) -> None:
    """Check that every trial has a readable motion track, from which films are drawn."""
    for trial in plan.trials():
        path = journal.track_path(directory, trial.index)
        name = f"{journal.FOLDER}/{path.name}"
        if not path.is_file():
            report.not_compared.append(f"{name}: is absent, so the trial has no replay")
            continue
        try:
            load_track(path)
        except ResultError as error:
            report.add(name, str(error).removeprefix(f"{path}: ").removesuffix("."))


def _compare_track(report: Verification, directory: Path, replay: Run, trial: Trial) -> None:
    """Compare the motion track of a trial, from which films are drawn, with that of its replay."""
    stored_path, path = (
        journal.track_path(folder, trial.index) for folder in (directory, replay.out)
    )
    if not path.is_file():
        return
    try:
        is_equal = unpack_track(stored_path.read_bytes()) == unpack_track(path.read_bytes())
    except (OSError, ValueError):
        is_equal = False
    if not is_equal:
        report.add(f"{journal.FOLDER}/{path.name}", "is not the motion of the replay")


def _incomplete_trials(directory: Path, result: Result, plan: Plan) -> dict[Trial, str]:
    """Return the trials with rows in ``result.json`` that their journals lack, with the reason."""
    rows = rows_by_level(result, plan)
    incomplete_trials = {}
    for trial in plan.trials():
        file = journal.path_of(directory, trial.index)
        n_stored = len(journal.read_any(file)[1].rows) if file.is_file() else 0
        n_rows = sum(key in rows for key in row_keys(trial))
        if n_stored < n_rows:
            name = f"trial {trial.index} (seed {trial.seed})"
            reason = f"{n_stored} rows can be read" if file.exists() else "is absent"
            incomplete_trials[trial] = f"{name}: {reason}; result.json has {n_rows} of it"
    return incomplete_trials


def _expected_head(result: Result, replayed_head: Record) -> Record:
    """Return the head record that a trial should have, according to ``result.json``.

    The parameters are taken from the head of the replay: a head has the parameters of the command,
    whereas ``result.json`` has the parameters with which the algorithm ran.
    """
    stored_run = json.loads(json.dumps(result.run.as_dict()))
    run = {
        key: stored_run.get(key) if key != "parameters" else now
        for key, now in replayed_head["run"].items()
    }
    return {**replayed_head, "inputs": json.loads(json.dumps(result.inputs.as_dict())), "run": run}


def _check_head(report: Verification, name: str, head: Record, expected: Record) -> None:
    groups: set[tuple[str | int, ...]] = set()
    for path, old_text, new_text in differences.differing_leaves(head, expected):
        if path[:2] not in groups:
            groups.add(path[:2])
            message = f"{' '.join(map(str, path))}: {old_text} there, {new_text} by result.json"
            report.add(name, message)


def _check_result(report: Verification, result: Result, written_result: Result) -> None:
    documents = []
    for compared_result in (result, written_result):
        document = json.loads(dumps(compared_result))
        document["run"] = {k: v for k, v in document["run"].items() if k not in ENVIRONMENT}
        documents.append(document)
    names = [column.name for column in written_result.columns]
    groups: set[tuple[str | int, ...]] = set()
    for path, old_text, new_text in differences.differing_leaves(*documents):
        group = path if path[0] == "rows" else path[:2]
        if group in groups:
            continue
        groups.add(group)
        match path:
            case ("rows", int(row), int(column)) if column < len(names):
                location = f"row {row}, column {names[column]}"
            case _:
                location = " ".join(map(str, path))
        report.add("result.json", f"{location}: {old_text} there, {new_text} by units/")


def _check_trial(report: Verification, directory: Path, replay: Run, trial: Trial) -> None:
    old_trial, new_trial = (
        journal.read_any(journal.path_of(folder, trial.index))[1]
        for folder in (directory, replay.out)
    )
    name = f"trial {trial.index} (seed {trial.seed})"
    n_before = len(report.differences)
    if message := journal.level_difference(old_trial, trial.values):
        report.add(name, message)
    for level, *rows in zip(trial.levels, old_trial.rows, new_trial.rows, strict=False):
        for message in differences.row_differences(*(row.record() for row in rows)):
            report.add(f"{name}, level {level}", message)
    for message in differences.end_differences(*map(_end, (old_trial, new_trial))):
        report.add(name, message)
    motion = differences.compare_checkpoints(old_trial, new_trial, replay.plan.timestep)
    if len(report.differences) > n_before or motion.message is not None:
        report.has_same_values = False
    if not motion.is_known:
        report.not_compared.append(f"{name}: has no fingerprints of motion")
    elif motion.message is not None:
        report.has_same_motion = False
        report.diverging_parts += [
            part for part in motion.parts if part not in report.diverging_parts
        ]
        report.differences.insert(n_before, Difference(location=name, description=motion.message))


def _end(content: journal.StoredTrial) -> Record:
    return {} if content.end is None else content.end.record()


def _check_rows(report: Verification, result: Result, replay: Run) -> None:
    """Compare replayed rows with the rows of ``result.json``, for a result without journals."""
    new_result = replay.write()
    expected = rows_by_level(result, replay.plan)
    names = {column.name for column in result.columns}
    replayed_keys = {key for trial in replay.plan.trials() for key in row_keys(trial)}
    n = len(replayed_keys & expected.keys())
    if len(result.rows) > n:
        report.add("result.json", f"{len(result.rows)} rows; expected {n}, one for each level")
    for key, row in rows_by_level(new_result, replay.plan).items():
        for column, cell in zip(new_result.columns, new_result.rows[row], strict=True):
            if column.name == "ended_at" and len(new_result.rows) < len(result.rows):
                continue  # includes earlier parts of the run
            old_cell = result.values(column.name)[expected[key]] if column.name in names else None
            if leaves(old_cell) != leaves(cell):
                report.has_same_values = False
                location = f"row {expected[key]}, column {column.name}"
                report.add("result.json", f"{location}: stored {old_cell!r}, replayed {cell!r}")
    for new_stream in new_result.image_streams:
        if new_stream not in result.image_streams:
            report.add("result.json", f"images on {new_stream.topic}: others than those replayed")


def _check_images(report: Verification, directory: Path, replay_directory: Path) -> None:
    for path in sorted((replay_directory / IMAGES).glob("*.png")):
        stored_path = directory / IMAGES / path.name
        if not (directory / IMAGES).is_dir():
            report.not_compared.append(f"{IMAGES}/: is absent")
            return
        if not stored_path.is_file():
            report.not_compared.append(f"{IMAGES}/{path.name}: is absent")
            continue
        # The record names the scene's file, which may have another name; older images have none.
        stored_image, new_image = (remove_record(file.read_bytes()) for file in (stored_path, path))
        if stored_image != new_image:
            report.add(f"{IMAGES}/{path.name}", "differs from the image of the replay")


def rows_by_level(result: Result, plan: Plan) -> dict[tuple[float, ...], int]:
    """Return the index of each row of a result, by the repeat and the values of its level."""
    names = [c.name for c in result.columns if c.kind == "level" or c.name == "repeat"]
    columns = [result.numbers(name) for name in names]
    rows: dict[tuple[float, ...], int] = {}
    for row in range(len(result.rows)):
        key = tuple(value for column in columns if (value := column[row]) is not None)
        rows[key if plan.repeats > 1 else (0.0, *key)] = row
    return rows


def row_keys(trial: Trial) -> list[tuple[float, ...]]:
    """Return the repeat and the values of each level of a trial."""
    return [(float(trial.repeat), *(value for _, value in level.values)) for level in trial.levels]
