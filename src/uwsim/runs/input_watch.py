"""The check that the input files of a run have not changed since its start.

Models, data and algorithms are read again by every worker, hours after their hashes were taken. So
a row is stored only while each file has the hash that is in the result.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from ..base.files.input_files import InputFile, compute_hash
from ..errors import RunFailed
from ..results.inputs import MAX_LINES, short_hash

_Stamp = tuple[tuple[int, int, int], ...]
"""The last change [ns], size [bytes] and inode number of a file, or of each file of a folder."""


def unique_files(files: Iterable[InputFile]) -> tuple[InputFile, ...]:
    """Return the files with a known path, each once, with absolute paths for workers."""
    files_by_path = {file.path.absolute(): file for file in files if file.path.name}
    return tuple(replace(file, path=path) for path, file in files_by_path.items())


class InputWatch:
    """A repeated check of files for changes; a file is hashed again only if its stamp has changed.

    Args:
        files: the files with their first hashes (`unique_files`).
    """

    def __init__(self, files: Iterable[InputFile]) -> None:
        self._files = tuple(files)
        self._valid_stamps: dict[Path, _Stamp] = {}  # stamps of files with their first hash

    def check(self) -> None:
        """Raise RunFailed with the changed files, if there are any."""
        messages = [change for file in self._files if (change := self._find_change(file))]
        if messages:
            rest = [f"{len(messages) - MAX_LINES} more"] if len(messages) > MAX_LINES else []
            raise RunFailed(
                f"During the run {'; '.join([*messages[:MAX_LINES], *rest])}. "
                "Finished rows are kept; restore the files and continue with --resume."
            )

    def _find_change(self, file: InputFile) -> str:
        try:
            stamp = _stamp(file.path)
            if self._valid_stamps.get(file.path) == stamp:
                return ""
            digest = compute_hash(file.path)
        except OSError as error:
            return f"{file.path} became unreadable ({error.strerror})"
        if digest != file.sha256:
            old_digest = short_hash(file.sha256)
            return f"{file.path} was changed ({old_digest} then, {short_hash(digest)} now)"
        self._valid_stamps[file.path] = stamp
        return ""


def _stamp(path: Path) -> _Stamp:
    """Return the stamp of a file or folder."""
    statuses = [
        entry.stat() for entry in ([path, *sorted(path.rglob("*"))] if path.is_dir() else [path])
    ]
    return tuple((entry.st_ctime_ns, entry.st_size, entry.st_ino) for entry in statuses)
