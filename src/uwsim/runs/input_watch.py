"""Check that the input files of a run have not changed since its start.

Models, data and algorithms are read again by every worker, hours after their hashes were taken. So
a row is kept only while each file has the hash that stands in the result.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from ..base.files.input_files import InputFile, compute_hash
from ..errors import RunFailed
from ..results.inputs import MAX_LINES, short_hash

_Stamp = tuple[tuple[int, int, int], ...]


def watchable(read: Iterable[InputFile]) -> tuple[InputFile, ...]:
    """Return the files whose place is known, each once, wherever a worker may be."""
    known = {file.path.absolute(): file for file in read if file.path.name}
    return tuple(replace(file, path=path) for path, file in known.items())


class Watch:
    """Checks repeatedly whether files have changed; hashes one only if it was written to.

    Args:
        files: as they were (`watchable`).
    """

    def __init__(self, files: Iterable[InputFile]) -> None:
        self._files = tuple(files)
        self._sound: dict[Path, _Stamp] = {}  # when it was last seen to be as it was

    def check(self) -> None:
        """Do nothing, or raise RunFailed, which names what was changed."""
        messages = [why for file in self._files if (why := self._why_not(file))]
        if messages:
            more = [f"{len(messages) - MAX_LINES} more"] if len(messages) > MAX_LINES else []
            raise RunFailed(
                f"While the run was going on {'; '.join([*messages[:MAX_LINES], *more])}. "
                "Finished rows are kept; restore the files and continue with --resume."
            )

    def _why_not(self, file: InputFile) -> str:
        try:
            stamp = _stamp(file.path)
            if self._sound.get(file.path) == stamp:
                return ""
            now = compute_hash(file.path)
        except OSError as error:
            return f"{file.path} became unreadable ({error.strerror})"
        if now != file.sha256:
            return (
                f"{file.path} was changed ({short_hash(file.sha256)} then, {short_hash(now)} now)"
            )
        self._sound[file.path] = stamp
        return ""


def _stamp(path: Path) -> _Stamp:
    """When a file was changed last, its size and its number; of a folder those of its files."""
    facts = [
        each.stat() for each in ([path, *sorted(path.rglob("*"))] if path.is_dir() else [path])
    ]
    return tuple((each.st_ctime_ns, each.st_size, each.st_ino) for each in facts)
