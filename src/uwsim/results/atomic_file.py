"""Atomic writing of files: a file is replaced as a whole, or not at all."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import name_file_in_errors

DRAFT = re.compile(r"\.(.+)\.[0-9]+\.part")
"""The name of a draft: the name of the file and the ID of the process that writes it."""


def write_text(path: Path, text: str) -> None:
    """Write a text file atomically: readers see the old or the new file, never a partial one."""
    with atomic_write(path) as draft, draft.open("w", encoding="utf-8", newline="\n") as stream:
        stream.write(text)
        stream.flush()
        os.fsync(stream.fileno())


@contextmanager
def atomic_write(path: Path) -> Iterator[Path]:
    """Yield the path of a draft, which replaces the file when the block ends without error.

    Two processes may write the same file at the same time: each writes its own draft, and the draft
    that is finished last remains.
    """
    draft = draft_of(path)
    try:
        with name_file_in_errors(path, draft):
            yield draft
            draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)


def draft_of(path: Path) -> Path:
    """Return the path of this process's draft of a file."""
    return path.with_name(f".{path.name}.{os.getpid()}.part")


def name_of_draft(name: str) -> str | None:
    """Return the name of the file that a draft replaces; None if this is not a draft's name."""
    match = DRAFT.fullmatch(name)
    return None if match is None else match[1]
