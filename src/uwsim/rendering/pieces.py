"""Large models in pieces, so that what is out of view, or out of a shadow's way, costs nothing."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..geometry import Array

LONGEST_PIECE = 2.0
"""Pieces are no longer than this ... [m]"""
MOST_PIECES = 4
"""... unless there were more than so many along an axis."""
FEWEST_TRIANGLES = 16
"""A model with fewer is not cut."""
FLAT = 0.02
"""Of a flat piece, the sine of the angle between its normal and those of its triangles at most."""

Triangles = npt.NDArray[np.uint32]


def pieces(points: Array, triangles: Triangles) -> list[npt.NDArray[np.intp]]:
    """Sort triangles by where they are and which way they face; no triangle is cut.

    Floor and walls come apart, so that their pieces are flat.

    Args:
        points: the vertices, (n, 3) [m].
        triangles: three vertices each, (m, 3).

    Returns:
        The numbers of the triangles in each piece.
    """
    everything = np.arange(len(triangles))
    if len(triangles) < FEWEST_TRIANGLES:
        return [everything]
    low, high = points.min(axis=0), points.max(axis=0)
    counts = np.clip(np.ceil((high - low) / LONGEST_PIECE), 1, MOST_PIECES).astype(int)
    if counts.prod() == 1:
        return [everything]
    sizes = np.maximum((high - low) / counts, 1e-9)
    middles = points[triangles].mean(axis=1)
    cells = np.minimum(((middles - low) / sizes).astype(int), counts - 1)  # (m, 3)
    crosses = _crosses(points, triangles)
    axes = np.argmax(np.abs(crosses), axis=1)
    is_backward = crosses[everything, axes] < 0.0
    numbers = np.ravel_multi_index(
        (*cells.T, axes, is_backward.astype(int)), (*counts.tolist(), 3, 2)
    )
    return [np.flatnonzero(numbers == number) for number in np.unique(numbers)]


def flat_normal(points: Array, triangles: Triangles) -> Array:
    """Return the unit normal of triangles that lie in one direction, else 0, (3,)."""
    crosses = _crosses(points, triangles)
    total = crosses.sum(axis=0)
    size = float(np.linalg.norm(total))
    if size == 0.0:
        return np.zeros(3)
    normal: Array = total / size
    astray = crosses - np.outer(crosses @ normal, normal)
    is_flat = (np.linalg.norm(astray, axis=1) <= FLAT * np.linalg.norm(crosses, axis=1)).all()
    return normal if is_flat else np.zeros(3)


def density(points: Array, triangles: Triangles, places: Array) -> float:
    """Return how many texels lie along a metre, where most do [1/m].

    The larger singular value of each triangle's map from its plane to the texture.

    Args:
        points: the vertices, (n, 3) [m].
        triangles: three vertices each, (m, 3).
        places: the vertices on the texture, (n, 2) [texel].
    """
    corners, spots = points[triangles], places[triangles]
    edges, ways = corners[:, 1:] - corners[:, :1], spots[:, 1:] - spots[:, :1]  # (m, 2, 3 or 2)
    lengths = edges @ edges.transpose(0, 2, 1)  # (m, 2, 2)
    texels = ways @ ways.transpose(0, 2, 1)
    is_real = np.linalg.det(lengths) > 1e-18
    if not is_real.any():
        return 0.0
    squares = np.linalg.solve(lengths[is_real], texels[is_real])
    half = np.trace(squares, axis1=1, axis2=2) / 2.0
    largest = half + np.sqrt(np.maximum(half**2 - np.linalg.det(squares), 0.0))
    return float(np.sqrt(max(float(largest.max()), 0.0)))


def _crosses(points: Array, triangles: Triangles) -> Array:
    """Normals as long as twice the areas, (m, 3) [m2]."""
    corners = points[triangles]
    crosses: Array = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return crosses
