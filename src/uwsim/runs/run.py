"""A run: executes the trials of a plan and collects their rows into a result.

Rows are written to disk as levels end (`journal`); when the run ends, or fails, they are collected
in the order of the plan. The bytes are the same with every executor, resumed or not.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
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
from .described import described
from .measure_notes import notes_of
from .planning.plan import Plan, Trial
from .trial.status import ended_its_process, was_stopped
from .trial.trial_recorder import TrialRecorder
from .uwsim_files import save_dat, save_data


@dataclass(kw_only=True)
class Run:
    """A plan and the directory its result goes to."""

    plan: Plan
    """The plan."""
    out: Path
    """The result directory."""
    inputs: Inputs
    """Names and hashes of the files read (`prepare`)."""
    renderer: str
    """What draws the images (`prepare`)."""
    files: tuple[InputFile, ...] = ()
    """Files that must not change during the run (`watchable`)."""
    recorder: TrialRecorder | None = None
    """Writes down the messages of its trials."""
    seal: Seal | None = field(default=None, repr=False)
    """Keeps an algorithm that is not of uwsim from reading the rows, while the run goes on."""
    n_resumed: int = 0
    """Levels that were on disk already when the run began."""
    n_lost: int = 0
    """How often a trial lost its worker and was repeated."""
    simulated_s: float = 0.0
    """Length of all levels of the result together [s]."""

    @property
    def info(self) -> RunInfo:
        """What is executed, as far as it is known before it is."""
        return described(self.plan, self.renderer)

    def begin(self) -> list[Trial]:
        """Make the directory, and return the trials that are not finished."""
        self.out.mkdir(parents=True, exist_ok=True)
        self._forget_what_was_stopped()
        if self.plan.algorithm.client is not None and self.plan.algorithm.client.sync == "none":
            self._forget_what_cannot_be_repeated()
        self.n_resumed = self.n_finished()
        to_run = [*self._without_motion(), *self.unfinished()]
        return sorted(to_run, key=lambda trial: trial.index)

    def _forget_what_was_stopped(self) -> None:
        """Repeat trials whose algorithm ended its process.

        Earlier levels are kept and compared with the repeated ones. A call that did not return is
        final; but a trial without an end is repeated anyhow, and may go better.
        """
        name = self.plan.algorithm.name
        for trial in self.plan.trials():
            stored = self.read_trial(trial)
            is_to_go = ended_its_process if stored.end is not None else was_stopped
            for n, row in enumerate(stored.rows):
                if is_to_go(name, row.missing.get("total")):
                    journal.cut_back(self.out, trial.index, n)
                    break

    def _without_motion(self) -> Iterator[Trial]:
        """Find finished trials to run again: their motion is not on disk, or damaged.

        A trial that would not come out the same again, with a pilot, a program outside that runs
        freely or a call that took too long, is kept as it is.
        """
        plan = self.plan
        is_piloted = getattr(plan.algorithm.cls, "IS_PILOTED", False) and not plan.inputs
        is_free = plan.algorithm.client is not None and plan.algorithm.client.sync == "none"
        for trial in plan.trials():
            stored = self.read_trial(trial)
            if stored.end is None or _has_motion(self.out, trial):
                continue
            whys = [row.missing.get("total") for row in stored.rows]
            if is_piloted or is_free or any(was_stopped(plan.algorithm.name, why) for why in whys):
                warn(
                    f"{journal.track_path(self.out, trial.index)} is lost or damaged, and its "
                    "trial cannot be repeated: there is no replay of it"
                )
            else:
                yield trial

    def _forget_what_cannot_be_repeated(self) -> None:
        """Begin unfinished trials anew: their rows would not come out as they are stored."""
        for trial in self.unfinished():
            if self.n_rows(trial):
                journal.cut_back(self.out, trial.index, 0)

    def unfinished(self) -> list[Trial]:
        """Return the trials whose end is not on disk."""
        return [trial for trial in self.plan.trials() if self.read_trial(trial).end is None]

    def n_finished(self) -> int:
        """Count the levels that are on disk."""
        return sum(self.n_rows(trial) for trial in self.plan.trials())

    def n_rows(self, trial: Trial) -> int:
        """Count the levels of one trial that are on disk."""
        return len(self.read_trial(trial).rows)

    def head(self, trial: Trial) -> Record:
        """Return the identity of a trial: equal heads mean that its rows must be equal."""
        return {
            "inputs": _as_stored(self.inputs.as_dict()),
            "run": _as_stored(self.info.as_dict()),
            "seed": trial.seed,
            "levels": [[value for _, value in level.values] for level in trial.levels],
        }

    def write(self) -> Result:
        """Collect the rows on disk and write result, summary of repeats and logs."""
        stored = [(trial, self.read_trial(trial)) for trial in self.plan.trials()]
        result, logs, self.simulated_s = collect(self.plan, self.inputs, self.info, stored)
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
            ResultError: they are of another run, or not of the levels of the trial.
        """
        path = journal.path_of(self.out, trial.index)
        if not path.exists():
            return journal.EMPTY_JOURNAL
        found = journal.read(self.out, trial.index, self.head(trial), self.seal)
        if message := journal.level_difference(found, trial.values):
            raise ResultError(
                f"{path}: {message}. Remove this file: --resume then runs its trial again."
            )
        return found


def _has_motion(out: Path, trial: Trial) -> bool:
    """Whether the motion of a trial can be read."""
    try:
        load_track(journal.track_path(out, trial.index))
    except ResultError:
        return False
    return True


def _as_stored(value: object) -> object:
    """Return a value as it will be read back from JSON."""
    return json.loads(json.dumps(value))
