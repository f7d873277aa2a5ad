"""The execution of runs: requests -> plans -> runs -> rows, controls, provenance and reports.

``uwsim bench`` and `uwsim.bench` call `plan_all`, `prepare_execution` and `execute`, in this order.
``uwsim envelope`` executes the runs of its search within `begin_runs`.
"""

from __future__ import annotations

import datetime
import shutil
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path

from ..base.exceptions import convert_to_run_failed
from ..base.terminal import warn
from ..errors import ErrorCollector, RunFailed
from ..results.provenance import lasting_provenance, machine, save_beginning, save_provenance
from ..results.result import Result
from .control_run import CONTROL_ALGORITHM, control_run_of, needs_control_run
from .executors.background import JobRunner
from .executors.choose import executor_of
from .executors.executor import Executor, OnLevel, Outcome, run_each
from .failed_algorithms import raise_if_rows_failed
from .foreign_code import announce_code
from .planning.make_plan import make_plan, print_scene_warnings
from .planning.plan import Plan
from .planning.plan_request import PlanRequest
from .prepare import prepare_runs
from .run import Run
from .sealing import is_foreign

PACKAGES = ("mujoco", "numpy", "numba", "moderngl", "opencv-python-headless", "rosbags")
"""The packages whose versions are recorded in the provenance of a run."""
Progress = Callable[[str, int, int], AbstractContextManager[OnLevel]]
"""A function of a title, the number of levels and the number of finished levels, which returns a
display of the progress."""


@dataclass(frozen=True, kw_only=True)
class Stopwatch:
    """The start of a run, and the time since then.

    The system time may be adjusted during a run, so durations are measured by a monotonic clock.
    """

    start_date: float = field(default_factory=time.time)
    """The system time at the start [s since 1970-01-01 UTC]."""
    start: float = field(default_factory=time.monotonic)
    """The reading of the monotonic clock at the start [s]."""

    def elapsed_time(self) -> float:
        """Return the time since the start [s]."""
        return time.monotonic() - self.start


@dataclass(frozen=True, kw_only=True)
class Execution:
    """Runs that are executed together, with the facts to record about them."""

    runs: Sequence[Run]
    """The runs: of one benchmark, one for each algorithm; or of the tasks of a suite."""
    executor: Executor
    """The executor of the trials."""
    workers: str
    """The value of ``--workers``: a number, or ``ray``."""
    command: Sequence[str] = ()
    """The arguments of the command ``uwsim``; empty if a Python program executes the runs."""
    stopwatch: Stopwatch = field(default_factory=Stopwatch)
    """The stopwatch, started when the files have been read."""
    name: str = ""
    """The title of the progress display; empty for the names of the benchmark and algorithms."""

    @property
    def title(self) -> str:
        """The title of the progress display: `name`, or the names of benchmark and algorithms."""
        if self.name:
            return self.name
        names = ", ".join(run.plan.algorithm.name for run in self.runs)
        return f"{Path(self.runs[0].plan.benchmark.path).stem} ({names})"

    def timing(self) -> dict[str, object]:
        """Return the start date, the duration and the real-time factor of the runs so far."""
        wall_time = self.stopwatch.elapsed_time()
        simulated_time = sum(run.simulated_s for run in self.runs)
        start_date = datetime.datetime.fromtimestamp(self.stopwatch.start_date, datetime.UTC)
        return {
            "began": start_date.isoformat(),
            "algorithms": [run.plan.algorithm.name for run in self.runs],
            "wall_s": wall_time,
            "simulated_s": simulated_time,
            "real_time_factor": simulated_time / wall_time if wall_time > 0.0 else None,
            "workers": int(self.workers) if self.workers.isdigit() else self.workers,
        }

    def save_provenance(self, run: Run, facts: Mapping[str, object]) -> None:
        """Write the provenance of a run: facts, command, machine and packages.

        No score depends on them.
        """
        environment = {
            "command": list(self.command),
            **machine(),
            "packages": {name: version(name) for name in PACKAGES},
        }
        save_provenance({**facts, **environment, **lasting_provenance(run.out)}, run.out)


@dataclass(frozen=True, kw_only=True)
class Callbacks:
    """The functions that are called while runs are executed."""

    progress: Progress
    """The display of the number of finished levels."""
    on_rows: Callable[[Run, Result], None] = lambda run, result: None
    """The callback when the rows of a run are complete, before its report is drawn."""
    on_report: Callable[[Run, Result], None] = lambda run, result: None
    """The callback when the report of a run has been drawn."""


def plan_all(
    requests: Sequence[PlanRequest], workers: str, callback_limit: float, errors: ErrorCollector
) -> tuple[Executor | None, list[Plan]]:
    """Choose the executor and make the plans; collect all errors.

    Args:
        requests: the request for each algorithm.
        workers: the number of workers, or ``ray``.
        callback_limit: the longest call into an algorithm [s]; 0 for no limit.
        errors: the collection of errors.
    """
    executor: Executor | None = None
    with errors.collect():
        executor = executor_of(workers, callback_limit)
    plans = []
    for request in requests:
        with errors.collect():
            plans.append(make_plan(request))
    return executor, plans


