"""Star-shaped bodies with one image each, on the six faces of a cube; their textures have no seam.

The image has two rows of three faces. Each has a margin that continues its neighbours, so that
smaller versions of the image do not mix faces.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from .fields import Points, Values
from .parts import Part
from .shapes import Shape, join, surface
from .surfaces import make_material
from .textures import Pixels

FACES = (
    ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    ((-1, 0, 0), (0, -1, 0), (0, 0, 1)),
    ((0, 1, 0), (-1, 0, 0), (0, 0, 1)),
    ((0, -1, 0), (1, 0, 0), (0, 0, 1)),
    ((0, 0, 1), (1, 0, 0), (0, 1, 0)),
    ((0, 0, -1), (0, 1, 0), (1, 0, 0)),
)
"""The outward normal of each face, and the axes u and v."""
COLUMNS, ROWS = 3, 2
MARGIN = 5
"""The margin of a face [px]."""


class Skin(NamedTuple):
    """The look of a surface at points: colour (..., 3), height [m], roughness, all (...)."""

    colour: Pixels
    height: Values
    roughness: Values


Radius = Callable[[Points], Values]
"""A function that returns the radius [m] in directions (..., 3) of unit length."""
Paint = Callable[[Points, Points], Skin]
"""A function that returns the skin at points, with their directions."""


def bake(name: str, radius: Radius, paint: Paint, *, n: int = 20, side: int = 256) -> Part:
    """Return a body with its material.

    Args:
        name: the name of the material.
        radius: the shape.
        paint: the skin.
        n: the number of squares along an edge of a face.
        side: the side of the image of a face with its margin [px].
    """
    shape = join(*(_face(face, radius, n, side) for face in range(len(FACES))))
    usable_share = side / (side - 2.0 * MARGIN)
    line = (np.arange(side) + 0.5) / side * 2.0 - 1.0
    v, u = np.meshgrid(-line * usable_share, line * usable_share, indexing="ij")
    tiles: list[tuple[Skin, Values, Values]] = []
    for face in range(len(FACES)):
        direction = _directions(face, u, v)
        points = direction * radius(direction)[..., None]
        skin = paint(points, direction)
        tiles.append((skin, _spacing(points, 1), _spacing(points, 0)))
    skins = [skin for skin, _, _ in tiles]
    material = make_material(
        name,
        _assemble([skin.colour for skin in skins]),
        _assemble([skin.height for skin in skins]),
        _assemble([skin.roughness for skin in skins]),
        pixel=(_assemble([u for _, u, _ in tiles]), _assemble([v for _, _, v in tiles])),
        repeats=False,
    )
    return material.cover(shape, crease=2.0)


def _assemble(tiles: list[np.ndarray]) -> np.ndarray:
    rows = [np.concatenate(tiles[row * COLUMNS : (row + 1) * COLUMNS], 1) for row in range(ROWS)]
    return np.concatenate(rows, axis=0)


def _directions(face: int, u: np.ndarray, v: np.ndarray) -> Points:
    """Return the directions of points of a face, at about equal angles from each other."""
    normal, right, up = (np.array(axis, dtype=np.float64) for axis in FACES[face])
    a, b = _warp(u)[..., None], _warp(v)[..., None]
    direction = normal + a * right + b * up
    direction /= np.sqrt((direction * direction).sum(axis=-1, keepdims=True))
    return np.asarray(direction, dtype=np.float32)


def _warp(values: np.ndarray) -> np.ndarray:
    """Return the tangents of coordinates on a face, -1..1 for -45..45 degrees."""
    coordinates, inverse = np.unique(values, return_inverse=True)
    tangents = np.array([math.tan(value * math.pi / 4.0) for value in coordinates.tolist()])
    return tangents[inverse.reshape(values.shape)]


def _spacing(points: Points, axis: int) -> Values:
    """Return the distance of neighbouring points along an axis [m]."""
    steps = np.gradient(points, axis=axis)
    lengths: Values = np.sqrt((steps * steps).sum(axis=-1)).astype(np.float32)
    return lengths


def _face(face: int, radius: Radius, n: int, side: int) -> Shape:
    line = np.linspace(-1.0, 1.0, n + 1)
    v, u = np.meshgrid(line, line, indexing="ij")
    direction = _directions(face, u, v)
    points = (direction * radius(direction)[..., None]).astype(np.float64)
    column, row = face % COLUMNS, face // COLUMNS
    usable_share = (side - 2.0 * MARGIN) / side
    s = (column + 0.5 + 0.5 * u * usable_share) / COLUMNS
    t = 1.0 - (row + 0.5 - 0.5 * v * usable_share) / ROWS
    return surface(points, np.stack([s, t], axis=2))
