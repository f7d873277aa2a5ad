"""Files of the caches on disk, which heal: each begins with the hash of what is in it.

One that does not match is taken away, so that what it held is made anew. A cache is a convenience,
never a need: what cannot be read is as if it were not there, what cannot be written is not kept.
The files of a kind take `MAX_BYTES` at most: those that nobody has read for longest are removed.
"""

from __future__ import annotations

import hashlib
import logging
import os
from contextlib import suppress
from pathlib import Path
from tempfile import NamedTemporaryFile

DIGEST_LENGTH = 32
"""Length of a hash, SHA-256 [bytes]."""
DRAFT_SUFFIX = ".part"
"""How the name of a file ends that is still being written, and begins with its process."""

MAX_BYTES = 512 * 2**20
"""Size of all files of a kind [bytes]."""


def cache_folder(kind: str) -> Path:
    """Where files of a kind are kept: in the user's cache (XDG Base Directory Specification)."""
    home = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    return Path(home) / "uwsim" / kind


def read(file: Path) -> bytes | None:
    """What is kept in a file; None where there is none, or none that is as it was written.

    A damaged file is taken away, which is logged: the next reader finds a new one.
    """
    try:
        data = file.read_bytes()
    except OSError:
        return None
    if data[:DIGEST_LENGTH] == _digest(file, data[DIGEST_LENGTH:]):
        with suppress(OSError):
            os.utime(file)  # read now: it is removed last
        return data[DIGEST_LENGTH:]
    logging.getLogger(__name__).warning(
        "uwsim: warning: %s in the cache is damaged; what it held is made anew.", file
    )
    with suppress(OSError):
        file.unlink()
    return None


def write(file: Path, data: bytes) -> None:
    """Keep ``data`` in a file, whole or not at all; where that cannot be, nothing is kept.

    What a process was writing there when it was killed is taken away.
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
    """Remove drafts of processes that are gone; on another machine one lives, and loses no more."""
    for draft in folder.glob(f"*-*{DRAFT_SUFFIX}"):
        number = draft.name.partition("-")[0]
        try:
            os.kill(int(number), 0)
        except (ProcessLookupError, OverflowError):
            draft.unlink(missing_ok=True)
        except (OSError, ValueError):
            pass  # it lives, and is another user's; or no draft of ours


def _remove_oldest(limit: int, new_file: Path) -> None:
    """Remove the files of a kind that were not read for longest until all are within a limit."""
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
    """The hash of a file's name and what is in it: neither may change alone."""
    return hashlib.sha256(file.name.encode() + b"\0" + data).digest()
