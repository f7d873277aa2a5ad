"""The merge of a campaign: one result from the trials that shards have left in a folder.

The result, its tables and logs have the bytes of a run on one machine. A campaign whose trials are
not all finished, or whose shards ran other files or versions, is refused.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ..errors import ResultError
from ..results import journal
from ..results.directory import (
    CONTROL_FOLDER,
    FILE_NAMES,
    FOLDERS,
    discard_drafts,
    is_begun,
    lock_directory,
)
from ..results.inputs import Inputs
from ..results.interrupted import resume_command
from ..results.provenance import load_provenance
from ..results.result import Result
from ..results.run_info import RunInfo
from ..results.stored.stored_shapes import HEAD
from ..runs.control_run import control_run_of, needs_control_run
from ..runs.execute import Execution
from ..runs.executors.executor import Executor, OnLevel, run_all
from ..runs.prepare import prepare_runs
from ..runs.run import Run, StoredPair
from ..verify.recorded_plan import FileOverrides, check_inputs, plan_of

MAX_LISTED = 8
"""The greatest number of trials in an error message."""


@dataclass(frozen=True, kw_only=True)
class Campaign:
    """A folder with the trials of one or several algorithms."""

    directory: Path
    """The folder."""
    runs: tuple[Run, ...]
    """The run of each algorithm, in the order of their folders."""

    def control_run(self) -> Run | None:
        """Return the control run, the one that shards have begun if there is one; None without."""
        runs = [control_run_of(run) for run in self.runs if needs_control_run(run.plan)]
        begun_runs = [run for run in runs if _journals(run.out)]
        return next(iter([*begun_runs, *runs]), None)


def read_campaign(directory: Path, overrides: FileOverrides) -> Campaign:
    """Read which runs a folder holds, and find their files by name and hash.

    Raises:
        ResultError: the folder holds no trial; or a file or a version is not that of the shards.
        AssetNotFound: a file is not found.
    """
    folders = _result_folders(directory)
    if not folders:
        raise ResultError(f"{directory}: holds no trial of a campaign (units/*.jsonl).")
    if not_begun := [folder.name for folder in folders if not _journals(folder)]:
        names = ", ".join(not_begun)
        raise ResultError(
            f"{directory}: trials are not finished: all of {names}. {_hint(directory)}"
        )
    heads = [_read_head(folder) for folder in folders]
    plans = [
        plan_of(Result(inputs=inputs, run=info, columns=(), rows=()), folder, overrides)
        for folder, (inputs, info) in zip(folders, heads, strict=True)
    ]
    subfolders = [] if folders == [directory] else [folder.name for folder in folders]
    runs = []
    for run, (inputs, info) in zip(prepare_runs(plans, directory, subfolders), heads, strict=True):
        check_inputs(inputs, run.inputs)
        runs.append(replace(run, inputs=inputs, renderer=info.renderer or run.renderer))
    return Campaign(directory=directory, runs=tuple(runs))


def _result_folders(directory: Path) -> list[Path]:
    """Return the folders with trials: the directory itself, or its subfolders."""
    if _journals(directory):
        return [directory]
    if not directory.is_dir():
        return []
    folders = sorted(path for path in directory.iterdir() if path.name not in FOLDERS)
    return [folder for folder in folders if is_begun(folder)]


def _journals(folder: Path) -> list[Path]:
    return sorted((folder / journal.FOLDER).glob("*.jsonl"))


def _read_head(folder: Path) -> tuple[Inputs, RunInfo]:
    """Return the inputs and the run of a folder, from the first line of its first journal."""
    path = _journals(folder)[0]
    head = journal.head_of(path)
    HEAD(head, str(path))
    return Inputs.from_dict(head["inputs"]), RunInfo.from_dict(head["run"])


def read_trials(campaign: Campaign) -> list[list[StoredPair]]:
    """Return the stored trials of each run, which are all finished.

    Raises:
        ResultError: trials are not finished; or one belongs to another run.
    """
    texts = []
    stored_trials = [run.read_trials() for run in campaign.runs]
    for run, pairs in zip(campaign.runs, stored_trials, strict=True):
        unfinished_trials = [trial for trial, content in pairs if content.end is None]
        if unfinished_trials:
            n, name = len(run.plan.trials()), run.plan.algorithm.name
            numbers = ", ".join(str(trial.index) for trial in unfinished_trials[:MAX_LISTED])
            dots = ", ..." if len(unfinished_trials) > MAX_LISTED else ""
            texts.append(f"{len(unfinished_trials)} of {n} of {name} ({numbers}{dots})")
    if texts:
        raise ResultError(
            f"{campaign.directory}: trials are not finished: {'; '.join(texts)}. "
            f"{_hint(campaign.directory)}"
        )
    return stored_trials


def _hint(directory: Path) -> str:
    """Return the sentence on how to finish a campaign."""
    command = resume_command(directory)
    rest = f", or all that is missing here: {command}" if command else "."
    return f"Run the shards again that did not end{rest}"


def merge(
    campaign: Campaign,
    *,
    executor: Executor | None = None,
    open_progress: Callable[[Run], OnLevel] = lambda run: lambda: None,
) -> tuple[Result, ...]:
    """Write the results of a campaign whose trials are all finished.

    A control run that no shard has run is executed first. Drafts of killed shards are removed.

    Args:
        campaign: the campaign, from `read_campaign`.
        executor: the executor of the control run; None for this process.
        open_progress: returns the function to call for each level of the control run.

    Raises:
        BadSetting: another run is writing into the folder.
        ResultError: trials are not finished.
    """
    stored_trials = read_trials(campaign)
    with lock_directory(campaign.directory):
        names = [run.out.name for run in campaign.runs]
        discard_drafts(campaign.directory, FILE_NAMES, (*FOLDERS, *names))
        control_run = campaign.control_run()
        if control_run is not None:
            on_level = (
                open_progress(control_run) if control_run.unfinished_trials() else lambda: None
            )
            run_all([control_run], executor, on_level=on_level)
            for run in campaign.runs:
                if needs_control_run(run.plan) and run.out / CONTROL_FOLDER != control_run.out:
                    shutil.copytree(control_run.out, run.out / CONTROL_FOLDER, dirs_exist_ok=True)
        return tuple(map(Run.write, campaign.runs, stored_trials))


def save_provenances(execution: Execution, campaign: Campaign) -> None:
    """Write the provenance of each run: the command of its shards, and the merging machine."""
    for run in campaign.runs:
        command = load_provenance(run.out).get("command")
        words: Sequence[str] = command if isinstance(command, list) else []
        facts = {**execution.timing(), "is_merged": True}
        replace(execution, command=words).save_provenance(run, facts)
