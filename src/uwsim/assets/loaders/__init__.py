"""Readers of mesh files: what trimesh reads, and what `osgconv` can turn into that."""

from __future__ import annotations

import hashlib
from functools import lru_cache
from pathlib import Path

from ...errors import AssetError
from ..mesh import Model
from .by_trimesh import READABLE, read_meshes
from .openscenegraph import BY_OSGCONV, converted, has_osgconv, without_osgconv

__all__ = ["BY_OSGCONV", "READABLE", "can_read", "read_model", "why_not_read"]

LARGEST_FILE = 512 * 1024 * 1024
"""Files above this size [bytes] are refused."""


def can_read(path: Path) -> bool:
    """Whether files of that type can be read here and now."""
    suffix = path.suffix.lower()
    return suffix in READABLE or (suffix in BY_OSGCONV and has_osgconv())


def why_not_read(path: Path) -> str:
    """Why files of that type cannot be read here and now; empty if they can."""
    suffix = path.suffix.lower()
    if can_read(path):
        return ""
    if suffix in BY_OSGCONV:
        return without_osgconv(path)
    known = ", ".join((*READABLE, *BY_OSGCONV))
    return f"{path}: files of type {suffix or 'none'} are not read; expected one of {known}"


def read_model(path: Path, *, name: str, max_triangles: int | None = None) -> Model:
    """The model in a file; read once as long as the file does not change.

    Args:
        path: The file.
        name: What it was asked for by.
        max_triangles: Simplified to about this many when it has more.

    Raises:
        AssetError: It cannot be read; says why, or what to install.
    """
    try:
        facts = path.stat()
    except OSError as error:
        raise AssetError(f"{path}: cannot be read ({error.strerror}).") from error
    if facts.st_size > LARGEST_FILE:
        raise AssetError(
            f"{path}: is {facts.st_size / 2**20:.0f} MiB; at most {LARGEST_FILE >> 20} are read."
        )
    return _read(path, name, max_triangles, (facts.st_mtime_ns, facts.st_size))


@lru_cache(maxsize=256)
def _read(path: Path, name: str, max_triangles: int | None, _: tuple[int, int]) -> Model:
    suffix = path.suffix.lower()
    if suffix in READABLE:
        meshes = read_meshes(path, max_triangles=max_triangles)
    elif suffix in BY_OSGCONV:
        with converted(path) as obj:
            meshes = read_meshes(obj, max_triangles=max_triangles, beside=path.parent)
    else:
        raise AssetError(why_not_read(path))
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    return Model(name=name, meshes=meshes, source="file", sha256=digest)
