"""How the command line says what went wrong: one clean line a fault, and an exit status."""

from __future__ import annotations

import typer

from ..errors import (
    FileError,
    NeverStarted,
    ReplayDiffers,
    RunFailed,
    SeveralErrors,
    UwsimError,
)

WRONG_INPUT = 2
RUN_FAILED = 3
INTERRUPTED = 130

RUN_ERRORS = (NeverStarted, ReplayDiffers, RunFailed)
"""What can only be found by running; every other `UwsimError` is wrong input."""


def exit_status(error: BaseException) -> int:
    """Return the exit status that ``error`` earns (DESIGN 6)."""
    if isinstance(error, KeyboardInterrupt):
        return INTERRUPTED
    if isinstance(error, RUN_ERRORS):
        return RUN_FAILED
    if isinstance(error, UwsimError | typer.TyperException):
        return WRONG_INPUT
    if isinstance(error, FileNotFoundError | FileExistsError | PermissionError):
        return WRONG_INPUT
    if isinstance(error, IsADirectoryError | NotADirectoryError):
        return WRONG_INPUT
    return RUN_FAILED


def one_line(error: BaseException) -> str:
    """Return what the reader is told; a wrong file has one line for each of its faults."""
    if isinstance(error, KeyboardInterrupt | typer.Abort):
        return "uwsim: interrupted; what was finished is kept."
    if isinstance(error, SeveralErrors):
        return "\n".join(one_line(each) for each in error.errors)
    if isinstance(error, FileError):
        return printable(str(error))
    if isinstance(error, typer.TyperException):
        message = error.format_message()
    elif isinstance(error, UwsimError):
        message = str(error)
    elif isinstance(error, OSError) and error.filename is not None:
        message = f"{error.strerror}: {error.filename}"
    else:
        message = f"{type(error).__name__}: {error} (--traceback shows where)"
    return printable(f"uwsim: {message.strip()}") if message.strip() else ""


def printable(text: str) -> str:
    """Show control characters, which a hostile file may hold, instead of obeying them."""
    return "".join(
        letter if letter.isprintable() or letter == "\n" else f"\\x{ord(letter):02x}"
        for letter in text
    )
