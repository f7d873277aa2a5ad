"""The queue of trials, and the protocol of the executors that run them.

An executor removes trials from the queue and reports their outcomes to the queue. The queue counts
how often a trial has lost its worker, and skips the trials of failed runs. The executor starts and
ends the workers.
"""

from __future__ import annotations

import os
from collections import Counter, deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import chdir
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from ...base.exceptions import system_error_text
from ...base.interrupts import is_user_interrupt, raise_if_interrupted
from ...errors import RUN_ERRORS, ClientLost, NeverStarted, RunFailed, UwsimError
from ...results.journal import path_of
from ...results.result import Result
from ...results.seal import deny_access_to_memory
from ...simulation import Calls, Cut
from ..own_process.process import PROCESS_ENDED
from ..planning.plan import Plan, Trial
from ..planning.trial_cache import TrialCache
from ..run import Run
from ..sealing import seal_runs
from ..trial.trial_observer import TrialObserver
from .worker import Event, JournalWriter, make_picklable, run_trial

OnLevel = Callable[[], None]
"""A function that is called for every level that was not on disk before."""
RESUME_HINT = "Finished rows are kept; continue with --resume."
"""The sentence at the end of the error of a failed run."""
MAX_RETRIES = 3
"""The greatest number of repetitions of a trial that has lost its worker."""
ENVIRONMENT = {"LP_NUM_THREADS": "0", "NUMBA_NUM_THREADS": "1"}
"""The environment variables of a worker, unless the user has set them: each library uses one
thread, because there is one worker for each core."""


@dataclass(eq=False)
class Job:
    """A trial of one of the runs that are executed together."""

    run: Run
    """The run of the trial."""
    trial: Trial
    """The trial."""
    cut: Cut | None = None
    """The call that ended the process or did not return; it and later calls are not made."""

    def __str__(self) -> str:
        levels = self.trial.levels
        level_text = ", ".join(f"{name}={value:g}" for name, value in levels[0].values)
        levels_text = level_text if len(levels) == 1 else f"{len(levels)} levels"
        name = self.run.plan.algorithm.name
        return f"trial {self.trial.index} ({name}, seed {self.trial.seed}, {levels_text})"


class Executor(Protocol):
    """The protocol of an executor of trials."""

    def execute(self, queue: JobQueue) -> None:
        """Execute jobs until the queue is empty, and report the outcome of each to the queue."""


class JobQueue:
    """The queue of waiting jobs, in order, with the failures of executed jobs.

    If a trial fails, the remaining trials of its run are skipped, because they would fail as well.
    The other runs continue.

    Args:
        jobs: the trials to run.
        on_level: the function that is called for every level that was not on disk before.
    """

    def __init__(self, jobs: Sequence[Job], on_level: OnLevel = lambda: None) -> None:
        self.failures: list[tuple[Run, Exception]] = []
        """The first failure of each failed run, in the order in which they occurred."""
        self._jobs = deque(jobs)
        self._on_level = on_level
        self._losses: Counter[Job] = Counter()
        self._lost_calls: set[tuple[Job, int]] = set()
        # the levels of each job that are not on disk yet
        self._n_open = {job: len(job.trial.levels) - job.run.n_rows(job.trial) for job in jobs}

    @property
    def failure(self) -> Exception | None:
        """The first of all failures."""
        return self.failures[0][1] if self.failures else None

    def add(self, job: Job) -> None:
        """Append a job."""
        self._jobs.append(job)
        self._n_open[job] = len(job.trial.levels) - job.run.n_rows(job.trial)

    def __len__(self) -> int:
        """Return the number of waiting jobs."""
        return len(self._jobs)

    def plans(self) -> tuple[Plan, ...]:
        """Return the plans of the waiting jobs."""
        return tuple({id(job.run): job.run.plan for job in self._jobs}.values())

    @property
    def is_sealed(self) -> bool:
        """True if the journals of a waiting job are encrypted until its run ends (sealed)."""
        return any(job.run.seal is not None for job in self._jobs)

    def pop(self) -> Job | None:
        """Remove and return the next job; return None if no job is waiting."""
        return self._jobs.popleft() if self._jobs else None

    def report_level(self, job: Job) -> None:
        """Report a level that was not on disk before."""
        if self._n_open[job] > 0:
            self._n_open[job] -= 1
            self._on_level()

    def report_finish(self, job: Job) -> None:
        """Report that a job is finished and on disk."""
        while self._n_open[job] > 0:
            self.report_level(job)

    def report_loss(self, job: Job, reason: str, call: int | None = None) -> None:
        """Report the loss of a job's worker: repeat the job next, up to `MAX_RETRIES` times.

        A second loss in the same ``call`` is due to the algorithm: the trial is run again
        without that call and all later calls into the algorithm.

        Args:
            job: the job.
            reason: how the worker ended.
            call: the number of the unfinished call into the algorithm; None if there was none.
        """
        if call is not None and (job, call) in self._lost_calls:
            self.report_stop(job, Cut(call, f"{PROCESS_ENDED} ({reason})"))
            return
        if call is not None:
            self._lost_calls.add((job, call))
        job.run.n_lost += 1
        self._losses[job] += 1
        if self._losses[job] <= MAX_RETRIES:
            self._jobs.appendleft(job)
            return
        n = self._losses[job]
        self.report_failure(
            job,
            RunFailed(f"{job} lost its worker {n} times, the last time {reason}. {RESUME_HINT}"),
        )

    def report_stop(self, job: Job, cut: Cut) -> None:
        """Report a call that failed: repeat the trial without this call and all later calls."""
        job.run.n_lost += 1
        job.cut = cut
        self._jobs.appendleft(job)

    def report_failure(self, job: Job, error: Exception) -> None:
        """Report the failure of a job."""
        if all(run is not job.run for run, _ in self.failures):
            run_error = convert_run_error(error)
            if isinstance(run_error, ClientLost) or (
                isinstance(run_error, NeverStarted) and job.run.n_finished() > 0
            ):
                run_error = type(run_error)(f"{run_error} {RESUME_HINT}")
            self.failures.append((job.run, run_error))
        self._jobs = deque(other for other in self._jobs if other.run is not job.run)


