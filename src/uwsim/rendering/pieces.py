"""Large models are split into pieces, so that those out of view are not drawn."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.linear import length, product

MAX_PIECE_LENGTH = 2.0
"""Pieces are no longer than this ... [m]"""
MAX_PIECES = 4
"""... unless there were more than so many along an axis."""
MIN_TRIANGLES = 16
"""A model with fewer triangles is not split."""
FLAT = 0.02
"""Sine of the greatest angle between a flat piece's normal and those of its triangles."""

Triangles = npt.NDArray[np.uint32]


def crosses(points: Array, triangles: Triangles) -> Array:
    """Normals of triangles; their length is twice the area, (m, 3) [m2].

    Args:
        points: the vertices, (n, 3) [m].
        triangles: three vertices each, (m, 3).
    """
    corners = points[triangles]
    a, b = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    return np.stack(
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]], axis=1
    )


def pieces(points: Array, triangles: Triangles, normals: Array) -> list[npt.NDArray[np.intp]]:
    """Sort triangles by where they are and which way they face; no triangle is cut.

    Floor and walls come apart, so that their pieces are flat.

    Args:
        points: the vertices, (n, 3) [m].
        triangles: three vertices each, (m, 3).
        normals: of the triangles, of any length, (m, 3).

    Returns:
        The numbers of the triangles in each piece.
    """
    everything = np.arange(len(triangles))
    if len(triangles) < MIN_TRIANGLES:
        return [everything]
    low, high = points.min(axis=0), points.max(axis=0)
    counts = np.clip(np.ceil((high - low) / MAX_PIECE_LENGTH), 1, MAX_PIECES).astype(int)
    if counts.prod() == 1:
        return [everything]
    sizes = np.maximum((high - low) / counts, 1e-9)
    middles = points[triangles].mean(axis=1)
    cells = np.minimum(((middles - low) / sizes).astype(int), counts - 1)  # (m, 3)
    axes = np.argmax(np.abs(normals), axis=1)
    is_backward = normals[everything, axes] < 0.0
    numbers = np.ravel_multi_index(
        (*cells.T, axes, is_backward.astype(int)), (*counts.tolist(), 3, 2)
    )
    order = np.argsort(numbers, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(numbers[order])) + 1)


def flat_normal(normals: Array) -> Array:
    """Return the unit normal of triangles that lie in one direction, else 0, (3,).

    Args:
        normals: of the triangles, as long as twice their areas, (m, 3) [m2].
    """
    total = normals.sum(axis=0)
    size = length(total)
    if size == 0.0:
        return np.zeros(3)
    normal: Array = total / size
    along = product(normals, normal)
    squares = np.square(normals).sum(axis=1)
    is_flat = (squares - along**2 <= FLAT**2 * squares).all()
    return normal if is_flat else np.zeros(3)


def densities(points: Array, triangles: Triangles, places: Array) -> Array:
    """Return how many texels lie along a metre at most, on each triangle, (m,) [1/m].

    The larger singular value of its map from its plane to the texture; 0 where it has no area.

    Args:
        points: the vertices, (n, 3) [m].
        triangles: three vertices each, (m, 3).
        places: the vertices on the texture, (n, 2) [texel].
    """
    corners, spots = points[triangles], places[triangles]
    edges, ways = corners[:, 1:] - corners[:, :1], spots[:, 1:] - spots[:, :1]  # (m, 2, 3 or 2)
    e, f = (edges[:, i] for i in range(2))
    u, v = (ways[:, i] for i in range(2))
    ee, ef, ff = (e * e).sum(axis=1), (e * f).sum(axis=1), (f * f).sum(axis=1)
    uu, uv, vv = (u * u).sum(axis=1), (u * v).sum(axis=1), (v * v).sum(axis=1)
    area = ee * ff - ef**2  # squared, times 4
    with np.errstate(divide="ignore", invalid="ignore"):
        # the eigenvalues of (edges edges')^-1 (ways ways') are the singular values squared
        half = (ff * uu - 2.0 * ef * uv + ee * vv) / area / 2.0
        rest = (uu * vv - uv**2) / area
        largest = np.sqrt(np.maximum(half + np.sqrt(np.maximum(half**2 - rest, 0.0)), 0.0))
    found: Array = np.where(area > 1e-18, largest, 0.0)
    return found
