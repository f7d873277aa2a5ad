"""A run: executes the trials of a plan and collects their rows into a result.

Rows are written to disk as levels end (`journal`); when the run ends, or fails, they are collected
in the order of the plan. The bytes are the same with every executor, resumed or not.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ..base.files.file_names import file_names
from ..base.files.input_files import InputFile
from ..base.terminal import warn
from ..errors import ResultError
from ..results import journal
from ..results.inputs import Inputs
from ..results.log import save_log
from ..results.measures_file import save_measures
from ..results.motion import load_track
from ..results.result import Result
from ..results.result_file import save
from ..results.run_info import RunInfo
from ..results.seal import Seal
from ..results.stored.stored_row import Record
from ..results.summary import save_summary
from .collect import collect
from .measure_notes import notes_of
from .planning.plan import Plan, Trial
from .run_description import describe_plan
from .trial.status import ended_its_process, was_stopped
from .trial.trial_recorder import TrialRecorder
from .uwsim_files import save_dat, save_data

StoredPair = tuple[Trial, journal.StoredTrial]
"""A trial and its stored rows."""


@dataclass(kw_only=True)
class Run:
    """A prepared plan with its result directory, and the progress of its execution."""

    plan: Plan
    """The benchmark, scene, algorithm and options."""
    out: Path
    """The result directory."""
    inputs: Inputs
    """The names and hashes of the files read, from `prepare`."""
    renderer: str
    """The name of the renderer, from `prepare`."""
    files: tuple[InputFile, ...] = ()
    """Files that must not change during the run (`unique_files`)."""
    recorder: TrialRecorder | None = None
    """The recorder of the messages of its trials; None if they are not recorded."""
    chosen_trials: frozenset[int] | None = None
    """The indices of the trials that this process runs, those of a shard; None for all."""
    seal: Seal | None = field(default=None, repr=False)
    """The encryption that prevents a foreign algorithm from reading the rows during the run."""
    n_resumed: int = 0
    """The number of levels that were on disk already when the run began."""
    n_lost: int = 0
    """The number of trials that lost their worker and were repeated."""
    simulated_s: float = 0.0
    """The simulation time of all levels of the result together [s]."""

    @property
    def info(self) -> RunInfo:
        """The description of the run, as far as it is known before its execution."""
        return describe_plan(self.plan, self.renderer)

    def trials(self) -> list[Trial]:
        """Return the trials that this process runs."""
        trials = self.plan.trials()
        return [
            trial
            for trial in trials
            if self.chosen_trials is None or trial.index in self.chosen_trials
        ]

    def begin(self) -> list[Trial]:
        """Create the result directory, and return the trials to run."""
        self.out.mkdir(parents=True, exist_ok=True)
        self._truncate_stopped_trials()
        if self.plan.algorithm.client is not None and self.plan.algorithm.client.sync == "none":
            self._truncate_unrepeatable()
        self.n_resumed = self.n_finished()
        to_run = [*self._trials_without_motion(), *self.unfinished_trials()]
        return sorted(to_run, key=lambda trial: trial.index)

    def _truncate_stopped_trials(self) -> None:
        """Truncate trials whose algorithm ended its process, so that they are repeated.

        The levels before are kept, and compared when they are repeated. An unfinished trial is also
        truncated where a call into its algorithm did not return; in a finished trial that is final.
        """
        name = self.plan.algorithm.name
        for trial, content in self.read_trials():
            is_truncated = ended_its_process if content.end is not None else was_stopped
            for n, row in enumerate(content.rows):
                if is_truncated(name, row.missing.get("total")):
                    journal.truncate(self.out, trial.index, n)
                    break

    def _trials_without_motion(self) -> Iterator[Trial]:
        """Yield the finished trials to run again because their motion track is lost or damaged.

        A trial that is not repeatable is kept: a trial with a pilot, with an external program that
        runs freely, or with a call into the algorithm that did not return.
        """
        plan = self.plan
        is_piloted = plan.algorithm.facts.is_piloted and not plan.inputs
        is_free = plan.algorithm.client is not None and plan.algorithm.client.sync == "none"
        for trial, content in self.read_trials():
            if content.end is None or _has_motion(self.out, trial):
                continue
            reasons = [row.missing.get("total") for row in content.rows]
            has_stopped = any(was_stopped(plan.algorithm.name, reason) for reason in reasons)
            if is_piloted or is_free or has_stopped:
                warn(
                    f"{journal.track_path(self.out, trial.index)} is lost or damaged, and its "
                    "trial cannot be repeated: there is no replay of it"
                )
            else:
                yield trial

    def _truncate_unrepeatable(self) -> None:
        """Remove the rows of unfinished trials, which repeated rows would not equal."""
        for trial in self.unfinished_trials():
            if self.n_rows(trial):
                journal.truncate(self.out, trial.index, 0)

    def unfinished_trials(self) -> list[Trial]:
        """Return the trials whose end is not on disk."""
        return [trial for trial, content in self.read_trials() if content.end is None]

    def n_finished(self) -> int:
        """Count the levels of `trials` that are on disk."""
        return sum(len(content.rows) for _, content in self.read_trials())

    def n_rows(self, trial: Trial) -> int:
        """Count the levels of one trial that are on disk."""
        return len(self.read_trial(trial).rows)

    def head(self, trial: Trial) -> Record:
        """Return the first line of a trial's journal; trials with equal heads have equal rows."""
        return _head(trial, self._description())

    def _description(self) -> Record:
        """Return what the heads of all trials have in common."""
        return {
            "inputs": _round_trip(self.inputs.as_dict()),
            "run": _round_trip(self.info.as_dict()),
        }

    def write(self, stored_trials: Sequence[StoredPair] | None = None) -> Result:
        """Collect the rows on disk and write result, summary of repeats and logs.

        The rows of a shard are collected only: ``uwsim merge`` writes those of all shards.

        Args:
            stored_trials: the rows, if they are read already (`read_trials`).
        """
        stored_trials = self.read_trials() if stored_trials is None else stored_trials
        result, logs, self.simulated_s = collect(self.plan, self.inputs, self.info, stored_trials)
        if self.chosen_trials is not None:
            return result
        save(result, self.out)
        save_dat(
            result,
            self.out,
            compatibility=self.plan.compatibility,
            measures=self.plan.benchmark.measures,
        )
        save_measures(notes_of(self.plan.benchmark.measures), self.out)
        if self.plan.repeats > 1:
            save_summary(result, self.out)
        measures = {spec.name: spec for spec in self.plan.benchmark.measures}
        files = file_names(measures)
        for log in logs:
            save_log(log, self.out, files[log.measure])
            save_data(log, measures[log.measure], self.out, files[log.measure])
        return result

    def read_trial(self, trial: Trial) -> journal.StoredTrial:
        """Return the stored rows of a trial.

        Raises:
            ResultError: the rows belong to another run, or to levels that are not in the trial.
        """
        return self._read_trial(trial, self._description())

    def read_trials(self) -> list[StoredPair]:
        """Return each trial that this process runs, with its stored rows; see `read_trial`."""
        description = self._description()
        return [(trial, self._read_trial(trial, description)) for trial in self.trials()]

    def _read_trial(self, trial: Trial, description: Record) -> journal.StoredTrial:
        path = journal.path_of(self.out, trial.index)
        if not path.exists():
            return journal.EMPTY_JOURNAL
        content = journal.read(self.out, trial.index, _head(trial, description), self.seal)
        if message := journal.level_difference(content, trial.values):
            raise ResultError(
                f"{path}: {message}. Remove this file: --resume then runs its trial again."
            )
        return content


def _head(trial: Trial, description: Record) -> Record:
    levels = [[value for _, value in level.values] for level in trial.levels]
    return {**description, "seed": trial.seed, "levels": levels}


def _has_motion(out: Path, trial: Trial) -> bool:
    try:
        load_track(journal.track_path(out, trial.index))
    except ResultError:
        return False
    return True


def _round_trip(value: object) -> object:
    """Return a value as it is read back from JSON."""
    return json.loads(json.dumps(value))
