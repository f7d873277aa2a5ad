"""Files of the caches on disk, each of which begins with the hash of its content.

A file whose hash does not match is removed, so that its content is computed again. Caches are
optional: a file that cannot be read is treated as missing, and a failure to write is ignored. Each
kind of cached content has a folder, whose files take `MAX_BYTES` at most: the least recently read
files are removed.
"""

from __future__ import annotations

import hashlib
import logging
import os
from contextlib import suppress
from pathlib import Path
from tempfile import NamedTemporaryFile

DIGEST_LENGTH = 32
"""The length of a hash, SHA-256 [bytes]."""
DRAFT_SUFFIX = ".part"
"""The suffix of a file that is being written; its name begins with the process identifier."""

MAX_BYTES = 512 * 2**20
"""The greatest size of all files of one kind [bytes]."""


def cache_folder(kind: str) -> Path:
    """Return the folder of a kind of content in the user's cache (XDG Base Directory)."""
    home = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    return Path(home) / "uwsim" / kind


def read(file: Path) -> bytes | None:
    """Return the content of a file; None if it is missing or damaged.

    A damaged file is removed, which is logged.
    """
    try:
        data = file.read_bytes()
    except OSError:
        return None
    if data[:DIGEST_LENGTH] == _digest(file, data[DIGEST_LENGTH:]):
        with suppress(OSError):
            os.utime(file)  # records the time of the last read
        return data[DIGEST_LENGTH:]
    logging.getLogger(__name__).warning(
        "uwsim: warning: %s in the cache is damaged; its content is computed again.", file
    )
    with suppress(OSError):
        file.unlink()
    return None


def write(file: Path, data: bytes) -> None:
    """Write ``data`` to a file, completely or not at all; a failure is ignored.

    Drafts of killed processes are removed.
    """
    with suppress(OSError):
        file.parent.mkdir(parents=True, exist_ok=True)
        _discard_drafts(file.parent)
        prefix = f"{os.getpid()}-"
        with NamedTemporaryFile(
            dir=file.parent, prefix=prefix, suffix=DRAFT_SUFFIX, delete=False
        ) as draft:
            try:
                draft.write(_digest(file, data) + data)
                draft.flush()
                os.replace(draft.name, file)
            except BaseException:
                os.unlink(draft.name)
                raise
        _remove_oldest(MAX_BYTES, file)


def _discard_drafts(folder: Path) -> None:
    """Remove the drafts of ended processes; a process on another machine loses only its draft."""
    for draft in folder.glob(f"*-*{DRAFT_SUFFIX}"):
        number = draft.name.partition("-")[0]
        try:
            os.kill(int(number), 0)
        except (ProcessLookupError, OverflowError):
            draft.unlink(missing_ok=True)
        except (OSError, ValueError):
            pass  # the process of another user, or not a draft of uwsim


def _remove_oldest(limit: int, new_file: Path) -> None:
    """Remove the least recently read files of a kind until their size is within a limit."""
    root = cache_folder("")
    if not new_file.is_relative_to(root):
        return
    kind_folder = root / new_file.relative_to(root).parts[0]
    file_stats = {file: file.stat() for file in kind_folder.rglob("*") if file.is_file()}
    size = sum(file_stat.st_size for file_stat in file_stats.values())
    for file in sorted(file_stats, key=lambda file: file_stats[file].st_mtime_ns):
        if size <= limit:
            break
        size -= file_stats[file].st_size
        file.unlink(missing_ok=True)


def _digest(file: Path, data: bytes) -> bytes:
    """Return the hash of a file's name and content, so that a renamed file counts as damaged."""
    return hashlib.sha256(file.name.encode() + b"\0" + data).digest()
