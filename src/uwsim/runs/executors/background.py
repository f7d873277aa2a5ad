"""A background process of a run: it draws the report, and runs the control of workers' trials.

Both need no image and no OpenGL, and a run in one process leaves a core half idle. Started early,
this one has loaded what reports need by the time it is asked. Should it die, the run does its jobs.
"""

from __future__ import annotations

import gc
import multiprocessing
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from multiprocessing.connection import Connection
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Self, TypeAlias, Union, cast

from ...base.terminal import ignore_casts
from ...errors import RunFailed, UwsimError
from .parent_watch import exit_with_parent, start_ignoring_interrupts

if TYPE_CHECKING:
    from ..run import Run

Job: TypeAlias = Union["Run", Path]
"""A run to execute, or a result directory whose report is drawn."""
Reporter = Callable[[], Callable[[Path], object]]
"""Loads what draws the report of a result directory, which is heavy; returns it."""


class Jobs:
    """Executes jobs one after the other in this process, each when it is waited for."""

    def __init__(self, reporter: Reporter) -> None:
        self._reporter = reporter
        self._asked: deque[Job] = deque()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Hold nothing."""

    def local_jobs(self) -> Jobs:
        """Return what executes such jobs in this process."""
        return Jobs(self._reporter)

    def ask(self, job: Job) -> None:
        """Give it something to do."""
        self._asked.append(job)

    def wait(self) -> None:
        """Wait until the oldest job that was not waited for is done.

        Raises:
            RunFailed: it could not be done.
        """
        why = self._execute(self._asked.popleft())
        if why is not None:
            raise RunFailed(why)

    def _execute(self, job: Job) -> str | None:
        """Do a job; returns why it could not be done."""
        return _done(job, self._reporter)


class BackgroundProcess(Jobs):
    """Executes jobs one after the other in its own process, which ends with this one.

    A context manager: whatever the process was about when the block is left, it is stopped. The
    main module of a program that starts one is imported there again.
    """

    def __init__(self, reporter: Reporter) -> None:
        super().__init__(reporter)
        context = multiprocessing.get_context("spawn")
        self._here, there = context.Pipe()
        parent, self._parent = context.Pipe(duplex=False)
        self._process = context.Process(target=_serve, args=(there, parent, reporter), daemon=True)
        start_ignoring_interrupts(self._process)
        there.close()
        parent.close()

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._process.kill()
        self._process.join()
        self._here.close()
        self._parent.close()

    def ask(self, job: Job) -> None:
        """Give it something to do."""
        super().ask(job)
        with suppress(OSError):  # it is gone: `wait` sees to the job
            self._here.send(job)

    def _execute(self, job: Job) -> str | None:
        """Wait for a job; do it here if the process is lost."""
        try:
            return cast("str | None", self._here.recv())
        except (EOFError, OSError):  # the process died
            return super()._execute(job)


def _serve(there: Connection, parent: Connection, reporter: Reporter) -> None:
    """Execute jobs until the parent has ended or closes the pipe."""
    exit_with_parent(parent)
    ignore_casts()
    with suppress(Exception):  # heavy, and loaded while the levels run; errors are reported below
        reporter()
    gc.freeze()  # what is loaded stays
    with suppress(EOFError, OSError):  # the parent has gone
        while True:
            there.send(_done(there.recv(), reporter))


def _done(job: Job, reporter: Reporter) -> str | None:
    """Do it; returns why it could not be done."""
    try:
        if isinstance(job, Path):
            reporter()(job)
        else:
            from .executor import run_all  # heavy, and needless for reports

            run_all([job])
    except UwsimError as error:
        return str(error)
    except Exception as error:  # a full disk, a number that no plot can show
        from ...benchmark.plugin import raised

        what = "The report" if isinstance(job, Path) else "The control"
        return f"{what} failed: {raised(error)}. Finished rows are kept; continue with --resume."
    return None
