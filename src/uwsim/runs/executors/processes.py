"""An executor with worker processes on this machine, each with its own graphics context.

Workers are started with ``spawn``, or by `ProtectedForks` for a sealed run: the journals of such a
run are encrypted until it ends, so that the algorithm cannot read the ground truth in them. Workers
write rows into the result directory and report their progress through a pipe. A worker that ends
loses only its current level: a new worker runs the trial again, and must reproduce the rows on
disk. No worker runs two algorithms. If a call into the algorithm ends its process twice, or does
not return, the trial is run again without that call and all later calls; the row states the reason.
"""

from __future__ import annotations

import ctypes
import multiprocessing
import time
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess

from ...base.environment import set_environment
from ...base.interrupts import is_user_interrupt
from ...base.terminal import suppress_cast_warnings
from ...simulation import NO_CALLS, Calls, Counter, Cut, unfinished_call
from ..own_process.process import CALL_TIMEOUT, describe_exit
from ..planning.trial_cache import TrialCache
from .executor import ENVIRONMENT, Job, JobQueue, SerialExecutor, run_and_record
from .parent_watch import exit_with_parent, start_ignoring_interrupts
from .protected_forks import ProtectedForks, can_protect_forks
from .worker import TrialFailed, make_picklable

EXIT_TIMEOUT = 10.0
"""The time after which a worker that was requested to end is killed [s of wall time]."""
POLL_PERIOD = 1.0
"""The longest time between two checks of the duration of calls [s of wall time]."""


@dataclass(frozen=True)
class LevelStored:
    """The event that a new level has been written to disk."""


@dataclass(frozen=True)
class TrialFinished:
    """The event that the end of a trial has been written to disk."""


Report = LevelStored | TrialFinished | TrialFailed


class ProcessExecutor:
    """An executor with several processes; a trial that loses its worker is repeated by a new one.

    A single bundled algorithm, with one worker or one trial, runs in this process, which saves the
    time to start a worker.

    Args:
        n: the greatest number of processes.
        callback_limit: the longest call into an algorithm [s of wall time]; None for no limit. It
            does not hold for a bundled algorithm that runs in this process.
    """

    def __init__(self, n: int, *, callback_limit: float | None = None) -> None:
        self._n, self._limit = n, callback_limit
        self._poll_period = None if callback_limit is None else min(POLL_PERIOD, callback_limit / 4)

    def execute(self, queue: JobQueue) -> None:
        """Execute all jobs; stop all workers when interrupted."""
        limit = self._limit
        n = min(self._n, len(queue))
        plans = queue.plans()
        if n <= 1 and len(plans) <= 1 and all(plan.is_bundled for plan in plans):
            SerialExecutor().execute(queue)
            return
        settings = ENVIRONMENT if n > 1 else {}
        forks = ProtectedForks() if queue.is_sealed and can_protect_forks() else None
        start = partial(WorkerProcess, settings, limit, forks)
        workers = [start() for _ in range(n)]
        try:
            while True:
                for i, worker in enumerate(workers):
                    if worker.job is None and (job := queue.pop()) is not None:
                        if not worker.accepts(job):
                            worker.kill()
                            workers[i] = start()
                        workers[i].assign(job)
                busy_workers = [worker for worker in workers if worker.job is not None]
                if not busy_workers:
                    break
                self._wait_for_reports(busy_workers, queue)
            for worker in workers:
                worker.dismiss()
        finally:
            for worker in workers:
                worker.kill()

    def _wait_for_reports(self, busy_workers: list[WorkerProcess], queue: JobQueue) -> None:
        start = time.monotonic()
        wait([handle for worker in busy_workers for handle in worker.handles], self._poll_period)
        wait_time = time.monotonic() - start
        for worker in busy_workers:
            worker.report(queue)
            if self._limit is not None and self._poll_period is not None:
                # the time for which this process itself was suspended does not count
                worker.watch(queue, min(wait_time, 2 * self._poll_period), self._limit)


