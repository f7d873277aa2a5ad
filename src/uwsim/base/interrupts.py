"""Interruption of a command by Ctrl-C and signals: at once until there are results to keep.

Python answers Ctrl-C by raising KeyboardInterrupt wherever it happens to be, and while libraries
are loaded that is inside them: some turn it into another error, some print it and go on. So a
command begins with `exit_on_interrupt`, and calls `raise_on_interrupt` before it writes its first
file. From then on SIGTERM, and the SIGHUP of a closed terminal, have the effect of Ctrl-C.

Some libraries call Python from compiled code and do not look for an error: moderngl's crashes the
process when it makes a program's uniforms, numba's goes on with a named tuple that is not there.
While one of them is at work an interrupt waits. One that something has swallowed all the same is
raised again by `raise_if_interrupted`, before a row is kept that it has spoiled.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Event, Timer, current_thread, get_ident, main_thread
from types import FrameType

INTERRUPTED_STATUS = 130
"""Exit status of what was interrupted: that of shells."""
UNSAFE_PACKAGES = ("moderngl", "_moderngl", "glcontext", "numba", "llvmlite")
"""Packages that an exception from nowhere may break; and the named tuples that numba makes."""
RETRY_DELAY = 0.02
"""How long an interrupt waits before it tries again [s]."""
_was_raised = Event()
_is_pending = Event()
_is_blocked = Event()


def exit_on_interrupt() -> None:
    """From now on Ctrl-C ends this process with one line, unless SIGINT is ignored."""
    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
        signal.signal(signal.SIGINT, _end)


def raise_on_interrupt() -> None:
    """From now on the signals that ended the process at once raise KeyboardInterrupt."""
    _was_raised.clear()  # one that waits goes on waiting
    if signal.getsignal(signal.SIGINT) is _end:
        signal.signal(signal.SIGINT, _raise)
    for number in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, _raise)


def raise_if_interrupted() -> None:
    """Raise KeyboardInterrupt if one waits, or was raised here and something has caught it."""
    raise_pending_interrupt()
    if _was_raised.is_set():
        _was_raised.clear()
        raise KeyboardInterrupt


def raise_pending_interrupt() -> None:
    """Raise KeyboardInterrupt if one waits until a library may be interrupted: now it may be."""
    if _is_pending.is_set() and current_thread() is main_thread():
        _interrupt()


def ignore_interrupts() -> None:
    """From now on Ctrl-C does nothing: the work is done and the exit status is known.

    For the last milliseconds of a process: Python gives SIGINT its default action back before it
    leaves, and would die of the signal where everything was written and 0 is the answer.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def are_interrupts_unblocked() -> bool:
    """Whether Ctrl-C reaches this process, so that a KeyboardInterrupt may be the user's."""
    return signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, ())


def is_user_interrupt(error: BaseException) -> bool:
    """Whether an exception may be the user's Ctrl-C."""
    return isinstance(error, KeyboardInterrupt) and are_interrupts_unblocked()


@contextmanager
def block_interrupts() -> Iterator[None]:
    """Start processes in this block that ignore Ctrl-C for as long as they run.

    For this process it waits until the block is left. The system may hand it to another thread,
    which does not block it, and Python would raise it in the main one: that one waits, too.
    """
    previous_mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    is_outermost = current_thread() is main_thread() and not _is_blocked.is_set()
    if is_outermost:
        _is_blocked.set()
    try:
        yield
    finally:
        if is_outermost:
            _is_blocked.clear()
        signal.pthread_sigmask(signal.SIG_SETMASK, previous_mask)


def _raise(number: int, frame: FrameType | None) -> None:
    if _is_blocked.is_set() or _is_unsafe(frame):
        _try_again(number)
    else:
        _interrupt()


def _end(number: int, frame: FrameType | None) -> None:
    if _is_blocked.is_set():
        _try_again(number)
    else:
        os.write(2, b"uwsim: interrupted.\n")
        os._exit(INTERRUPTED_STATUS)


def _interrupt() -> None:
    _is_pending.clear()
    _was_raised.set()
    raise KeyboardInterrupt


def _is_unsafe(frame: FrameType | None) -> bool:
    """Whether one of the packages that may break is at work."""
    while frame is not None:
        package = str(frame.f_globals.get("__name__")).partition(".")[0]
        if package in UNSAFE_PACKAGES or package.startswith("namedtuple_"):
            return True
        frame = frame.f_back
    return False


def _try_again(number: int) -> None:
    """Send this thread, the main one, the signal in a moment, unless it was raised until then."""
    _is_pending.set()
    timer = Timer(RETRY_DELAY, _send, (get_ident(), number))
    timer.daemon = True
    timer.start()


def _send(thread: int, number: int) -> None:
    if _is_pending.is_set():
        signal.pthread_kill(thread, number)