def prepare_execution(
    plans: Sequence[Plan],
    executor: Executor | None,
    out: Path,
    *,
    workers: str,
    folders: Sequence[str] = (),
    command: Sequence[str] = (),
) -> Execution:
    """Open the scene once and hash its files; announce its code and warn of unlikely values.

    Args:
        plans: the plans of `plan_all`, which differ in the algorithm alone.
        executor: the executor of `plan_all`.
        out: the result directory.
        workers: the value of ``--workers``.
        folders: the subfolder of ``out`` for each result; empty for one result in ``out`` itself.
        command: the arguments of the command ``uwsim``.

    Raises:
        UwsimError: a file, a body, a camera or a service does not exist.
    """
    assert executor is not None
    stopwatch = Stopwatch()
    announce_code(plans[0].scene)
    runs = prepare_runs(plans, out, folders)
    print_scene_warnings(plans[0])
    return Execution(
        runs=runs, executor=executor, workers=workers, command=command, stopwatch=stopwatch
    )


@contextmanager
def begin_runs(execution: Execution, directory: AbstractContextManager[None]) -> Iterator[None]:
    """Lock the result directory during the block, and record the start of the runs in it.

    A system error in the block is raised as a `RunFailed`.

    Args:
        execution: the runs to execute in the block.
        directory: the context that locks and empties the result directory.
    """
    with convert_to_run_failed(), directory:
        for run in execution.runs:
            if message := save_beginning(execution.command, run.out):
                warn(message)
        yield


def execute(
    execution: Execution,
    directory: AbstractContextManager[None],
    open_runner: Callable[[], JobRunner] | None,
    callbacks: Callbacks,
) -> tuple[Result, ...]:
    """Run one benchmark with each algorithm, and write all results.

    Args:
        execution: the runs to execute.
        directory: the context that locks and empties the result directory.
        open_runner: returns the runner of control runs and reports; None for neither of them.
        callbacks: the functions that are called meanwhile.

    Raises:
        UwsimError: the first failure; the runs of the other algorithms are finished first.
        RunFailed: a simulation failed, or an algorithm failed in every row.
    """
    runs = execution.runs
    with begin_runs(execution, directory):
        if open_runner is None:
            outcome = run_trials(runs, execution.executor, execution.title, callbacks.progress)
            _save_provenances(execution, outcome)
        else:
            with open_runner() as runner:
                outcome = _run_with_control_run(execution, runner, callbacks.progress)
                _save_provenances(execution, outcome)
                for run, result in outcome.finished_runs(runs):
                    runner.submit(run.out)
                    callbacks.on_rows(run, result)
                    runner.wait()
                    callbacks.on_report(run, result)
        for _, error in outcome.failures:
            raise error
        raise_if_rows_failed(runs, outcome.results)
        return outcome.results


def run_trials(runs: Sequence[Run], executor: Executor, title: str, progress: Progress) -> Outcome:
    """Run the unfinished trials of some runs, with a display of the finished levels."""
    total = sum(len(trial.levels) for run in runs for trial in run.trials())
    n_finished = sum(run.n_finished() for run in runs)
    with progress(title, total, n_finished) as on_level:
        return run_each(runs, executor, on_level=on_level)


def _run_with_control_run(execution: Execution, runner: JobRunner, progress: Progress) -> Outcome:
    """Run the trials and the control run.

    While workers execute trials, the control run is executed in the background, unless a foreign
    algorithm could read its rows. If the trials run in this process, the control run follows them
    here: a background process would have to load the simulation first.
    """
    runs = execution.runs
    control_runs = [control_run_of(run) for run in runs if needs_control_run(run.plan)]
    is_local = execution.workers in ("0", "1") and len(runs) == 1
    must_wait = any(is_foreign(run.plan) for run in runs)
    if is_local and not must_wait:
        runner, must_wait = runner.local_runner(), True
    if control_runs and not must_wait:
        runner.submit(control_runs[0])
    outcome = run_trials(runs, execution.executor, execution.title, progress)
    if control_runs and outcome.finished_runs(runs):
        if must_wait:
            runner.submit(control_runs[0])
        _wait_for_control_run(runner, control_runs)
    return outcome


def _wait_for_control_run(runner: JobRunner, control_runs: Sequence[Run]) -> None:
    """Wait for the control run, and copy its result to the other runs; warn if it failed."""
    try:
        runner.wait()
        for other in control_runs[1:]:  # it does not depend on the algorithm under test
            shutil.copytree(control_runs[0].out, other.out, dirs_exist_ok=True)
    except (RunFailed, OSError) as error:
        warn(f"the report lacks the control run {CONTROL_ALGORITHM!r}, which failed: {error}")


def _save_provenances(execution: Execution, outcome: Outcome) -> None:
    timing = execution.timing()
    for run, _ in outcome.finished_runs(execution.runs):
        losses = {"lost_workers": run.n_lost, "resumed": run.n_resumed}
        execution.save_provenance(run, {**timing, **losses})
