"""Disk cache of the convex polygons of meshes: finding those of the tank takes half a second.

Polygons are found by the hash of the triangles and of what makes polygons of them: the sources
and the versions of numpy and SciPy.
"""

from __future__ import annotations

import hashlib
import io

import numpy as np

from ...base.files import disk_cache
from ...base.files.code_digest import code_digest
from ...base.geometry import Array
from ...base.numerics import linear
from . import convex_faces


def cached_faces(triangles: Array) -> list[Array]:
    """`convex_faces.convex_faces` of the triangles (n, 3, 3) [m], from the cache if possible."""
    sources = [str(module.__file__) for module in (convex_faces, linear)]
    digest = hashlib.sha256(code_digest(sources, ("numpy", "scipy")))
    digest.update(np.ascontiguousarray(triangles).data)
    file = disk_cache.cache_folder("polygons") / f"{digest.hexdigest()[:32]}.npz"
    data = disk_cache.read(file)
    if data is None:
        polygons = convex_faces.convex_faces(triangles)
        disk_cache.write(file, _packed(polygons))
        return polygons
    with np.load(io.BytesIO(data), allow_pickle=False) as kept:
        return np.split(kept["corners"], kept["ends"])[:-1]


def _packed(polygons: list[Array]) -> bytes:
    packed = io.BytesIO()
    corners = np.concatenate([*polygons, np.zeros((0, 3))])
    np.savez(packed, corners=corners, ends=np.cumsum([len(each) for each in polygons], dtype=int))
    return packed.getvalue()
