"""The messages and exit statuses of the command line for errors."""

from __future__ import annotations

import typer

from ..base import interrupts
from ..base.exceptions import system_error_text
from ..base.terminal import clean_text
from ..errors import RUN_ERRORS, FileError, SeveralErrors, UwsimError

INVALID_INPUT = 2
RUN_FAILED = 3
INTERRUPT_STATUS = interrupts.INTERRUPTED_STATUS


def exit_status(error: BaseException) -> int:
    """Return the exit status of ``error``."""
    if isinstance(error, KeyboardInterrupt):
        return INTERRUPT_STATUS
    if isinstance(error, RUN_ERRORS):
        return RUN_FAILED
    if isinstance(error, UwsimError | typer.TyperException):
        return INVALID_INPUT
    if isinstance(error, FileNotFoundError | FileExistsError | PermissionError):
        return INVALID_INPUT
    if isinstance(error, IsADirectoryError | NotADirectoryError):
        return INVALID_INPUT
    return RUN_FAILED


def format_error(error: BaseException) -> str:
    """Return the message of an error: one line, or one line for each error of a file."""
    if isinstance(error, KeyboardInterrupt | typer.Abort):
        return "uwsim: interrupted; finished results are kept."
    if isinstance(error, SeveralErrors):
        return "\n".join(format_error(part) for part in error.errors)
    if isinstance(error, FileError):
        return clean_text(str(error))
    if isinstance(error, typer.TyperException):
        message = error.format_message()
        context = getattr(error, "ctx", None)
        if message.startswith("Missing") and context is not None:
            message = f"{message.rstrip('.')}; {context.command_path} -h shows its options."
    elif isinstance(error, UwsimError):
        message = str(error)
    elif isinstance(error, OSError) and error.filename is not None:
        message = system_error_text(error)
    else:
        message = f"{type(error).__name__}: {error} (--traceback shows where)"
    return clean_text(f"uwsim: {message.strip()}") if message.strip() else ""
