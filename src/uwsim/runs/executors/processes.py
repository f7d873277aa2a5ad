"""Processes of this machine, each with its own graphics context and one thread a library.

They are started with ``spawn``, those of a sealed run by `ClosedForks`. They write rows where the
result is; what they say through their pipe is only how far they are. A worker that dies takes
nothing with it but the level it was in: a fresh one runs its trial again, and has to reproduce the
rows that are on disk. No process sees two algorithms. A call into an algorithm that kills its
process twice, or does not come back, is left out when its trial is run again, and its row says so.
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
from ...base.terminal import ignore_casts
from ...simulation import BEFORE, Calls, Counter, Cut, open_call
from ..own_process.process import CALL_TIMEOUT, describe_exit
from ..planning.trial_cache import TrialCache
from .closed_forks import ClosedForks, closes_forks
from .executor import ENVIRONMENT, Job, JobQueue, SerialExecutor, run_and_record
from .parent_watch import exit_with_parent, start_ignoring_interrupts
from .worker import TrialFailed, picklable

PATIENCE = 10.0
"""How long a worker without work may take to leave, before it is made to [s]."""
GLANCE = 1.0
"""The longest time between two looks at the calls [s]."""


@dataclass(frozen=True)
class LevelKept:
    """A level is on disk that was not there before."""


@dataclass(frozen=True)
class TrialDone:
    """A trial is on disk."""


News = LevelKept | TrialDone | TrialFailed


class ProcessExecutor:
    """A number of processes; a trial that loses its worker is repeated by a new one.

    A single bundled algorithm, with one worker or one trial, runs in this process: a
    process would only cost its start.

    Args:
        n: how many at most.
        callback_limit: how long a call into an algorithm may take [s of wall time]; None: for ever.
    """

    def __init__(self, n: int, *, callback_limit: float | None = None) -> None:
        self._n, self._limit = n, callback_limit
        self._glance = None if callback_limit is None else min(GLANCE, callback_limit / 4)

    def execute(self, queue: JobQueue) -> None:
        """Execute all jobs; stops all workers when interrupted."""
        limit = self._limit
        n = min(self._n, len(queue))
        plans = queue.plans()
        if n <= 1 and len(plans) <= 1 and all(plan.is_bundled for plan in plans):
            SerialExecutor().execute(queue)
            return
        settings = ENVIRONMENT if n > 1 else {}
        forks = ClosedForks() if queue.is_sealed and closes_forks() else None
        start = partial(WorkerProcess, settings, limit, forks)
        workers = [start() for _ in range(n)]
        try:
            while True:
                for i, worker in enumerate(workers):
                    if worker.job is None and (job := queue.take()) is not None:
                        if not worker.may_play(job):
                            worker.kill()
                            workers[i] = start()
                        workers[i].give(job)
                busy = [worker for worker in workers if worker.job is not None]
                if not busy:
                    break
                self._attend(busy, queue)
            for worker in workers:
                worker.dismiss()
        finally:
            for worker in workers:
                worker.kill()

    def _attend(self, busy: list[WorkerProcess], queue: JobQueue) -> None:
        """Wait until one of them has a report, or for a short time."""
        began = time.monotonic()
        wait([handle for worker in busy for handle in worker.handles], self._glance)
        waited = time.monotonic() - began
        for worker in busy:
            worker.report(queue)
            if self._limit is not None and self._glance is not None:
                # of a time in which this process itself was stopped only so much counts
                worker.watch(queue, min(waited, 2 * self._glance), self._limit)


class WorkerProcess:
    """A worker process, seen from its parent.

    Args:
        settings: environment variables that it gets unless the user has set them.
        limit: how long a call into an algorithm in a process of its own may take [s].
        forks: make the processes of a sealed run.
    """

    def __init__(
        self,
        settings: Mapping[str, str],
        limit: float | None = None,
        forks: ClosedForks | None = None,
    ) -> None:
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        parent, self._parent = context.Pipe(duplex=False)
        self._counter: Counter = context.RawValue(ctypes.c_longlong, BEFORE)
        arguments = (theirs, parent, self._counter, limit)
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
        for end in (theirs, parent):
            end.close()  # so that a pipe ends when the process at its other end does
        self.job: Job | None = None
        """The job it executes."""
        self._algorithm: str | None = None  # the only one that it runs
        self._seen, self._seen_for = BEFORE, 0.0  # the counter, and for how long it has stood [s]

    @property
    def handles(self) -> tuple[Connection, int]:
        """Handles that become ready when it has a report or has ended."""
        return self._pipe, self._process.sentinel

    def may_play(self, job: Job) -> bool:
        """Whether it can be given a job: it is alive, and has run no other algorithm."""
        name = job.run.plan.algorithm.name
        return self._process.is_alive() and self._algorithm in (None, name)

    def give(self, job: Job) -> None:
        """Give it a job; if it has ended, the next `report` reports that."""
        self.job, self._algorithm = job, job.run.plan.algorithm.name
        with suppress(OSError):
            self._pipe.send(job)

    def report(self, queue: JobQueue) -> None:
        """Tell the queue what has happened since the last report."""
        assert self.job is not None
        is_alive = self._process.is_alive()  # read first, so that its last reports are received
        for news in self._news():
            if isinstance(news, LevelKept):
                queue.level(self.job)
                continue
            if isinstance(news, TrialDone):
                queue.done(self.job)
            else:
                queue.failed(self.job, news.error)
            self.job = None
            return
        if not is_alive:
            self._process.join()
            queue.lost(
                self.job, describe_exit(self._process.exitcode), open_call(self._counter.value)
            )
            self.job = None

    def watch(self, queue: JobQueue, waited: float, limit: float) -> None:
        """End it if the call into the algorithm has taken longer than ``limit`` [s].

        Args:
            queue: receives the events.
            waited: time since the last look [s].
            limit: how long a call may take [s].
        """
        count = self._counter.value
        self._seen_for = self._seen_for + waited if count == self._seen else 0.0
        self._seen = count
        call = open_call(count)
        if self.job is None or call is None:
            return
        if self.job.run.plan.algorithm.own_process:
            limit *= 2.0  # the worker itself looks at the clock
        if self._seen_for <= limit:
            return
        self._process.kill()
        self._process.join()
        queue.stopped(self.job, Cut(call, CALL_TIMEOUT))
        self.job = None

    def dismiss(self) -> None:
        """Tell it to end, and wait until it has ended."""
        with suppress(OSError):
            self._pipe.send(None)
        self._process.join(PATIENCE)

    def kill(self) -> None:
        """Kill it, if it has not ended."""
        self._process.kill()
        self._process.join()
        self._process.close()
        self._pipe.close()
        self._parent.close()

    def _news(self) -> Iterator[News]:
        with suppress(EOFError, OSError):
            while self._pipe.poll():
                yield self._pipe.recv()


def work(
    pipe: Connection, parent: Connection, counter: Counter, limit: float | None = None
) -> None:
    """Run the jobs from the pipe until ``None`` comes, or until the parent has ended."""
    exit_with_parent(parent)
    ignore_casts()
    cache = TrialCache()
    try:
        while (job := pipe.recv()) is not None:
            try:
                for _ in run_and_record(job, cache, Calls(counter, job.cut, limit=limit)):
                    pipe.send(LevelKept())
            except BaseException as error:
                if is_user_interrupt(error):
                    raise
                pipe.send(TrialFailed(picklable(error)))
            else:
                pipe.send(TrialDone())
    except (EOFError, OSError):
        pass  # the employer has gone
    finally:
        cache.close()
