"""Interruption of a command by Ctrl-C and signals: at once until there are results to keep.

Python answers Ctrl-C by raising KeyboardInterrupt wherever it happens to be, and while libraries
are loaded that is inside them: some turn it into another error, some print it and go on. So a
command begins with `end_at_once`, and says `raise_from_now_on` before it writes its first file.
From then on the system's SIGTERM, and the SIGHUP of a terminal that is closed, are as Ctrl-C.
An interrupt that a library has turned into another error, as compiled code does that returns a
named tuple, is raised again by `raise_if_interrupted`, before a row is kept that it has spoiled.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Event
from types import FrameType

STATUS = 130
"""Exit status of what was interrupted: that of shells."""
_arrived = Event()


def end_at_once() -> None:
    """From now on Ctrl-C ends this process with one line, unless SIGINT is ignored."""
    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
        signal.signal(signal.SIGINT, _end)


def raise_from_now_on() -> None:
    """From now on the signals that ended the process at once raise KeyboardInterrupt."""
    _arrived.clear()
    if signal.getsignal(signal.SIGINT) is _end:
        signal.signal(signal.SIGINT, _raise)
    for number in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, _raise)


def raise_if_interrupted() -> None:
    """Raise KeyboardInterrupt if one was raised in this process and something has caught it."""
    if _arrived.is_set():
        _arrived.clear()
        raise KeyboardInterrupt


def ignore_from_now_on() -> None:
    """From now on Ctrl-C does nothing: the work is done and the exit status is known.

    For the last milliseconds of a process: Python gives SIGINT its default action back before it
    leaves, and would die of the signal where everything was written and 0 is the answer.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def are_interrupts_unblocked() -> bool:
    """Whether Ctrl-C reaches this process, so that a KeyboardInterrupt may be the user's."""
    return signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, ())


def is_of_user(error: BaseException) -> bool:
    """Whether an exception may be the user's Ctrl-C."""
    return isinstance(error, KeyboardInterrupt) and are_interrupts_unblocked()


@contextmanager
def ignoring_interrupts() -> Iterator[None]:
    """Start processes in this block that ignore Ctrl-C for as long as they run.

    For this process it waits until the block is left.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _raise(number: int, frame: FrameType | None) -> None:
    _arrived.set()
    raise KeyboardInterrupt


def _end(number: int, frame: FrameType | None) -> None:
    os.write(2, b"uwsim: interrupted.\n")
    os._exit(STATUS)
