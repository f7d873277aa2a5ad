r"""Tangents at the vertices of a mesh, to which the components of its normal map refer.

In a triangle with edges :math:`e_1, e_2` and the changes :math:`(u_1, v_1), (u_2, v_2)` of texture
coordinates along them, the position changes with u by

.. math:: t = \frac{v_2\, e_1 - v_1\, e_2}{u_1 v_2 - u_2 v_1}

The tangent at a vertex is the mean of the directions of t in its triangles, each projected on the
plane of the vertex normal and weighted by the angle of the triangle there. Triangles whose texture
is mirrored have their own vertices. These are the rules of M. S. Mikkelsen's "Simulation of
Wrinkled Surfaces Revisited" (2008), after which modelling programs compute normal maps. Unlike
there, all triangles that meet at a vertex and have equal normals and texture coordinates are in
one mean, also if they share no edge.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.elementwise import arccos
from .mesh import Mesh

MIN_LENGTH = 1e-12
"""The length of a vector below which its direction is undefined."""


def add_tangents(mesh: Mesh) -> Mesh:
    """Return a mesh with tangents; vertices at the seams of mirrored textures are doubled."""
    normals, uvs = mesh.normals.astype(np.float64), mesh.uvs.astype(np.float64)
    corners, texture_corners = mesh.vertices.astype(np.float64)[mesh.triangles], uvs[mesh.triangles]
    directions, signs = compute_directions(corners, texture_corners)
    corner_normals = normals[mesh.triangles]  # (m, 3, 3)
    normal_parts = (corner_normals * directions[:, None]).sum(axis=2, keepdims=True)
    tangents = _normalize(directions[:, None] - normal_parts * corner_normals)
    weighted_tangents = tangents * _compute_angles(corners, corner_normals)[..., None]
    corner_signs = np.repeat(signs, 3)
    keys = 2 * _find_equal_vertices(mesh)[mesh.triangles.ravel()] + (corner_signs < 0.0)
    n = 2 * len(mesh.vertices)
    sums: Array = np.stack(
        [np.bincount(keys, weighted_tangents[..., k].ravel(), minlength=n) for k in range(3)], 1
    )
    rows, first_corners, triangles = np.unique(
        2 * mesh.triangles.ravel().astype(np.int64) + (corner_signs < 0.0),
        return_index=True,
        return_inverse=True,
    )
    vertices = rows // 2
    vertex_tangents: Array = _normalize(sums[keys[first_corners]])
    is_undefined = (vertex_tangents == 0.0).all(axis=1)
    vertex_tangents[is_undefined] = _find_perpendiculars(normals[vertices[is_undefined]])
    return replace(
        mesh,
        vertices=mesh.vertices[vertices],
        normals=mesh.normals[vertices],
        uvs=mesh.uvs[vertices],
        triangles=triangles.reshape(-1, 3).astype(np.uint32),
        tangents=np.column_stack([vertex_tangents, 1.0 - 2.0 * (rows % 2)]).astype(np.float32),
    )


def compute_directions(corners: Array, uvs: Array) -> tuple[Array, Array]:
    """Compute the direction of increasing u in triangles, (m, 3), and -1 for mirrored ones, (m,).

    Args:
        corners: the corners of the triangles, (m, 3, 3).
        uvs: the texture coordinates of the corners, (m, 3, 2).

    Returns:
        Unit vectors, 0 where the texture has no area; and 1 or -1.
    """
    (e1, e2), (d1, d2) = (
        np.moveaxis(values[:, 1:] - values[:, :1], 1, 0) for values in (corners, uvs)
    )
    areas = d1[:, 0] * d2[:, 1] - d2[:, 0] * d1[:, 1]
    signs = np.where(areas < 0.0, -1.0, 1.0)
    vectors = signs[:, None] * (d2[:, 1:] * e1 - d1[:, 1:] * e2)
    return np.where(areas[:, None] == 0.0, 0.0, _normalize(vectors)), signs


def _compute_angles(corners: Array, normals: Array) -> Array:
    """Compute the angle of each corner in the plane of its normal, (m, 3) [rad]."""
    sides = []
    for step in (1, 2):
        side = np.roll(corners, -step, axis=1) - corners
        normal_parts = (side * normals).sum(axis=2, keepdims=True)
        sides.append(_normalize(side - normal_parts * normals))
    cosines = (sides[0] * sides[1]).sum(axis=2)
    angles: Array = arccos(np.clip(cosines, -1.0, 1.0))
    return angles


def _find_equal_vertices(mesh: Mesh) -> npt.NDArray[np.int64]:
    """Return a number for each vertex, equal for vertices with equal values, (n,)."""
    values = np.column_stack([mesh.vertices, mesh.normals, mesh.uvs]).astype(np.float32) + 0.0
    rows = np.ascontiguousarray(values).view(np.dtype((np.void, values.itemsize * 8))).ravel()
    numbers: npt.NDArray[np.int64] = np.unique(rows, return_inverse=True)[1].ravel()
    return numbers


def _normalize(vectors: Array) -> Array:
    """Return vectors (..., 3) with unit length; 0 remains 0."""
    lengths = np.sqrt((vectors * vectors).sum(axis=-1, keepdims=True))
    is_defined = lengths > MIN_LENGTH
    unit: Array = np.where(is_defined, vectors / np.where(is_defined, lengths, 1.0), 0.0)
    return unit


def _find_perpendiculars(normals: Array) -> Array:
    """Return a unit vector perpendicular to each normal, (n, 3)."""
    axes = np.eye(3)[np.abs(normals).argmin(axis=1)]
    normal_parts = (axes * normals).sum(axis=1, keepdims=True)
    return _normalize(axes - normal_parts * normals)