class WorkerProcess:
    """The parent's handle of a worker process.

    Args:
        settings: environment variables of the worker, unless the user has set them.
        limit: the longest call into an algorithm in a process of its own [s of wall time].
        forks: creates the processes of a sealed run; None if the run is not sealed, or if the
            system cannot deny access to the memory of processes.
    """

    def __init__(
        self,
        settings: Mapping[str, str],
        limit: float | None = None,
        forks: ProtectedForks | None = None,
    ) -> None:
        context = multiprocessing.get_context("spawn")
        self._pipe, child_pipe = context.Pipe()
        parent, self._parent = context.Pipe(duplex=False)
        self._counter: Counter = context.RawValue(ctypes.c_longlong, NO_CALLS)
        arguments = (child_pipe, parent, self._counter, limit)
        self._process: BaseProcess = (
            forks.make(work, arguments, settings)
            if forks is not None
            else context.Process(target=work, args=arguments)
        )
        with set_environment(settings):
            if forks is not None:
                forks.start(self._process)
            else:
                start_ignoring_interrupts(self._process)
        for end in (child_pipe, parent):
            end.close()  # so that a pipe ends when the process at its other end does
        self.job: Job | None = None
        """The job that the worker executes; None if it is idle."""
        self._algorithm: str | None = None  # the name of the only algorithm that the worker runs
        # the last value of the counter of calls, and the time since it changed [s]
        self._last_count, self._count_age = NO_CALLS, 0.0

    @property
    def handles(self) -> tuple[Connection, int]:
        """Handles that become ready when the worker has sent a report or has ended."""
        return self._pipe, self._process.sentinel

    def accepts(self, job: Job) -> bool:
        """Return whether the worker accepts a job: it is alive, and has run no other algorithm."""
        name = job.run.plan.algorithm.name
        return self._process.is_alive() and self._algorithm in (None, name)

    def assign(self, job: Job) -> None:
        """Send a job to the worker; if the worker has ended, the next `report` reports that."""
        self.job, self._algorithm = job, job.run.plan.algorithm.name
        with suppress(OSError):
            self._pipe.send(job)

    def report(self, queue: JobQueue) -> None:
        """Report the worker's new events, or its end, to the queue."""
        assert self.job is not None
        is_alive = self._process.is_alive()  # read before the reports, so that none is missed
        for event in self._reports():
            if isinstance(event, LevelStored):
                queue.report_level(self.job)
                continue
            if isinstance(event, TrialFinished):
                queue.report_finish(self.job)
            else:
                queue.report_failure(self.job, event.error)
            self.job = None
            return
        if not is_alive:
            self._process.join()
            queue.report_loss(
                self.job,
                describe_exit(self._process.exitcode),
                unfinished_call(self._counter.value),
            )
            self.job = None

    def watch(self, queue: JobQueue, wait_time: float, limit: float) -> None:
        """Kill the worker if its current call into the algorithm has taken longer than ``limit``.

        Args:
            queue: the queue that receives the events.
            wait_time: the time since the last check [s of wall time].
            limit: the longest call [s of wall time].
        """
        count = self._counter.value
        self._count_age = self._count_age + wait_time if count == self._last_count else 0.0
        self._last_count = count
        call = unfinished_call(count)
        if self.job is None or call is None:
            return
        if self.job.run.plan.algorithm.own_process:
            limit *= 2.0  # the worker itself enforces the limit, and is killed only if it fails to
        if self._count_age <= limit:
            return
        self._process.kill()
        self._process.join()
        queue.report_stop(self.job, Cut(call, CALL_TIMEOUT))
        self.job = None

    def dismiss(self) -> None:
        """Request the worker to end, and wait for its end up to `EXIT_TIMEOUT`."""
        with suppress(OSError):
            self._pipe.send(None)
        self._process.join(EXIT_TIMEOUT)

    def kill(self) -> None:
        """Kill the worker if it has not ended, and release its pipes."""
        self._process.kill()
        self._process.join()
        self._process.close()
        self._pipe.close()
        self._parent.close()

    def _reports(self) -> Iterator[Report]:
        with suppress(EOFError, OSError):
            while self._pipe.poll():
                yield self._pipe.recv()


def work(
    pipe: Connection, parent: Connection, counter: Counter, limit: float | None = None
) -> None:
    """Run the jobs from the pipe until ``None`` arrives, or until the parent has ended.

    Args:
        pipe: the connection that receives jobs and sends reports.
        parent: the reading end of the pipe that closes with the parent (`exit_with_parent`).
        counter: the shared counter of calls into the algorithm.
        limit: the longest call into an algorithm in a process of its own [s of wall time].
    """
    exit_with_parent(parent)
    suppress_cast_warnings()
    cache = TrialCache()
    try:
        while (job := pipe.recv()) is not None:
            try:
                for _ in run_and_record(job, cache, Calls(counter, job.cut, limit=limit)):
                    pipe.send(LevelStored())
            except BaseException as error:
                if is_user_interrupt(error):
                    raise
                pipe.send(TrialFailed(make_picklable(error)))
            else:
                pipe.send(TrialFinished())
    except (EOFError, OSError):
        pass  # the parent has ended
    finally:
        cache.close()
