"""Conversion of exceptions of third-party programs and of the system to texts and `RunFailed`."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import RunFailed, UwsimError
from .interrupts import is_user_interrupt


class RemoteError(Exception):
    """An exception of a third-party program that runs in a separate process.

    Its text is the result of `describe_exception` in that process.
    """


def describe_exception(error: BaseException, program: type) -> str:
    """Return the text of an exception of a third-party program, with its file and line.

    The file is that of the program, or of the last stack frame if no frame is in the program. It is
    named without its folders, so that results do not depend on its location. An error of uwsim
    without a frame in the program has no file, since its text is enough.

    Args:
        error: the exception.
        program: the class that the user's program defines.
    """
    if isinstance(error, RemoteError):
        return str(error)
    frames = traceback.extract_tb(error.__traceback__)[1:]  # without the frame of the caller
    program_file = getattr(sys.modules.get(program.__module__), "__file__", None)
    program_frames = [frame for frame in frames if frame.filename == program_file]
    if not program_frames and not isinstance(error, UwsimError):
        program_frames = frames
    place = ""
    if program_frames:
        place = f"{Path(program_frames[-1].filename).name}:{program_frames[-1].lineno}: "
    return f"{place}{type(error).__name__}: {_text(error)}"


def _text(error: BaseException) -> str:
    try:
        return str(error)
    except BaseException as text_error:  # even str() of a third-party error may raise
        if is_user_interrupt(text_error):
            raise
        return "its text cannot be shown"


def system_error_text(error: OSError) -> str:
    """Return the text of a system error, with the name of its file."""
    if error.filename is None:
        return error.strerror or str(error)
    return f"{error.strerror}: {error.filename}"


@contextmanager
def convert_to_run_failed() -> Iterator[None]:
    """Convert system errors (OSError) in this block to `RunFailed`; inputs are checked earlier."""
    try:
        yield
    except BrokenPipeError:
        raise  # the reader of the output closed it
    except OSError as error:
        raise RunFailed(system_error_text(error)) from error
