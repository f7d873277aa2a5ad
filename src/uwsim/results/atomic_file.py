"""Atomic writing of files."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import name_file_in_errors

DRAFT = re.compile(r"\.(.+)\.[0-9]+\.part")
"""The name of a draft: the file's name and the process that writes it."""


def write_text(path: Path, text: str) -> None:
    """Write a text file atomically: readers see the old or the new one, never a part."""
    with atomic_write(path) as draft, draft.open("w", encoding="utf-8", newline="\n") as stream:
        stream.write(text)
        stream.flush()
        os.fsync(stream.fileno())


@contextmanager
def atomic_write(path: Path) -> Iterator[Path]:
    """Yield a temporary path; it replaces the file when the block ends without error.

    Two processes may write the same file at once: each has a draft, and the last one replaces it.
    """
    draft = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with name_file_in_errors(path, draft):
            yield draft
            draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)


def name_of_draft(name: str) -> str | None:
    """Return the name of the file whose draft this is; None where the name is no draft's."""
    match = DRAFT.fullmatch(name)
    return None if match is None else match[1]
