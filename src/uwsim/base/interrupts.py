"""Interruption of a command by Ctrl-C and other signals.

A command begins with `exit_on_interrupt`: Ctrl-C ends it at once. Before it writes its first file,
it calls `raise_on_interrupt`: Ctrl-C, SIGTERM, and the SIGHUP of a closed terminal then raise
KeyboardInterrupt, so that results are kept. This is not done earlier, because libraries that are
being imported convert KeyboardInterrupt to another error, or print it and continue.

Some libraries call Python from compiled code and do not check for an error: moderngl crashes the
process when it creates a program's uniforms, numba continues with a named tuple that does not
exist. So an interrupt is delayed while one of them runs. If a library suppresses an interrupt all
the same, `raise_if_interrupted` raises it again before an invalid row is stored.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Event, Timer, current_thread, get_ident, main_thread
from types import FrameType

INTERRUPTED_STATUS = 130
"""The exit status of an interrupted command, as shells define it."""
UNSAFE_PACKAGES = ("moderngl", "_moderngl", "glcontext", "numba", "llvmlite")
"""The packages whose code an exception in a signal handler may break (`_is_unsafe`)."""
RETRY_DELAY = 0.02
"""The time after which a delayed interrupt is sent again [s]."""
_was_raised = Event()  # KeyboardInterrupt was raised; a library may have suppressed it
_is_pending = Event()  # an interrupt is delayed
_is_blocked = Event()  # `block_interrupts` is active in the main thread


def exit_on_interrupt() -> None:
    """Make Ctrl-C end this process with one line, unless SIGINT is ignored."""
    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
        signal.signal(signal.SIGINT, _end)


def raise_on_interrupt() -> None:
    """Make the signals that end the process raise KeyboardInterrupt instead."""
    _was_raised.clear()  # a pending interrupt stays pending
    if signal.getsignal(signal.SIGINT) is _end:
        signal.signal(signal.SIGINT, _raise)
    for number in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, _raise)


def raise_if_interrupted() -> None:
    """Raise KeyboardInterrupt if one is pending, or was raised and suppressed."""
    raise_pending_interrupt()
    if _was_raised.is_set():
        _was_raised.clear()
        raise KeyboardInterrupt


def raise_pending_interrupt() -> None:
    """Raise a delayed KeyboardInterrupt; called where no library runs."""
    if _is_pending.is_set() and current_thread() is main_thread():
        _interrupt()


def ignore_interrupts() -> None:
    """Ignore Ctrl-C in the last milliseconds of a process, when its exit status is decided.

    Python restores the default action of SIGINT before it exits. The signal would then end a
    process that has written all of its files.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def are_interrupts_unblocked() -> bool:
    """Return whether this process receives Ctrl-C: a KeyboardInterrupt may be from the user."""
    return signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, ())


def is_user_interrupt(error: BaseException) -> bool:
    """Return whether an exception may be caused by the user's Ctrl-C."""
    return isinstance(error, KeyboardInterrupt) and are_interrupts_unblocked()


@contextmanager
def block_interrupts() -> Iterator[None]:
    """Block Ctrl-C during the block; processes that it starts ignore Ctrl-C all the time.

    This process is interrupted after the block. The system may deliver the signal to another
    thread, for which Python raises in the main thread: the main thread delays it, too.
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
    while frame is not None:
        package = str(frame.f_globals.get("__name__")).partition(".")[0]
        if package in UNSAFE_PACKAGES or package.startswith("namedtuple_"):
            return True
        frame = frame.f_back
    return False


def _try_again(number: int) -> None:
    """Send the signal to the main thread again after a delay, unless it was raised by then."""
    _is_pending.set()
    timer = Timer(RETRY_DELAY, _send, (get_ident(), number))
    timer.daemon = True
    timer.start()


def _send(thread: int, number: int) -> None:
    if _is_pending.is_set():
        signal.pthread_kill(thread, number)
