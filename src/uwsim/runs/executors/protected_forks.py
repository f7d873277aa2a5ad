"""Processes whose memory the user's other processes cannot read, from their start.

Other processes can open the memory of a program until it denies access itself, and an open handle
remains valid. A fork inherits the denial. So the workers of a sealed run are forks of a process,
the *fork server*, that denied access before any code of an algorithm ran. A fork server that has
ended is not replaced, as an algorithm could open the memory of the new one.
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
    "The process that starts the workers of this run has ended. The algorithm could read the "
    "memory of other workers. Continue with --resume."
)
PROTECTION_MODULE = f"{__package__}.protect_memory"
"""The module that the fork server imports first."""


class ProtectedForks:
    """The processes of the workers of one sealed run."""

    def __init__(self) -> None:
        self._context = multiprocessing.get_context("forkserver")
        self._context.set_forkserver_preload([PROTECTION_MODULE])
        self._server: int | None = None

    def make(
        self, target: Callable[..., None], arguments: tuple[Any, ...], settings: Mapping[str, str]
    ) -> BaseProcess:
        """Return a process that is not started yet.

        Args:
            target: the function that it runs.
            arguments: the arguments of the function.
            settings: environment variables of the process, unless the user has set them.
        """
        name = (target.__module__, target.__qualname__)  # imported there, in its environment
        variables = {**settings, **os.environ}  # the fork server's environment may be older
        return self._context.Process(target=begin, args=(variables, name, arguments))

    def start(self, process: BaseProcess) -> None:
        """Start a process, as a fork of the first fork server.

        Raises:
            RunFailed: the fork server has ended; a process of another fork server is killed.
        """
        try:
            start_ignoring_interrupts(process)
        except (EOFError, OSError):  # the fork server is ending
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
    importlib.import_module(PROTECTION_MODULE)  # a fork server started earlier has not imported it
    getattr(importlib.import_module(target[0]), target[1])(*arguments)


def parent_of(pid: int | None) -> int | None:
    """Return the process ID of the parent of a process; None if the process has ended."""
    with suppress(OSError, ValueError, IndexError):
        return int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[1])
    return None


def can_protect_forks() -> bool:
    """Return whether processes of this system can deny access to their memory."""
    return sys.platform == "linux"
