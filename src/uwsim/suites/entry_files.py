"""The files of an entry as they come from its author: plain files only, hashed together.

A folder of a stranger may contain links, pipes and devices, which must not be opened, and names
that change how a terminal or a page is read.
"""

from __future__ import annotations

import hashlib
import os
import stat
from collections.abc import Iterator
from pathlib import Path

from ..base.files.input_files import compute_hash
from ..errors import ResultError

VERDICT_FILE = "verification.json"
"""The name of the file with the verdict, which is no part of the entry."""
OTHER_NAMES = (VERDICT_FILE, "timing")
"""The names in an entry that its hash leaves out: the verdict, and the time of each process."""
MAX_FILES = 200_000
"""The greatest number of files in an entry."""
MAX_FILE_BYTES = 512 * 2**20
"""The greatest size of a file in an entry [bytes]."""


def entry_files(directory: Path) -> dict[str, Path]:
    """Return all files of an entry by their names in it, ``station-v1/result.json``, sorted.

    Raises:
        ResultError: a file is no plain file, is too large, or has a name that cannot be printed.
    """
    if directory.is_symlink():
        raise ResultError(f"{directory}: is a link; expected a folder.")
    files: dict[str, Path] = {}
    for path in _walk(directory):
        name = path.relative_to(directory).as_posix()
        files[name] = path
        if len(files) > MAX_FILES:
            raise ResultError(f"{directory}: has more than {MAX_FILES} files.")
    return dict(sorted(files.items()))


def _walk(folder: Path) -> Iterator[Path]:
    with os.scandir(folder) as items:
        for item in items:
            if not item.name.isprintable():
                raise ResultError(f"{item.name!r:.60}: is a name that cannot be printed.")
            status = item.stat(follow_symlinks=False)
            if stat.S_ISDIR(status.st_mode):
                if item.name == VERDICT_FILE:
                    raise ResultError(f"{VERDICT_FILE}: is a folder; expected a file.")
                yield from _walk(Path(item.path))
                continue
            _check_plain_file(Path(item.path), status)
            if status.st_size > MAX_FILE_BYTES:
                raise ResultError(f"{item.path}: is larger than {MAX_FILE_BYTES >> 20} MiB.")
            yield Path(item.path)


def entry_hash(directory: Path) -> str:
    """Return the hash of all files of an entry with their names, without the verdict and timing.

    Raises:
        ResultError: as `entry_files` does.
    """
    digest = hashlib.sha256()
    for name, path in entry_files(directory).items():
        if name.partition("/")[0] not in OTHER_NAMES:
            digest.update(f"{name}\0{compute_hash(path)}\n".encode())
    return f"sha256:{digest.hexdigest()}"


def read_plain_file(path: Path, at_most: int) -> bytes:
    """Return the bytes of a plain file.

    Args:
        path: the file.
        at_most: the greatest size [bytes].

    Raises:
        ResultError: the file does not exist, is no plain file, or is larger.
    """
    try:
        status = path.lstat()
    except OSError:
        raise ResultError(
            f"{path}: there is no such file; expected the --out of uwsim suite run."
        ) from None
    _check_plain_file(path, status)
    if status.st_size > at_most:
        raise ResultError(f"{path}: longer than {at_most} bytes.")
    with path.open("rb") as stream:
        return stream.read(at_most)


def _check_plain_file(path: Path, status: os.stat_result) -> None:
    """Raise ResultError for a link, a pipe or a device, by the status of the path itself."""
    if not stat.S_ISREG(status.st_mode):
        raise ResultError(f"{path}: is no plain file (a link, a pipe or a device).")
