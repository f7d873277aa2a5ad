"""Errors of the operating system: their text, and what they are while something runs."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from ..errors import RunFailed


def system_error_text(error: OSError) -> str:
    """Return what happened, and to which file."""
    if error.filename is None:
        return error.strerror or str(error)
    return f"{error.strerror}: {error.filename}"


@contextmanager
def convert_to_run_failed() -> Iterator[None]:
    """Turn system errors in this block into `RunFailed`, because the inputs were checked before."""
    try:
        yield
    except BrokenPipeError:
        raise  # the reader of the output has closed it
    except OSError as error:
        raise RunFailed(system_error_text(error)) from error
