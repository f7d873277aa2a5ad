"""A leash: how a process ends when its employer is gone, however that came to its end.

The employer holds one end of a pipe that nobody writes into. The system closes it with the
employer, and the process at the other end notices at once.
"""

from __future__ import annotations

import os
import threading
from contextlib import suppress
from multiprocessing import resource_tracker
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess

from ...interrupts import born_deaf


def start_deaf(process: BaseProcess) -> None:
    """Start a process that hears no Ctrl-C, which is for its employer alone."""
    resource_tracker.ensure_running()  # else it starts with the process, and lets Ctrl-C through
    with born_deaf():
        process.start()


def put_on(leash: Connection) -> None:
    """End this process as soon as nobody holds the other end of the leash."""
    threading.Thread(target=_leave_with, args=(leash,), daemon=True).start()


def _leave_with(leash: Connection) -> None:
    with suppress(EOFError, OSError):
        leash.recv()
    os._exit(1)
