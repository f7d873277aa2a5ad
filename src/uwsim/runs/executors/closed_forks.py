"""Processes whose memory other processes of the user cannot open, from their beginning on.

A process that is started as a program can be opened until it denies that itself, and who has opened
it keeps the access. A fork inherits the denial. So the workers of a sealed run are forks of a
process, the *fork server*, that denied it before any code of an algorithm ran. Where the fork
server has ended, no other one takes its place: an algorithm could have opened that.
"""

from __future__ import annotations

import importlib
import multiprocessing
import os
import sys
from collections.abc import Callable, Mapping
from contextlib import suppress
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import Any

from ...errors import RunFailed
from .parent_watch import start_ignoring_interrupts

SERVER_ENDED = (
    "The process that starts the workers of this run has ended; those of another one could be "
    "looked into by the algorithm. Continue with --resume."
)
CLOSED = f"{__package__}.closed"
"""The module that the fork server imports first."""


class ClosedForks:
    """Makes and starts the workers of one sealed run."""

    def __init__(self) -> None:
        self._context = multiprocessing.get_context("forkserver")
        self._context.set_forkserver_preload([CLOSED])
        self._server: int | None = None

    def make(
        self, target: Callable[..., None], arguments: tuple[Any, ...], settings: Mapping[str, str]
    ) -> BaseProcess:
        """Return a process that is to be started.

        Args:
            target: what it runs.
            arguments: of the target.
            settings: environment variables that it gets unless the user has set them.
        """
        name = (target.__module__, target.__qualname__)  # imported there, in its environment
        variables = {**settings, **os.environ}  # those of the fork server may be older
        return self._context.Process(target=begin, args=(variables, name, arguments))

    def start(self, process: BaseProcess) -> None:
        """Start a process, as a fork of the first fork server.

        Raises:
            RunFailed: that has ended; a process that another one started is killed.
        """
        try:
            start_ignoring_interrupts(process)
        except (EOFError, OSError):  # it ends just now
            raise RunFailed(SERVER_ENDED) from None
        server = parent_of(process.pid)
        self._server = self._server or server
        if server not in (None, self._server):  # None: the process has ended already
            process.kill()
            process.join()
            raise RunFailed(SERVER_ENDED)


def begin(
    variables: Mapping[str, str], target: tuple[str, str], arguments: tuple[Any, ...]
) -> None:
    """Run a function, named by its module and its name, with these environment variables."""
    os.environ.clear()
    os.environ.update(variables)
    importlib.import_module(CLOSED)  # where a program had started a fork server of its own before
    getattr(importlib.import_module(target[0]), target[1])(*arguments)


def parent_of(pid: int | None) -> int | None:
    """Return the parent of a process; None if it has ended."""
    with suppress(OSError, ValueError, IndexError):
        return int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[1])
    return None


def closes_forks() -> bool:
    """Whether this system has processes that can be closed."""
    return sys.platform == "linux"
