"""How the command line says what went wrong: one clean line a fault, and an exit status."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

import typer

from .. import interrupts
from ..errors import RUN_ERRORS, Fault, FileError, RunFailed, SeveralErrors, UwsimError

WRONG_INPUT = 2
RUN_FAILED = 3
INTERRUPTED = interrupts.STATUS
LONGEST_QUOTE = 300
"""Letters of what a file said that are shown: a word, or what stands between quotes."""
LONGEST_LINE = 4000
"""Letters of a line, whatever is in it."""


def warn(message: str) -> None:
    """Tell the user what the command goes on in spite of."""
    typer.echo(printable(f"uwsim: warning: {message}"), err=True)


def say_notices(notices: Iterable[Fault]) -> None:
    """Tell the user what of a file seems not to be meant; the command goes on."""
    for notice in notices:
        typer.echo(printable(f"{notice} (notice)"), err=True)


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
        context = getattr(error, "ctx", None)
        if message.startswith("Missing") and context is not None:
            message = f"{message.rstrip('.')}; {context.command_path} -h shows what it takes."
    elif isinstance(error, UwsimError):
        message = str(error)
    elif isinstance(error, OSError) and error.filename is not None:
        message = _of_system(error)
    else:
        message = f"{type(error).__name__}: {error} (--traceback shows where)"
    return printable(f"uwsim: {message.strip()}") if message.strip() else ""


@contextmanager
def running() -> Iterator[None]:
    """Make what the system refuses in this block a failed run: what was asked for was checked."""
    try:
        yield
    except BrokenPipeError:
        raise  # whoever read our output has left
    except OSError as error:
        raise RunFailed(_of_system(error)) from error


def printable(text: str) -> str:
    """Show what a hostile file may hold: no control characters, and not more than can be read."""
    return "\n".join(_legible(line) for line in text.split("\n"))


def _of_system(error: OSError) -> str:
    if error.filename is None:
        return error.strerror or str(error)
    return f"{error.strerror}: {error.filename}"


def _legible(line: str) -> str:
    shown = LONG.sub(_shortened, line[: 10 * LONGEST_LINE])
    if len(shown) > LONGEST_LINE or len(line) > 10 * LONGEST_LINE:
        shown = f"{shown[:LONGEST_LINE]}…"
    return legible(shown)


def legible(text: str) -> str:
    """Show control characters but ends of lines instead of letting a terminal obey them."""
    return "".join(
        letter if letter.isprintable() or letter == "\n" else f"\\x{ord(letter):02x}"
        for letter in text
    )


LONG = re.compile(rf"""(?<!\w)'[^']*'(?!\w)|(?<!\w)"[^"]*"(?!\w)|\S{{{LONGEST_QUOTE + 1},}}""")
"""What a file said: what stands between quotes, and what is long and has no gap."""


def _shortened(found: re.Match[str]) -> str:
    text = found[0]
    if len(text) <= LONGEST_QUOTE:
        return text
    end = text[-1] if text[0] in "'\"" else ""
    left_out = len(text) - LONGEST_QUOTE - len(end)
    return f"{text[:LONGEST_QUOTE]}… ({left_out} more letters){end}"
