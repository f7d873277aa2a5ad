"""A background process of a run: it draws the report and executes the control run.

The control run is the same benchmark with an algorithm that ignores the images (`frozen`). Neither
job needs OpenGL. The process starts with the run and imports the code of reports before its
first job. If the process ends early, the process of the run executes the remaining jobs.
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

from ...base.terminal import suppress_cast_warnings
from ...errors import RunFailed, UwsimError
from .parent_watch import exit_with_parent, start_ignoring_interrupts

if TYPE_CHECKING:
    from ..run import Run

BackgroundJob: TypeAlias = Union["Run", Path]
"""A run to execute, or a result directory whose report is to be drawn."""
Reporter = Callable[[], Callable[[Path], object]]
"""A function that imports and returns the function that draws a report; the import is slow."""


class JobRunner:
    """A runner of jobs in this process; each call of `wait` executes one job.

    Args:
        reporter: the function that imports and returns the function that draws a report.
    """

    def __init__(self, reporter: Reporter) -> None:
        self._reporter = reporter
        self._queue: deque[BackgroundJob] = deque()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Release nothing: jobs in this process hold no resource."""

    def local_runner(self) -> JobRunner:
        """Return a runner with the same reporter that executes its jobs in this process."""
        return JobRunner(self._reporter)

    def submit(self, job: BackgroundJob) -> None:
        """Append a job to the queue."""
        self._queue.append(job)

    def wait(self) -> None:
        """Wait for the oldest submitted job for which no call has waited yet.

        Raises:
            RunFailed: the job failed.
        """
        reason = self._execute(self._queue.popleft())
        if reason is not None:
            raise RunFailed(reason)

    def _execute(self, job: BackgroundJob) -> str | None:
        return _run_job(job, self._reporter)


class BackgroundProcess(JobRunner):
    """A runner of jobs in a child process, which also ends if this process does.

    A context manager: the child is killed at the end of the block. The child imports the main
    module of this program again.
    """

    def __init__(self, reporter: Reporter) -> None:
        super().__init__(reporter)
        context = multiprocessing.get_context("spawn")
        self._pipe, child = context.Pipe()
        parent, self._parent = context.Pipe(duplex=False)
        self._process = context.Process(target=_serve, args=(child, parent, reporter), daemon=True)
        start_ignoring_interrupts(self._process)
        child.close()
        parent.close()

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._process.kill()
        self._process.join()
        self._pipe.close()
        self._parent.close()

    def submit(self, job: BackgroundJob) -> None:
        """Send a job to the child process."""
        super().submit(job)
        with suppress(OSError):  # the child has ended: `wait` executes the job
            self._pipe.send(job)

    def _execute(self, job: BackgroundJob) -> str | None:
        """Wait for a job of the child; execute the job in this process if the child has ended."""
        try:
            return cast("str | None", self._pipe.recv())
        except (EOFError, OSError):
            return super()._execute(job)


def _serve(pipe: Connection, parent: Connection, reporter: Reporter) -> None:
    """Execute jobs until the parent has ended or closes the pipe."""
    exit_with_parent(parent)
    suppress_cast_warnings()
    with suppress(Exception):  # a slow import, while levels run; `_run_job` reports its errors
        reporter()
    gc.freeze()  # no collection of the loaded modules, which remain in use
    with suppress(EOFError, OSError):  # the parent has ended
        while True:
            pipe.send(_run_job(pipe.recv(), reporter))


def _run_job(job: BackgroundJob, reporter: Reporter) -> str | None:
    """Execute a job; return the reason of its failure, or None."""
    try:
        if isinstance(job, Path):
            reporter()(job)
        else:
            from .executor import run_all  # slow to import, and not needed for reports

            run_all([job])
    except UwsimError as error:
        return str(error)
    except Exception as error:  # a full disk, a number that no plot can show
        from ...benchmark.plugin import format_exception

        name = "The report" if isinstance(job, Path) else "The control run"
        message = f"{name} failed: {format_exception(error)}"
        return f"{message}. Finished rows are kept; continue with --resume."
    return None
