"""The queue of trials, and the protocol of the executors that run them.

An executor takes trials from the queue and tells it what became of them. The queue knows how often
a trial has lost its worker, and whose trials are not worth running any more; an executor knows
processors.
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
from .worker import Event, JournalWriter, picklable, run_trial

OnLevel = Callable[[], None]
KEPT = "Finished rows are kept; continue with --resume."
"""What to do about a run that has failed."""
MAX_RETRIES = 3
"""How often a trial is repeated after it has lost its worker."""
ENVIRONMENT = {"LP_NUM_THREADS": "0", "NUMBA_NUM_THREADS": "1"}
"""Environment of a worker, unless the user has set it: one thread only, for there is one
worker a core."""


@dataclass(eq=False)
class Job:
    """A trial of one of the runs that are executed together."""

    run: Run
    """Whose trial it is."""
    trial: Trial
    """The trial."""
    cut: Cut | None = None
    """The call into the algorithm that it did not survive, or did not come back from."""

    def __str__(self) -> str:
        levels = self.trial.levels
        which = ", ".join(f"{name}={value:g}" for name, value in levels[0].values)
        levels_text = which if len(levels) == 1 else f"{len(levels)} levels"
        name = self.run.plan.algorithm.name
        return f"trial {self.trial.index} ({name}, seed {self.trial.seed}, {levels_text})"


class Executor(Protocol):
    """Executes trials."""

    def execute(self, queue: JobQueue) -> None:
        """Take jobs from the queue until there are none, and report each."""


class JobQueue:
    """Waiting jobs, in order, and the outcomes of the finished ones.

    Where a trial fails, the rest of its run is skipped: it would fail alike. The other
    benchmarks go on.

    Args:
        jobs: the trials to run.
        on_level: called for every level that was not on disk before.
    """

    def __init__(self, jobs: Sequence[Job], on_level: OnLevel = lambda: None) -> None:
        self.failures: list[tuple[Run, Exception]] = []
        """What went wrong first with whom, in that order."""
        self._waiting = deque(jobs)
        self._on_level = on_level
        self._losses: Counter[Job] = Counter()
        self._calls_lost: set[tuple[Job, int]] = set()
        self._to_come = {job: len(job.trial.levels) - job.run.n_rows(job.trial) for job in jobs}

    @property
    def failure(self) -> Exception | None:
        """The first of all failures."""
        return self.failures[0][1] if self.failures else None

    def add(self, job: Job) -> None:
        """Append a job; jobs may add others."""
        self._waiting.append(job)
        self._to_come[job] = len(job.trial.levels) - job.run.n_rows(job.trial)

    def __len__(self) -> int:
        """How many jobs are waiting."""
        return len(self._waiting)

    def plans(self) -> tuple[Plan, ...]:
        """Whose jobs are waiting."""
        return tuple({id(job.run): job.run.plan for job in self._waiting}.values())

    @property
    def is_sealed(self) -> bool:
        """Whether a job that waits is of a run whose rows its algorithm must not read."""
        return any(job.run.seal is not None for job in self._waiting)

    def take(self) -> Job | None:
        """Take the next job; None when there is none now."""
        return self._waiting.popleft() if self._waiting else None

    def level(self, job: Job) -> None:
        """Report a level that was not on disk before."""
        if self._to_come[job] > 0:
            self._to_come[job] -= 1
            self._on_level()

    def done(self, job: Job) -> None:
        """It is finished and on disk."""
        while self._to_come[job] > 0:
            self.level(job)

    def lost(self, job: Job, why: str, call: int | None = None) -> None:
        """Its worker is gone: repeat it next, unless that has happened too often.

        Where it goes in the same ``call`` once more that is the algorithm's doing: from then on the
        trial is run without that call.
        """
        if call is not None and (job, call) in self._calls_lost:
            self.stopped(job, Cut(call, f"{PROCESS_ENDED} ({why})"))
            return
        if call is not None:
            self._calls_lost.add((job, call))
        job.run.n_lost += 1
        self._losses[job] += 1
        if self._losses[job] <= MAX_RETRIES:
            self._waiting.appendleft(job)
            return
        times = self._losses[job]
        self.failed(
            job,
            RunFailed(f"{job} lost its worker {times} times, the last time {why}. {KEPT}"),
        )

    def stopped(self, job: Job, cut: Cut) -> None:
        """A call into the algorithm did not return: repeat the trial without it."""
        job.run.n_lost += 1
        job.cut = cut
        self._waiting.appendleft(job)

    def failed(self, job: Job, error: Exception) -> None:
        """It failed."""
        if all(run is not job.run for run, _ in self.failures):
            found = found_by_running(error)
            if isinstance(found, ClientLost) or (
                isinstance(found, NeverStarted) and job.run.n_finished() > 0
            ):
                found = type(found)(f"{found} {KEPT}")
            self.failures.append((job.run, found))
        self._waiting = deque(other for other in self._waiting if other.run is not job.run)


def found_by_running(error: Exception) -> Exception:
    """Return an exception of a job as a `RunFailed`, because all inputs were checked before.

    All files were read, and all names looked up, before the first job; an error of the same kind
    that comes now is one of the run (exit status 3, not 2).
    """
    if isinstance(error, UwsimError) and not isinstance(error, RUN_ERRORS):
        failed = RunFailed(str(error))
    elif isinstance(error, OSError) and error.filename is not None:
        failed = RunFailed(system_error_text(error))
    else:
        return error
    failed.__cause__ = error
    return failed


class SerialExecutor:
    """This process, one trial after the other.

    Args:
        onlooker: looks on at each trial.
        callback_limit: how long a call into an algorithm in a process of its own may take [s of
            wall time]; None: for ever.
    """

    def __init__(
        self, onlooker: TrialObserver | None = None, *, callback_limit: float | None = None
    ) -> None:
        self._onlooker, self._limit = onlooker, callback_limit

    def execute(self, queue: JobQueue) -> None:
        """Execute all jobs."""
        cache = TrialCache()
        try:
            while (job := queue.take()) is not None:
                calls = Calls(limit=self._limit)
                try:
                    for _ in run_and_record(job, cache, calls, self._onlooker):
                        queue.level(job)
                except Exception as error:
                    raise_if_interrupted()
                    queue.failed(job, error)
                except BaseException as error:
                    if is_user_interrupt(error):
                        raise
                    queue.failed(job, picklable(error))
                else:
                    queue.done(job)
        finally:
            cache.close()


def run_and_record(
    job: Job, cache: TrialCache, calls: Calls, onlooker: TrialObserver | None = None
) -> Iterator[Event]:
    """Run a trial and write its journal; yields the levels that were not on disk before."""
    if job.run.seal is not None:
        deny_access_to_memory()  # of this process, which may be a worker
    writer = JournalWriter(job.run, job.trial)
    here = Path.cwd()  # an algorithm may go elsewhere
    try:
        for event in run_trial(job.run.plan, job.trial, cache, calls, onlooker, job.run.recorder):
            raise_if_interrupted()
            with chdir(here):
                is_new = writer.keep(event)
            if is_new:
                yield event
    finally:
        os.chdir(here)
        writer.close()


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """The outcome of runs that were executed together."""

    results: tuple[Result, ...]
    """One each, as far as it ran; also on disk."""
    failures: tuple[tuple[Run, Exception], ...]
    """Runs that failed, and why, in the order in which it happened."""

    def finished(self, runs: Sequence[Run]) -> list[tuple[Run, Result]]:
        """Return those of the runs that did not fail, with their results."""
        failed = {id(run) for run, _ in self.failures}
        pairs = zip(runs, self.results, strict=True)
        return [(run, result) for run, result in pairs if id(run) not in failed]


def run_each(
    runs: Sequence[Run], executor: Executor | None = None, *, on_level: OnLevel = lambda: None
) -> Outcome:
    """Execute the unfinished trials of some runs, and write their results.

    Args:
        runs: what to execute; their trials share the same workers.
        executor: who executes the trials; without one, this process.
        on_level: called for every level that was not on disk before.
    """
    jobs = [Job(run, trial) for run in runs for trial in run.begin()]
    queue = JobQueue(jobs, on_level)
    with seal_runs(runs):
        try:
            (executor or SerialExecutor()).execute(queue)
            _miss_what_is_gone(runs, queue)
        finally:
            results = tuple(run.write() for run in runs)
    return Outcome(results=results, failures=tuple(queue.failures))


def _miss_what_is_gone(runs: Sequence[Run], queue: JobQueue) -> None:
    """Fail a run if a finished trial is not on disk any more."""
    for run in runs:
        for trial in run.unfinished_trials()[:1]:
            name = path_of(run.out, trial.index)
            message = "was run, but its file is incomplete now. Continue with --resume."
            job = Job(run, trial)
            queue.failed(job, RunFailed(f"{name}: {job} {message}"))


def run_all(
    runs: Sequence[Run], executor: Executor | None = None, *, on_level: OnLevel = lambda: None
) -> tuple[Result, ...]:
    """As `run_each`; raises the first failure.

    Raises:
        NeverStarted: a start trigger never went on.
        ResultError: what is stored belongs to another run, or cannot be reproduced.
        RunFailed: a trial lost its worker too often.
        UwsimError: whatever else was the first to go wrong. What is finished is kept, and written.
    """
    outcome = run_each(runs, executor, on_level=on_level)
    for _, error in outcome.failures:
        raise error
    return outcome.results
