"""A crew of processes on this machine, each with its own graphics context and one thread a library.

They are started with ``spawn`` and write rows where the result is; what they say through their pipe
is only how far they are. A worker that dies takes nothing with it but the level it was in: a fresh
one plays its unit again, and has to reproduce the rows that are on disk.
"""

from __future__ import annotations

import multiprocessing
import signal
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait

from ..environment import environment
from ..simulation import Studio
from .crew import ENVIRONMENT, Here, Job, Roster, play_and_keep
from .leash import put_on, start_deaf
from .unit_work import UnitFailed, portable

PATIENCE = 10.0
"""How long a worker without work may take to leave, before it is made to [s]."""


@dataclass(frozen=True)
class LevelKept:
    """A level is on disk that was not there before."""


@dataclass(frozen=True)
class UnitDone:
    """A unit is on disk."""


News = LevelKept | UnitDone | UnitFailed


class Processes:
    """So many processes; a unit that loses its worker is played again by a fresh one.

    A single unit is played here: a process would only cost its start.

    Args:
        n: how many at most.
    """

    def __init__(self, n: int) -> None:
        self._n = n

    def play(self, roster: Roster) -> None:
        """Play everything; stops all workers when it is interrupted."""
        if len(roster) < 2:
            Here().play(roster)
            return
        workers = [Worker() for _ in range(min(self._n, len(roster)))]
        try:
            while True:
                for i, worker in enumerate(workers):
                    if worker.job is None and (job := roster.take()) is not None:
                        if not worker.is_alive:
                            worker.kill()
                            workers[i] = Worker()
                        workers[i].give(job)
                busy = [worker for worker in workers if worker.job is not None]
                if not busy:
                    break
                wait([handle for worker in busy for handle in worker.handles])
                for worker in busy:
                    worker.report(roster)
            for worker in workers:
                worker.dismiss()
        finally:
            for worker in workers:
                worker.kill()


class Worker:
    """A process as its employer sees it."""

    def __init__(self) -> None:
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        leash, self._leash = context.Pipe(duplex=False)
        self._process = context.Process(target=work, args=(theirs, leash))
        with environment(ENVIRONMENT):
            start_deaf(self._process)
        for end in (theirs, leash):
            end.close()  # so that a pipe ends when the process at its other end does
        self.job: Job | None = None
        """What it is playing."""

    @property
    def handles(self) -> tuple[Connection, int]:
        """What becomes ready when it has something to say, or dies."""
        return self._pipe, self._process.sentinel

    @property
    def is_alive(self) -> bool:
        """Whether it can be given a job."""
        return self._process.is_alive()

    def give(self, job: Job) -> None:
        """Have it play a job; should it be gone, the next `report` says so."""
        self.job = job
        with suppress(OSError):
            self._pipe.send((job.bench, job.unit))

    def report(self, roster: Roster) -> None:
        """Tell the roster what has happened since the last report."""
        assert self.job is not None
        is_alive = self._process.is_alive()  # asked first: what it said before it died is heard
        for news in self._news():
            if isinstance(news, LevelKept):
                roster.level(self.job)
                continue
            if isinstance(news, UnitDone):
                roster.done(self.job)
            else:
                roster.failed(self.job, news.error)
            self.job = None
            return
        if not is_alive:
            self._process.join()
            roster.lost(self.job, how(self._process.exitcode))
            self.job = None

    def dismiss(self) -> None:
        """Tell it that there is no more to do, and wait until it has gone."""
        with suppress(OSError):
            self._pipe.send(None)
        self._process.join(PATIENCE)

    def kill(self) -> None:
        """End it, whatever it is doing; nothing happens if it has gone."""
        self._process.kill()
        self._process.join()
        self._process.close()
        self._pipe.close()
        self._leash.close()

    def _news(self) -> Iterator[News]:
        with suppress(EOFError, OSError):
            while self._pipe.poll():
                yield self._pipe.recv()


def how(exit_code: int | None) -> str:
    """Say how a process ended."""
    if exit_code is not None and exit_code < 0:
        return f"killed by {signal.Signals(-exit_code).name}"
    return f"with exit status {exit_code}"


def work(pipe: Connection, leash: Connection) -> None:
    """Play what comes through the pipe until ``None`` comes, or until nobody holds the leash."""
    put_on(leash)
    studio = Studio()
    try:
        while (job := pipe.recv()) is not None:
            bench, unit = job
            try:
                for _ in play_and_keep(bench, unit, studio):
                    pipe.send(LevelKept())
            except Exception as error:
                pipe.send(UnitFailed(portable(error)))
            else:
                pipe.send(UnitDone())
    except (EOFError, OSError):
        pass  # the employer has gone
    finally:
        studio.close()