def convert_run_error(error: Exception) -> Exception:
    """Return an exception of a job as a `RunFailed`, because all inputs were checked before.

    All files were read, and all names resolved, before the first job. A later error of the same
    class is therefore a failure of the run (exit status 3), not of the user's input (2).
    """
    if isinstance(error, UwsimError) and not isinstance(error, RUN_ERRORS):
        run_error = RunFailed(str(error))
    elif isinstance(error, OSError) and error.filename is not None:
        run_error = RunFailed(system_error_text(error))
    else:
        return error
    run_error.__cause__ = error
    return run_error


class SerialExecutor:
    """An executor in this process, one trial after the other.

    Args:
        observer: the observer of each trial; None without one.
        callback_limit: the longest call into an algorithm in a process of its own [s of wall
            time]; None for no limit.
    """

    def __init__(
        self, observer: TrialObserver | None = None, *, callback_limit: float | None = None
    ) -> None:
        self._observer, self._limit = observer, callback_limit

    def execute(self, queue: JobQueue) -> None:
        """Execute all jobs of the queue in this process."""
        cache = TrialCache()
        try:
            while (job := queue.pop()) is not None:
                calls = Calls(limit=self._limit)
                try:
                    for _ in run_and_record(job, cache, calls, self._observer):
                        queue.report_level(job)
                except Exception as error:
                    raise_if_interrupted()
                    queue.report_failure(job, error)
                except BaseException as error:
                    if is_user_interrupt(error):
                        raise
                    queue.report_failure(job, make_picklable(error))
                else:
                    queue.report_finish(job)
        finally:
            cache.close()


def run_and_record(
    job: Job, cache: TrialCache, calls: Calls, observer: TrialObserver | None = None
) -> Iterator[Event]:
    """Run a trial and write its journal; yield for each level that was not on disk before."""
    if job.run.seal is not None:
        deny_access_to_memory()  # this process may be a worker
    writer = JournalWriter(job.run, job.trial)
    directory = Path.cwd()  # an algorithm may change the directory
    try:
        for event in run_trial(job.run.plan, job.trial, cache, calls, observer, job.run.recorder):
            raise_if_interrupted()
            with chdir(directory):
                is_new = writer.write(event)
            if is_new:
                yield event
    finally:
        os.chdir(directory)
        writer.close()


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """The outcome of runs that were executed together."""

    results: tuple[Result, ...]
    """The result of each run, also on disk; a failed run has the rows up to its failure."""
    failures: tuple[tuple[Run, Exception], ...]
    """The failed runs with their errors, in the order of the failures."""

    def finished_runs(self, runs: Sequence[Run]) -> list[tuple[Run, Result]]:
        """Return the runs that did not fail, with their results."""
        failed_ids = {id(run) for run, _ in self.failures}
        pairs = zip(runs, self.results, strict=True)
        return [(run, result) for run, result in pairs if id(run) not in failed_ids]


def run_each(
    runs: Sequence[Run], executor: Executor | None = None, *, on_level: OnLevel = lambda: None
) -> Outcome:
    """Execute the unfinished trials of some runs, and write their results.

    Args:
        runs: the runs to execute; their trials share the same workers.
        executor: the executor of the trials; None for this process.
        on_level: the function that is called for every level that was not on disk before.
    """
    jobs = [Job(run, trial) for run in runs for trial in run.begin()]
    queue = JobQueue(jobs, on_level)
    with seal_runs(runs):
        try:
            (executor or SerialExecutor()).execute(queue)
            _check_journals(runs, queue)
        finally:
            results = tuple(run.write() for run in runs)
    return Outcome(results=results, failures=tuple(queue.failures))


def _check_journals(runs: Sequence[Run], queue: JobQueue) -> None:
    for run in runs:
        for trial in run.unfinished_trials()[:1]:
            name = path_of(run.out, trial.index)
            message = "was run, but its file is incomplete now. Continue with --resume."
            job = Job(run, trial)
            queue.report_failure(job, RunFailed(f"{name}: {job} {message}"))


def run_all(
    runs: Sequence[Run], executor: Executor | None = None, *, on_level: OnLevel = lambda: None
) -> tuple[Result, ...]:
    """Execute runs as `run_each` does, and raise the first failure.

    Raises:
        NeverStarted: a start trigger never went on.
        ResultError: a stored trial belongs to another run, or cannot be reproduced.
        RunFailed: a trial lost its worker too often.
        UwsimError: the first other failure. Finished rows are kept, and written.
    """
    outcome = run_each(runs, executor, on_level=on_level)
    for _, error in outcome.failures:
        raise error
    return outcome.results
