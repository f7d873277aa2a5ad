"""Meshes that keep the normals and tangents of their file, to which their maps refer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import determinant, inverse, product
from ..mesh import Mesh
from .gltf_rewriting import MARKED_NORMAL, MARKED_TANGENT
from .materials import Appearance

MIN_LENGTH = 1e-6
"""The least length of a normal or tangent that states a direction."""


@dataclass(frozen=True, eq=False)
class Directions:
    """The normals of the vertices of a part, and its tangents if the file has them."""

    normals: Array
    """The unit normals, (n, 3)."""
    tangents: Array | None
    """The unit tangents, and 1 or -1 where the texture is mirrored, (n, 4)."""

    def fits(self, vertices: Array) -> bool:
        """Return whether there is a normal for each vertex."""
        return len(self.normals) == len(vertices)


def transform_directions(attributes: Mapping[str, Any], transform: Array) -> Directions | None:
    """Return the normals and tangents of a mesh of trimesh at a pose; None if they are invalid.

    Args:
        attributes: the attributes of the vertices that `gltf_rewriting` has marked.
        transform: the pose, (4, 4), which may include scale and mirror the mesh.
    """
    if MARKED_NORMAL not in attributes:
        return None
    matrix = np.asarray(transform, dtype=np.float64)[:3, :3]
    size = determinant(matrix)
    normals = np.asarray(attributes[MARKED_NORMAL], dtype=np.float64)
    if normals.ndim != 2 or normals.shape[1] != 3 or size == 0.0:
        return None
    # The normals of the file point to its front faces, also where the pose mirrors them.
    unit_normals = _normalize(product(normals, inverse(matrix)))
    if unit_normals is None:
        return None
    return Directions(unit_normals, _transform_tangents(attributes, matrix, size, len(normals)))


def convert_directed(
    vertices: Array, faces: Any, uvs: Array, directions: Directions, appearance: Appearance
) -> Mesh | None:
    """Return the mesh of a part with its own normals; None if it has no triangle.

    Args:
        vertices: the positions of the vertices, (n, 3) [m].
        faces: the vertex indices of the triangles, (m, 3).
        uvs: the texture coordinates, (n, 2).
        directions: the normals and tangents.
        appearance: the colours and maps.
    """
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    faces = faces[(normals != 0.0).any(axis=1)]
    if not len(faces):
        return None
    tangents = directions.tangents
    return Mesh(
        vertices=vertices.astype(np.float32),
        normals=directions.normals.astype(np.float32),
        uvs=uvs.astype(np.float32),
        triangles=faces.astype(np.uint32),
        colour=appearance.colour,
        texture=appearance.texture,
        opacity=appearance.opacity,
        two_sided=appearance.two_sided,
        material=appearance.material,
        tangents=None if tangents is None else tangents.astype(np.float32),
    )


def _transform_tangents(
    attributes: Mapping[str, Any], matrix: Array, size: float, n: int
) -> Array | None:
    tangents = np.asarray(attributes.get(MARKED_TANGENT, ()), dtype=np.float64)
    if tangents.shape != (n, 4):
        return None
    unit_tangents = _normalize(product(tangents[:, :3], np.ascontiguousarray(matrix.T)))
    if unit_tangents is None:
        return None
    signs = np.where(tangents[:, 3] < 0.0, -1.0, 1.0) * (1.0 if size > 0.0 else -1.0)
    return np.column_stack([unit_tangents, signs])


def _normalize(vectors: Array) -> Array | None:
    lengths = np.sqrt((vectors * vectors).sum(axis=1, keepdims=True))
    if not np.isfinite(lengths).all() or (lengths < MIN_LENGTH).any():
        return None
    unit: Array = vectors / lengths
    return unit
