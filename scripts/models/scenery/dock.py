"""Docks of unit size, whose dimensions a scene sets: ``dock_square`` and ``dock_round``.

The axis is x, into the dock: the funnel from -1 to 0, the chamber from 0 to 1, closed there. Inner
sides are at a distance of 1 from the axis.
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from uwsim.base.geometry import Array

from ..parts import Part
from ..shapes import Shape, join, mesh, surface
from ..textures import worn_paint

WALL = 0.08
"""The thickness of walls, as a share of the half width [1]."""
N_SIDES = 24
"""The number of sides of the round dock."""
CREASE = 0.4
"""The angle of edges that remain sharp [rad]."""
FUNNEL_PAINT, CHAMBER_PAINT = (0.93, 0.62, 0.08), (0.70, 0.72, 0.72)


def square() -> tuple[Part, ...]:
    """Return a dock of four walls."""
    return _make(np.array([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [1.0, 1.0]]))


def round_() -> tuple[Part, ...]:
    """Return a dock that is a cone before a tube; its sides touch the circle from outside."""
    angles = (np.arange(N_SIDES + 1) % N_SIDES + 0.5) * (2.0 * math.pi / N_SIDES)
    radius = 1.0 / math.cos(math.pi / N_SIDES)
    return _make(radius * np.column_stack([np.cos(angles), np.sin(angles)]))


def _make(outline: Array) -> tuple[Part, ...]:
    """Return funnel and chamber around an outline (n, 2), counter-clockwise in y and z."""
    outer_scale = 1.0 + WALL
    funnel = _walls(outline, -1.0, 0.0, outer_scale)
    chamber = join(_walls(outline, 0.0, 1.0, outer_scale), _back(outline, outer_scale))
    colours = (("funnel", FUNNEL_PAINT, funnel), ("chamber", CHAMBER_PAINT, chamber))
    return tuple(
        Part(mesh=mesh(shape, texture=worn_paint(f"dock/{name}", paint, size=64), crease=CREASE))
        for name, paint, shape in colours
    )


def _walls(outline: Array, start: float, end: float, outer_scale: float) -> Shape:
    """Return inner and outer sides, and the rims, of walls from one x to another."""
    rings = [(start, 1.0), (end, 1.0), (end, outer_scale), (start, outer_scale), (start, 1.0)]
    return join(
        *(
            surface(np.stack([_ring(outline, *second), _ring(outline, *first)]))
            for first, second in pairwise(rings)
        )
    )


def _back(outline: Array, outer_scale: float) -> Shape:
    """Return the plate behind the chamber."""
    front, back = 1.0, 1.0 + WALL
    rings = [(back, 0.0), (back, outer_scale), (front, outer_scale), (front, 0.0)]
    return join(
        *(
            surface(np.stack([_ring(outline, *second), _ring(outline, *first)]))
            for first, second in pairwise(rings)
        )
    )


def _ring(outline: Array, x: float, scale: float) -> Array:
    return np.column_stack([np.full(len(outline), x), scale * outline])
