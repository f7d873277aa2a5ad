"""A second process beside a run: it plays the control and draws the report.

Both need no picture and no OpenGL, and a run in one process leaves a core half idle. Started early,
this one has loaded what it needs by the time it is asked.
"""

from __future__ import annotations

import multiprocessing
import signal
from contextlib import suppress
from multiprocessing.connection import Connection
from pathlib import Path
from types import TracebackType
from typing import Self

from ..errors import RunFailed, UwsimError
from .bench import Bench
from .crew import play_all
from .leash import put_on
from .plugin import raised
from .processes import how

Job = Bench | Path
"""A benchmark is played; of a result directory the report is drawn."""


class Beside:
    """Does jobs one after the other in a process of its own, which ends with this one.

    A context manager: whatever the process was about when the block is left, it is stopped.
    """

    def __init__(self) -> None:
        context = multiprocessing.get_context("spawn")
        self._here, there = context.Pipe()
        leash, self._leash = context.Pipe(duplex=False)
        self._process = context.Process(target=_serve, args=(there, leash), daemon=True)
        self._process.start()
        there.close()
        leash.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._process.kill()
        self._process.join()
        self._here.close()
        self._leash.close()

    def ask(self, job: Job) -> None:
        """Give it something to do."""
        try:
            self._here.send(job)
        except OSError:
            raise RunFailed(self._gone()) from None

    def wait(self) -> None:
        """Wait until the oldest job that was not waited for is done.

        Raises:
            RunFailed: it could not be done, or the process died.
        """
        try:
            why = self._here.recv()
        except (EOFError, OSError):
            raise RunFailed(self._gone()) from None
        if why is not None:
            raise RunFailed(why)

    def _gone(self) -> str:
        """Say that it died, and how."""
        self._process.join()
        ended = how(self._process.exitcode)
        return f"The process that plays the control and draws the report died ({ended}). {_KEPT}"


_KEPT = "Finished rows are kept; go on with --resume."


def _serve(there: Connection, leash: Connection) -> None:
    """Do what comes, until the parent is gone or wants no more."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent decides
    put_on(leash)
    with suppress(Exception):  # heavy, and loaded while the levels are played; below it is told
        from . import report  # noqa: F401
    while True:
        try:
            job = there.recv()
        except EOFError:
            return
        try:
            if isinstance(job, Bench):
                play_all([job])
            else:
                from .report import write_report

                write_report(job)
        except UwsimError as error:
            there.send(str(error))
        except Exception as error:  # a full disk, a number that no plot can show
            what = "The control" if isinstance(job, Bench) else "The report"
            there.send(f"{what} failed: {raised(error)}. {_KEPT}")
        else:
            there.send(None)
