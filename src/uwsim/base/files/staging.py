"""A directory that is written as a whole, or not at all."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ...errors import name_file_in_errors


@contextmanager
def stage_directory(directory: Path) -> Iterator[Path]:
    """Yield an empty directory, whose content moves into another when the block ends.

    After an error in the block, the draft is removed and the directory is as it was. System errors
    name the directory, not the draft.

    Args:
        directory: the directory that gets the content; it is made if it does not exist.
    """
    directory.parent.mkdir(parents=True, exist_ok=True)
    draft = directory.absolute()
    draft = draft.with_name(f".{draft.name}.{os.getpid()}.part")
    try:
        with name_file_in_errors(directory, draft):
            draft.mkdir()
            yield draft
            directory.mkdir(exist_ok=True)
            for path in sorted(draft.iterdir()):
                path.replace(directory / path.name)
    finally:
        shutil.rmtree(draft, ignore_errors=True)
