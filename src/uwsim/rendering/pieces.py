"""Division of large meshes into pieces, so that pieces out of view are not drawn."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.linear import length, product

MAX_PIECE_LENGTH = 2.0
"""The largest length of a piece, unless `MAX_PIECES` limits their number [m]."""
MAX_PIECES = 4
"""The largest number of pieces along an axis of the model's frame."""
MIN_TRIANGLES = 16
"""The number of triangles below which a mesh is not divided."""
MAX_FLAT_SINE = 0.02
"""The sine of the largest angle between the normals of a flat piece and of its triangles."""

Triangles = npt.NDArray[np.uint32]


def compute_normals(points: Array, triangles: Triangles) -> Array:
    """Compute the normals of triangles; the length of a normal is twice the area, (m, 3) [m2].

    Args:
        points: the positions of the vertices, (n, 3) [m].
        triangles: the vertex indices of the triangles, (m, 3).
    """
    corners = points[triangles]
    a, b = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    return np.stack(
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]], axis=1
    )


def split_triangles(
    points: Array, triangles: Triangles, normals: Array
) -> list[npt.NDArray[np.intp]]:
    """Group triangles by position and by direction of their normals; no triangle is cut.

    The floor and the walls of a tank are in separate pieces, so that these pieces are flat.

    Args:
        points: the positions of the vertices, (n, 3) [m].
        triangles: the vertex indices of the triangles, (m, 3).
        normals: the normals of the triangles, of any length, (m, 3).

    Returns:
        The numbers of the triangles in each piece.
    """
    all_triangles = np.arange(len(triangles))
    if len(triangles) < MIN_TRIANGLES:
        return [all_triangles]
    low, high = points.min(axis=0), points.max(axis=0)
    counts = np.clip(np.ceil((high - low) / MAX_PIECE_LENGTH), 1, MAX_PIECES).astype(int)
    if counts.prod() == 1:
        return [all_triangles]
    sizes = np.maximum((high - low) / counts, 1e-9)
    middles = points[triangles].mean(axis=1)
    cells = np.minimum(((middles - low) / sizes).astype(int), counts - 1)  # (m, 3)
    axes = np.argmax(np.abs(normals), axis=1)
    is_backward = normals[all_triangles, axes] < 0.0
    numbers = np.ravel_multi_index(
        (*cells.T, axes, is_backward.astype(int)), (*counts.tolist(), 3, 2)
    )
    order = np.argsort(numbers, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(numbers[order])) + 1)


def flat_normal(normals: Array) -> Array:
    """Return the common unit normal of triangles, (3,); 0 if their directions differ.

    Args:
        normals: the normals of the triangles, as long as twice their areas, (m, 3) [m2].
    """
    total = normals.sum(axis=0)
    size = length(total)
    if size == 0.0:
        return np.zeros(3)
    normal: Array = total / size
    normal_parts = product(normals, normal)
    squares = np.square(normals).sum(axis=1)
    is_flat = (squares - normal_parts**2 <= MAX_FLAT_SINE**2 * squares).all()
    return normal if is_flat else np.zeros(3)


def compute_texel_densities(points: Array, triangles: Triangles, texture_points: Array) -> Array:
    """Return the largest number of texels per metre on each triangle, (m,) [1/m].

    It is the larger singular value of the map from the triangle's plane to the texture; 0 for a
    triangle without an area.

    Args:
        points: the positions of the vertices, (n, 3) [m].
        triangles: the vertex indices of the triangles, (m, 3).
        texture_points: the positions of the vertices on the texture, (n, 2) [texel].
    """
    corners, texels = points[triangles], texture_points[triangles]
    edges, texel_edges = (
        corners[:, 1:] - corners[:, :1],
        texels[:, 1:] - texels[:, :1],
    )  # (m, 2, 3 or 2)
    e, f = (edges[:, i] for i in range(2))
    u, v = (texel_edges[:, i] for i in range(2))
    ee, ef, ff = (e * e).sum(axis=1), (e * f).sum(axis=1), (f * f).sum(axis=1)
    uu, uv, vv = (u * u).sum(axis=1), (u * v).sum(axis=1), (v * v).sum(axis=1)
    squared_area = ee * ff - ef**2  # times 4
    with np.errstate(divide="ignore", invalid="ignore"):
        # the eigenvalues of (edges edges')^-1 (texel_edges texel_edges') are the squares of the
        # singular values
        half_trace = (ff * uu - 2.0 * ef * uv + ee * vv) / squared_area / 2.0
        determinant = (uu * vv - uv**2) / squared_area
        root = np.sqrt(np.maximum(half_trace**2 - determinant, 0.0))
        max_densities = np.sqrt(np.maximum(half_trace + root, 0.0))
    texel_densities: Array = np.where(squared_area > 1e-18, max_densities, 0.0)
    return texel_densities
