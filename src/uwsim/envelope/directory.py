"""The output directory of an envelope: its file names, its lock, and the checks before writing."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import BadSetting
from ..results.directory import check_output, check_resume, discard_drafts, empty, lock_directory

FILE_NAMES = re.compile(
    r"""(?x)
    envelope\.(json|png) | provenance\.json | units/\d+\.(jsonl|motion|inputs|part)
  | pictures/\d+-[^/]+\.png(\.part)?
    """
)
"""The pattern of the names of files in the directory of an envelope."""
FOLDERS = ("units", "pictures")


def check_directory(directory: Path, *, resume: bool, overwrite: bool) -> None:
    """Raise BadSetting if the options do not allow writing into the directory."""
    if resume and overwrite:
        raise BadSetting("--resume and --overwrite exclude each other.")
    if resume:
        check_resume(directory, pattern=FILE_NAMES, folders=FOLDERS)
    else:
        hint = "Use --resume to reuse its runs, or --overwrite to start anew."
        check_output(directory, overwrite=overwrite, pattern=FILE_NAMES, folders=FOLDERS, hint=hint)


@contextmanager
def prepare_directory(directory: Path, *, resume: bool, overwrite: bool) -> Iterator[None]:
    """Lock the directory, and remove an earlier envelope unless its runs are reused."""
    with lock_directory(directory):
        check_directory(directory, resume=resume, overwrite=overwrite)
        if not resume:
            empty(directory)
        discard_drafts(directory, FILE_NAMES, FOLDERS)
        yield
