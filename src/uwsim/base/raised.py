"""What a third-party program raised, as one line."""

from __future__ import annotations

import sys
import traceback
from pathlib import Path

from .interrupts import is_user_interrupt


class RemoteError(Exception):
    """An exception of a third-party program in its own process, as `describe_exception` has it."""


def describe_exception(error: BaseException, program: type) -> str:
    """Describe what a third-party program raised, with the line of its file.

    The file is the program's, without its folders: results are the same wherever it lies. Where
    the error did not pass through it, the file is the one that raised.
    """
    if isinstance(error, RemoteError):
        return str(error)
    frames = traceback.extract_tb(error.__traceback__)[1:]  # the first is that of who called it
    own = getattr(sys.modules.get(program.__module__), "__file__", None)
    through = [frame for frame in frames if frame.filename == own] or frames
    place = f"{Path(through[-1].filename).name}:{through[-1].lineno}: " if through else ""
    return f"{place}{type(error).__name__}: {_text(error)}"


def _text(error: BaseException) -> str:
    try:
        return str(error)
    except BaseException as odd:  # even str() of a third-party error may raise
        if is_user_interrupt(odd):
            raise
        return "its text cannot be shown"
