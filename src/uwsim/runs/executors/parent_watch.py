"""The end of a process when its parent ends, for any reason.

The parent holds the writing end of a pipe, and writes nothing. The system closes that end when the
parent ends, and the process at the reading end detects this at once.
"""

from __future__ import annotations

import os
import threading
from contextlib import suppress
from multiprocessing import resource_tracker
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess

from ...base.interrupts import block_interrupts


def start_ignoring_interrupts(process: BaseProcess) -> None:
    """Start a process that ignores Ctrl-C, which its parent handles."""
    resource_tracker.ensure_running()  # else it starts with the process, and Ctrl-C reaches it
    with block_interrupts():
        process.start()


def exit_with_parent(parent: Connection) -> None:
    """End this process as soon as the parent has ended.

    Args:
        parent: the reading end of a pipe whose writing end the parent alone holds.
    """
    threading.Thread(target=_exit_with, args=(parent,), daemon=True).start()


def _exit_with(parent: Connection) -> None:
    with suppress(EOFError, OSError):
        parent.recv()
    os._exit(1)
