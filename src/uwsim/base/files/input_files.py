"""Reading of input files: the files to which scenes, benchmarks and models refer.

Every byte of an input file is read by `read_bytes`. In a block of `record_inputs`, the hash of each
file is recorded:

.. code-block:: python

    with record_inputs() as files:
        simulation = Simulation(scene)
    for file in files: print(file.name, file.sha256)
"""

from __future__ import annotations

import hashlib
import stat
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath, PureWindowsPath

from ...errors import AssetError, Diagnostic, FileError

MAX_BYTES = 512 * 2**20
"""The greatest size of a file [bytes], unless the reader has a smaller limit."""
CHUNK_SIZE = 1 << 20
"""The size of the parts in which a file is hashed [bytes]."""


@dataclass(frozen=True, order=True)
class InputFile:
    """A file as it was when it was read."""

    name: str
    """The name by which another file refers to it, without folders of this machine."""
    sha256: str
    """``sha256:`` and the digest of its bytes, in hexadecimal."""
    path: Path = field(default=Path(), compare=False)
    """The present path."""


_records: ContextVar[tuple[list[InputFile], ...]] = ContextVar("records", default=())


@contextmanager
def record_inputs() -> Iterator[list[InputFile]]:
    """Yield the list of the input files that are read in this block, each once; may be nested."""
    files: list[InputFile] = []
    token = _records.set((*_records.get(), files))
    try:
        yield files
    finally:
        _records.reset(token)


def record(files: Iterable[InputFile]) -> None:
    """Record that files were read, also for an object from a cache that was made from them."""
    for file in files:
        for recorded_files in _records.get():
            if file not in recorded_files:
                recorded_files.append(file)


def read_bytes(path: Path, *, name: str | Path = "", at_most: int = MAX_BYTES) -> bytes:
    """Read a whole input file, and record its hash.

    Args:
        path: the path of the file.
        name: the name by which another file refers to it; by default the file's own name.
        at_most: the greatest size [bytes].

    Raises:
        OSError: the file cannot be read.
        AssetError: the file is larger, or is not a regular file (a folder, a pipe, a device).
    """
    file_stat = path.stat()
    if not stat.S_ISREG(file_stat.st_mode):
        raise AssetError(f"{path}: is not a regular file.", name=str(name))
    if file_stat.st_size > at_most:
        raise AssetError(f"{path}: is larger than {at_most / 2**20:.3g} MiB.", name=str(name))
    with path.open("rb") as stream:
        data = stream.read(file_stat.st_size + 1)
    if len(data) != file_stat.st_size:
        raise AssetError(f"{path}: changed while it was read.", name=str(name))
    digest = f"sha256:{hashlib.sha256(data).hexdigest()}"
    record([InputFile(portable_name(name or path.name), digest, path)])
    return data


def read_document(path: Path, *, at_most: int = MAX_BYTES) -> bytes:
    """Read a whole input file whose errors are diagnostics, and record its hash.

    Args:
        path: the path of the file.
        at_most: the greatest size [bytes].

    Raises:
        FileError: the file cannot be read, is larger, or is not a regular file.
    """
    try:
        return read_bytes(path, at_most=at_most)
    except AssetError as error:
        message = str(error).removeprefix(f"{path}: ").removesuffix(".")
    except OSError as error:
        message = f"cannot be read: {error.strerror or error}"
    raise FileError([Diagnostic(file=str(path), line=None, message=message)])


def file_stamps(files: Iterable[InputFile]) -> tuple[tuple[int, int], ...]:
    """Return the modification time [ns] and size [byte] of each file; (0, 0) for one that is gone.

    A cache in memory compares them to see whether a file has changed.
    """
    statuses = [file.path.stat() if file.path.exists() else None for file in files]
    return tuple(
        (0, 0) if status is None else (status.st_mtime_ns, status.st_size) for status in statuses
    )


def is_inside(path: Path, folders: Iterable[Path]) -> bool:
    """Return whether a file is in or below one of the folders; links are followed."""
    resolved_path = path.resolve()
    return any(resolved_path.is_relative_to(folder.resolve()) for folder in folders)


def compute_hash(path: Path) -> str:
    """Return the hash of a file, or of the names and bytes of the files of a folder."""
    digest = hashlib.sha256()
    for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
        if path.is_dir():
            digest.update(f"{file.relative_to(path).as_posix()}\0".encode())
        if file.is_file():
            with file.open("rb") as stream:
                while chunk := stream.read(CHUNK_SIZE):
                    digest.update(chunk)
    return f"sha256:{digest.hexdigest()}"


def portable_name(name: str | Path) -> str:
    """Return the name of a file in a result: only the last part of an absolute path."""
    text = str(name).strip().replace("\\", "/")
    is_local = text.startswith(("/", "~")) or bool(PureWindowsPath(text).drive)
    return PurePosixPath(text).name if is_local else str(PurePosixPath(text))


def hashes_by_name(files: Iterable[InputFile]) -> dict[str, str]:
    """Return the hashes of files by their names, sorted; a second file is ``NAME (2)``."""
    hashes: dict[str, str] = {}
    for file in sorted(set(files)):
        name, n = file.name, 1
        while name in hashes:
            n += 1
            name = f"{file.name} ({n})"
        hashes[name] = file.sha256
    return dict(sorted(hashes.items()))
