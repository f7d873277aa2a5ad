"""Disk cache of meshes that were read from files: to import trimesh takes a third of a second.

The cache contains the meshes of files that name no other file and have no image. The key is a hash
of the bytes of the file, and of the sources and versions of the readers.
"""

from __future__ import annotations

import hashlib
import io
import platform
from collections.abc import Sequence
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from ...base.files import disk_cache
from .. import mesh as mesh_module
from ..mesh import Mesh
from ..procedural import shapes

MAX_TRIANGLES = 500_000
"""The greatest number of triangles of the meshes in the cache: some 50 MB."""
READERS = ("numpy", "trimesh", "scipy", "pycollada")
_ARRAYS = ("vertices", "normals", "uvs", "triangles", "colour", "two_sided")


def cache_file(data: bytes, suffix: str) -> Path:
    """Return the path in the cache of the meshes of a file with these bytes."""
    digest = hashlib.sha256(f"{_key()} {suffix} ".encode() + data).hexdigest()
    return disk_cache.cache_folder("meshes") / f"{digest[:32]}.npz"


def read(file: Path) -> tuple[Mesh, ...] | None:
    """Return the stored meshes; None if there are none."""
    data = disk_cache.read(file)
    if data is None:
        return None
    with np.load(io.BytesIO(data), allow_pickle=False) as archive:
        arrays = dict(archive)
    n = len(arrays) // len(_ARRAYS)
    return tuple(_mesh(*(arrays[f"{i}/{name}"] for name in _ARRAYS)) for i in range(n))


def store(file: Path, meshes: Sequence[Mesh]) -> None:
    """Write meshes, if they have only a colour and are not too many."""
    if any(mesh.texture is not None or mesh.material is not None for mesh in meshes):
        return
    if sum(len(mesh.triangles) for mesh in meshes) > MAX_TRIANGLES:
        return
    buffer = io.BytesIO()
    arrays = {
        f"{i}/{name}": np.asarray(getattr(mesh, name))
        for i, mesh in enumerate(meshes)
        for name in _ARRAYS
    }
    np.savez(buffer, **arrays)  # type: ignore[arg-type]  # none is called allow_pickle
    disk_cache.write(file, buffer.getvalue())


def _mesh(
    vertices: Any, normals: Any, uvs: Any, triangles: Any, colour: Any, two_sided: Any
) -> Mesh:
    red, green, blue = colour.tolist()
    return Mesh(
        vertices=vertices,
        normals=normals,
        uvs=uvs,
        triangles=triangles,
        colour=(red, green, blue),
        two_sided=bool(two_sided),
    )


@cache
def _key() -> str:
    """Return the hash of everything that meshes depend on besides the file."""
    digest = hashlib.sha256()
    sources = [*Path(__file__).parent.glob("*.py"), shapes.__file__, mesh_module.__file__]
    for source in sorted(map(str, sources)):
        digest.update(Path(source).read_bytes())
    versions = " ".join(map(version, READERS))
    return digest.hexdigest() + f" {versions} {platform.machine()}"
