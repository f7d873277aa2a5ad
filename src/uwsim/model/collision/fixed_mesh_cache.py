"""Disk cache of the collision surfaces of large fixed meshes, each computed in up to seconds.

The key is the hash of the triangles, of the allowed error, and of the code that computes a surface.
"""

from __future__ import annotations

import hashlib
import io
from collections.abc import Sequence
from typing import Any

import numpy as np

from ...base.files import disk_cache
from ...base.files.code_digest import code_digest
from ...base.geometry import Array
from ...base.numerics import linear
from . import convex_faces, fixed_mesh, height_field, simplification
from .fixed_mesh import MAX_EXACT_FACES, FixedMesh
from .height_field import HeightField

SOURCES = (convex_faces, fixed_mesh, height_field, simplification, linear)
PACKAGES = ("numpy", "numba", "fast-simplification")
_ARRAYS = ("body_from_field", "origin", "spacing", "heights", "error")


def cached_mesh(parts: Sequence[Array], error: float | None) -> FixedMesh:
    """Return `fixed_mesh.fixed_mesh` of the same arguments, from the cache if possible."""
    if sum(map(len, parts)) <= MAX_EXACT_FACES and not error:
        return fixed_mesh.fixed_mesh(parts, error)
    digest = hashlib.sha256(code_digest([str(module.__file__) for module in SOURCES], PACKAGES))
    digest.update(f"{error!r} {[len(part) for part in parts]}".encode())
    for part in parts:
        digest.update(np.ascontiguousarray(part).data)
    file = disk_cache.cache_folder("fixed-meshes") / f"{digest.hexdigest()[:32]}.npz"
    data = disk_cache.read(file)
    if data is not None:
        return _from_bytes(data)
    mesh = fixed_mesh.fixed_mesh(parts, error)
    disk_cache.write(file, _to_bytes(mesh))
    return mesh


def _to_bytes(mesh: FixedMesh) -> bytes:
    arrays: dict[str, Any] = {"faces": mesh.faces, "error": np.array(mesh.error)}
    for i, field in enumerate(mesh.fields):
        arrays |= {f"{i}/{name}": np.array(getattr(field, name)) for name in _ARRAYS}
    buffer = io.BytesIO()
    np.savez(buffer, **arrays)
    return buffer.getvalue()


def _from_bytes(data: bytes) -> FixedMesh:
    with np.load(io.BytesIO(data), allow_pickle=False) as archive:
        arrays: dict[str, Any] = dict(archive)
    fields: list[HeightField] = []
    while f"{len(fields)}/heights" in arrays:
        values = {name: arrays[f"{len(fields)}/{name}"] for name in _ARRAYS}
        fields.append(HeightField(**values | {"error": float(values["error"])}))
    return FixedMesh(faces=arrays["faces"], fields=tuple(fields), error=float(arrays["error"]))
