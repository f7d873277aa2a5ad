"""Disk cache of the convex polygons of meshes, which take up to seconds to compute.

The key is the hash of the triangles, of the sources that compute the polygons, and of the versions
of numpy and SciPy.
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
    """Return `convex_faces.convex_faces` of triangles (n, 3, 3) [m], from the cache if possible."""
    sources = [str(module.__file__) for module in (convex_faces, linear)]
    digest = hashlib.sha256(code_digest(sources, ("numpy", "scipy")))
    digest.update(np.ascontiguousarray(triangles).data)
    file = disk_cache.cache_folder("polygons") / f"{digest.hexdigest()[:32]}.npz"
    data = disk_cache.read(file)
    if data is None:
        polygons = convex_faces.convex_faces(triangles)
        disk_cache.write(file, _to_bytes(polygons))
        return polygons
    with np.load(io.BytesIO(data), allow_pickle=False) as archive:
        return np.split(archive["corners"], archive["ends"])[:-1]


def _to_bytes(polygons: list[Array]) -> bytes:
    buffer = io.BytesIO()
    corners = np.concatenate([*polygons, np.zeros((0, 3))])
    ends = np.cumsum([len(polygon) for polygon in polygons], dtype=int)
    np.savez(buffer, corners=corners, ends=ends)
    return buffer.getvalue()
