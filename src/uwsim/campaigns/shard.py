"""A shard: one of n parts of the trials of a campaign, run into a folder that all shards share.

A shard that is run again runs only what is not finished on disk. Shards need no lock: each trial
belongs to one shard, and each file is replaced as a whole.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from ..errors import BadSetting
from ..results import journal
from ..results.directory import FILE_NAMES, FOLDERS, check_resume
from ..runs.control_run import control_run_of, needs_control_run
from ..runs.execute import Execution, Progress, begin_runs, run_trials
from ..runs.failed_algorithms import raise_if_rows_failed
from ..runs.run import Run
from ..runs.sealing import is_foreign

MAX_SHARDS = 1_000_000
"""The greatest number of shards; a greater number is regarded as a typing error."""


@dataclass(frozen=True, kw_only=True)
class Shard:
    """One of ``count`` parts of a campaign."""

    number: int
    """The number of the shard, from 1."""
    count: int
    """The number of shards."""

    def __str__(self) -> str:
        return f"{self.number}/{self.count}"

    def choose(self, runs: Sequence[Run]) -> list[Run]:
        """Return the runs with the trials of this shard alone.

        The trials of all runs are dealt to the shards in an order that is given by a hash, so that
        the levels of a sweep, which take different times, are spread over the shards.
        """
        numbers = [(i, trial.index) for i, run in enumerate(runs) for trial in run.plan.trials()]
        shard_trials = sorted(numbers, key=_hash)[self.number - 1 :: self.count]
        return [
            replace(run, chosen_trials=frozenset(index for j, index in shard_trials if j == i))
            for i, run in enumerate(runs)
        ]


def _hash(numbers: tuple[int, int]) -> bytes:
    return hashlib.sha256(f"{numbers[0]}/{numbers[1]}".encode()).digest()


def read_shard(text: str) -> Shard:
    """Return the shard of a text such as ``3/10``.

    Raises:
        BadSetting: the text is no shard.
    """
    match = re.fullmatch(r"(\d{1,7})/(\d{1,7})", text, re.ASCII)
    number, count = (int(match[1]), int(match[2])) if match else (0, 0)
    if not 1 <= number <= count <= MAX_SHARDS:
        raise BadSetting(f"--shard {text}: expected NUMBER/COUNT from 1/COUNT on, such as 3/10.")
    return Shard(number=number, count=count)


def campaign_runs(runs: Sequence[Run]) -> list[Run]:
    """Return the runs of a campaign: those of the algorithms, and their control run.

    If foreign code runs, the control run is left out, because that code could read its rows while
    other shards run; `merge` executes it.
    """
    control_runs = [control_run_of(run) for run in runs if needs_control_run(run.plan)]
    has_foreign_code = any(is_foreign(run.plan) for run in runs)
    return [*runs, *([] if has_foreign_code else control_runs[:1])]


@contextmanager
def shared_directory(directory: Path, results: Sequence[str]) -> Iterator[None]:
    """Create a result directory that several processes share; there is no lock.

    Args:
        directory: the directory, which need not exist.
        results: the subfolders for several results; empty if the directory itself is the result.

    Raises:
        BadSetting: the directory holds files, but no run of uwsim.
    """
    check_shared_directory(directory, results)
    for name in results or [""]:
        (directory / name).mkdir(parents=True, exist_ok=True)
    yield


def check_shared_directory(directory: Path, results: Sequence[str]) -> None:
    """Make the checks of `shared_directory`; change nothing."""
    folders = (*FOLDERS, *results)
    check_resume(directory, pattern=FILE_NAMES, folders=folders, results=results)


def execute_shard(
    execution: Execution, shard: Shard, results: Sequence[str], progress: Progress
) -> list[Run]:
    """Run the trials of one shard; no result is written.

    Args:
        execution: the runs of the campaign.
        shard: the shard to run.
        results: the subfolders for several results.
        progress: the display of the number of finished levels.

    Returns:
        The runs with the trials of the shard.

    Raises:
        UwsimError: the first failure; the other trials of the shard are finished first.
        RunFailed: a simulation failed, or an algorithm failed in every row of the shard.
    """
    runs = shard.choose(campaign_runs(execution.runs))
    execution = replace(execution, command=drop_shard(execution.command))
    out = execution.runs[0].out if not results else execution.runs[0].out.parent
    with begin_runs(execution, shared_directory(out, results)):
        for run in runs:
            _check_same_run(run)
        outcome = run_trials(
            runs, execution.executor, f"{execution.title}, shard {shard}", progress
        )
    for _, error in outcome.failures:
        raise error
    n = len(execution.runs)
    raise_if_rows_failed(runs[:n], outcome.results[:n])
    return runs


def _check_same_run(run: Run) -> None:
    """Raise ResultError if the first trial on disk, of any shard, belongs to another run."""
    paths = sorted((run.out / journal.FOLDER).glob("*.jsonl"))
    trials = run.plan.trials()
    index = int(paths[0].stem) if paths else len(trials)
    if index < len(trials):
        run.read_trial(trials[index])


def drop_shard(words: Sequence[str]) -> list[str]:
    """Return the words of a command without ``--shard``: those that resume the whole campaign."""
    kept_words: list[str] = []
    is_value = False
    for word in words:
        if not is_value and word.partition("=")[0] != "--shard":
            kept_words.append(word)
        is_value = word == "--shard"
    return kept_words
