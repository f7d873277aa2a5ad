"""Verifying a result: consistency of its files, and replays of trials.

First, without running anything, every total is computed from its row, and every file of the
result is written again from the journals of its trials and compared. Then whole trials are replayed
from the recorded inputs and compared with what is stored: every cell, every sample, every image,
byte for byte; where they differ, the fingerprints (`runs.trial.fingerprint`) say from which step on
and in which body or image.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from ..base.files.scratch import scratch_folder
from ..base.rng import stream
from ..errors import ResultError
from ..results import journal
from ..results.leaves import leaves
from ..results.motion.motion_track import load_track
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
"""Of ``run``: what a result was made with."""


@dataclass(kw_only=True)
class Verification:
    """What came out."""

    differences: list[Difference] = field(default_factory=list)
    """Everything that is not the same."""
    parts: list[str] = field(default_factory=list)
    """Bodies and topics in which replays part from what is stored."""
    is_steady: bool = True
    """Whether every replay moved, and saw, what the stored run did."""
    is_replayed: bool = True
    """Whether every replay gave what its trial stored."""
    not_compared: list[str] = field(default_factory=list)
    """What is not there to be compared."""
    trials: tuple[Trial, ...] = ()
    """Trials that were replayed."""

    def add(self, where: str, what: str) -> None:
        """Record a difference."""
        self.differences.append(Difference(where=where, what=what))


def finished(directory: Path, plan: Plan, result: Result) -> list[Trial]:
    """Return the trials that are whole: by their files or, without those, by their rows."""
    trials = plan.trials()
    if _has_journals(directory):
        files = [journal.path_of(directory, trial.index) for trial in trials]
        stored = [journal.read_any(file)[1] for file in files]
        return [trial for trial, found in zip(trials, stored, strict=True) if found.end is not None]
    rows = _rows_by_level(result, plan)
    return [trial for trial in trials if all(key in rows for key in _keys(trial))]


def choose(trials: Sequence[Trial], sample: int | None, seed: int) -> tuple[Trial, ...]:
    """Choose ``sample`` trials by chance (None: all), in their order."""
    if sample is None or sample >= len(trials):
        return tuple(trials)
    picked = stream(seed, "verify").choice(len(trials), size=sample, replace=False)
    return tuple(trials[i] for i in sorted(picked.tolist()))


def verify(
    directory: Path,
    result: Result,
    run: Run,
    trials: Sequence[Trial],
    *,
    executor: Executor | None = None,
    on_level: OnLevel = lambda: None,
) -> Verification:
    """Check the consistency of a stored result and replay trials.

    Args:
        directory: the result's.
        result: as it was read.
        run: the same run anew, from the recorded inputs; its directory is not used.
        trials: what to replay.
        executor: who executes the trials; without one, this process.
        on_level: called for every level executed.

    Raises:
        UwsimError: a replay could not be executed.
    """
    found = Verification(trials=tuple(trials))
    found.differences += contradictions(result, run.plan.benchmark)
    with scratch_folder("uwsim-verify-") as scratch:
        if _has_journals(directory):
            _check_files(found, directory, result, replace(run, out=scratch / "stored"))
            _check_tracks(found, directory, run.plan)
        else:
            found.not_compared.append("units/: rows are compared with result.json alone")
        again = replace(run, out=scratch / "replayed")
        again.out.mkdir()
        queue = JobQueue([Job(again, trial) for trial in trials], on_level)
        (executor or SerialExecutor()).execute(queue)
        if queue.failure is not None:
            raise queue.failure
        if _has_journals(directory):
            for trial in trials:
                _check_trial(found, directory, again, trial)
        else:
            _check_rows(found, result, again)
        _check_images(found, directory, again.out)
    return found


def _has_journals(directory: Path) -> bool:
    return (directory / journal.FOLDER).is_dir()


def _check_files(found: Verification, directory: Path, result: Result, run: Run) -> None:
    """Write every file again from the stored trials, if all are there, and compare."""
    gone = _gone(directory, result, run.plan)
    for trial, what in gone.items():
        name = journal.path_of(directory, trial.index).name
        found.add(f"{journal.FOLDER}/{name}", what)
    if gone:
        found.not_compared.append("result.json and the files next to it: units/ is incomplete")
    expected_names = {journal.path_of(directory, trial.index).name for trial in run.plan.trials()}
    for path in sorted((directory / journal.FOLDER).glob("*.jsonl")):
        if path.name not in expected_names:
            found.add(f"{journal.FOLDER}/{path.name}", "this run has no such trial")
    for trial in run.plan.trials():
        path = journal.path_of(directory, trial.index)
        head, stored = journal.read_any(path)
        if head is None or trial in gone:
            continue
        expected = _head(result, run.head(trial))
        _check_head(found, f"{journal.FOLDER}/{path.name}", head, expected)
        file = journal.Journal(run.out, trial.index, run.head(trial))
        for row in stored.rows:
            file.add(row)
        if stored.end is not None:
            file.finish(stored.end)
        file.close()
    if gone:
        return
    try:
        made = run.write()
    except Exception as error:
        found.add(journal.FOLDER, f"what is stored makes no result: {error}")
        return
    for path in sorted(run.out.glob("*.*")):
        there = directory / path.name
        if path.name == "result.json":
            _check_result(found, result, made)
        elif not there.is_file():
            found.not_compared.append(f"{path.name}: is not there")
        else:
            text = there.read_text(encoding="utf-8", errors="replace")
            if difference := differences.of_text(text, path.read_text(encoding="utf-8")):
                found.add(path.name, f"{difference} by units/")


def _check_tracks(found: Verification, directory: Path, plan: Plan) -> None:
    """Read the motion track of every trial: replays and films are drawn from it."""
    for trial in plan.trials():
        path = journal.track_path(directory, trial.index)
        name = f"{journal.FOLDER}/{path.name}"
        if not path.is_file():
            found.not_compared.append(f"{name}: is not there, so that the trial cannot be seen")
            continue
        try:
            load_track(path)
        except ResultError as error:
            found.add(name, str(error).removeprefix(f"{path}: ").removesuffix("."))


def _gone(directory: Path, result: Result, plan: Plan) -> dict[Trial, str]:
    """Trials whose rows are in the result but not in their journals, with the reason."""
    rows = _rows_by_level(result, plan)
    gone = {}
    for trial in plan.trials():
        file = journal.path_of(directory, trial.index)
        n_stored = len(journal.read_any(file)[1].rows) if file.is_file() else 0
        n_told = sum(key in rows for key in _keys(trial))
        if n_stored < n_told:
            name = f"trial {trial.index} (seed {trial.seed})"
            what = f"{n_stored} rows can be read" if file.exists() else "is not there"
            gone[trial] = f"{name}: {what}; result.json has {n_told} of it"
    return gone


def _head(result: Result, replayed: Record) -> Record:
    """The head that a trial should have, according to result.json.

    The parameters of a head are those given; result.json says those that the algorithm ran with.
    """
    stored = json.loads(json.dumps(result.run.as_dict()))
    run = {
        key: stored.get(key) if key != "parameters" else now for key, now in replayed["run"].items()
    }
    return {**replayed, "inputs": json.loads(json.dumps(result.inputs.as_dict())), "run": run}


def _check_head(found: Verification, where: str, head: Record, expected: Record) -> None:
    """Compare the head of a trial with result.json, a line for each value."""
    seen: set[tuple[str | int, ...]] = set()
    for path, before, after in differences.apart(head, expected):
        if path[:2] not in seen:
            seen.add(path[:2])
            found.add(where, f"{' '.join(map(str, path))}: {before} there, {after} by result.json")


def _check_result(found: Verification, result: Result, made: Result) -> None:
    documents = []
    for each in (result, made):
        document = json.loads(dumps(each))
        document["run"] = {k: v for k, v in document["run"].items() if k not in ENVIRONMENT}
        documents.append(document)
    names = [column.name for column in made.columns]
    seen: set[tuple[str | int, ...]] = set()
    for path, before, after in differences.apart(*documents):
        group = path if path[0] == "rows" else path[:2]
        if group in seen:
            continue
        seen.add(group)
        match path:
            case ("rows", int(row), int(column)) if column < len(names):
                where = f"row {row}, column {names[column]}"
            case _:
                where = " ".join(map(str, path))
        found.add("result.json", f"{where}: {before} there, {after} by units/")


def _check_trial(found: Verification, directory: Path, again: Run, trial: Trial) -> None:
    """Compare a replayed trial with the stored one, level by level."""
    stored, replayed = (
        journal.read_any(journal.path_of(folder, trial.index))[1]
        for folder in (directory, again.out)
    )
    name = f"trial {trial.index} (seed {trial.seed})"
    before = len(found.differences)
    if message := journal.level_difference(stored, trial.values):
        found.add(name, message)
    for level, *rows in zip(trial.levels, stored.rows, replayed.rows, strict=False):
        for message in differences.of_row(*(row.record() for row in rows)):
            found.add(f"{name}, level {level}", message)
    for message in differences.of_end(*(_end(each) for each in (stored, replayed))):
        found.add(name, message)
    motion = differences.of_checkpoints(stored, replayed, again.plan.timestep)
    if len(found.differences) > before or motion.message is not None:
        found.is_replayed = False
    if not motion.is_known:
        found.not_compared.append(f"{name}: has no fingerprints of motion")
    elif motion.message is not None:
        found.is_steady = False
        found.parts += [part for part in motion.parts if part not in found.parts]
        found.differences.insert(before, Difference(where=name, what=motion.message))


def _end(stored: journal.StoredTrial) -> Record:
    return {} if stored.end is None else stored.end.record()


def _check_rows(found: Verification, result: Result, again: Run) -> None:
    """Compare replayed rows with those of result.json, where there is no journal."""
    made = again.write()
    expected = _rows_by_level(result, again.plan)
    names = {column.name for column in result.columns}
    known = {key for trial in again.plan.trials() for key in _keys(trial)}
    n = len(known & expected.keys())
    if len(result.rows) > n:
        found.add("result.json", f"{len(result.rows)} rows; expected {n}, one for each level")
    for key, row in _rows_by_level(made, again.plan).items():
        for column, cell in zip(made.columns, made.rows[row], strict=True):
            if column.name == "ended_at" and len(made.rows) < len(result.rows):
                continue  # includes earlier parts of the run
            there = result.values(column.name)[expected[key]] if column.name in names else None
            if leaves(there) != leaves(cell):
                found.is_replayed = False
                where = f"row {expected[key]}, column {column.name}"
                found.add("result.json", f"{where}: stored {there!r}, replayed {cell!r}")
    for stream_again in made.image_streams:
        if stream_again not in result.image_streams:
            found.add("result.json", f"images on {stream_again.topic}: others than in the replay")


def _check_images(found: Verification, directory: Path, again: Path) -> None:
    for path in sorted((again / IMAGES).glob("*.png")):
        there = directory / IMAGES / path.name
        if not (directory / IMAGES).is_dir():
            found.not_compared.append(f"{IMAGES}/: is not there")
            return
        if not there.is_file():
            found.not_compared.append(f"{IMAGES}/{path.name}: is not there")
        elif there.read_bytes() != path.read_bytes():
            found.add(f"{IMAGES}/{path.name}", "another image than in the replay")


def _rows_by_level(result: Result, plan: Plan) -> dict[tuple[float, ...], int]:
    """Return repeat and level -> number of the row."""
    wanted = [c.name for c in result.columns if c.kind == "level" or c.name == "repeat"]
    columns = [result.numbers(name) for name in wanted]
    found: dict[tuple[float, ...], int] = {}
    for row in range(len(result.rows)):
        key = tuple(value for column in columns if (value := column[row]) is not None)
        found[key if plan.repeats > 1 else (0.0, *key)] = row
    return found


def _keys(trial: Trial) -> list[tuple[float, ...]]:
    """The keys of `_rows_by_level` for a trial."""
    return [(float(trial.repeat), *(value for _, value in level.values)) for level in trial.levels]
