"""Hashes of the code that computes the contents of a cache on disk."""

from __future__ import annotations

import hashlib
import platform
from collections.abc import Iterable
from functools import cache
from importlib.metadata import version
from pathlib import Path


def code_digest(sources: Iterable[str | Path], packages: Iterable[str]) -> bytes:
    """Hash source files, versions of installed packages, and the machine type, (32 bytes).

    Args:
        sources: Python files, or folders with all Python files below them.
        packages: names of installed distributions.
    """
    return _digest(tuple(map(Path, sources)), tuple(packages))


@cache
def _digest(sources: tuple[Path, ...], packages: tuple[str, ...]) -> bytes:
    digest = hashlib.sha256()
    for source in sources:
        for file in sorted(source.rglob("*.py")) if source.is_dir() else [source]:
            digest.update(hashlib.sha256(file.read_bytes()).digest())
    digest.update(" ".join(map(version, packages)).encode())
    digest.update(platform.machine().encode())
    return digest.digest()
