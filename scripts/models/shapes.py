"""Shapes of models: those of the package, and extrusions, bars, rings.

Outlines are counter-clockwise; lengths are in metres.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from uwsim.assets.procedural.shapes import (
    CREASE,
    Shape,
    box,
    cylinder,
    join,
    lathe,
    mesh,
    quad,
    rotation_to,
    sphere,
    surface,
)
from uwsim.base.geometry import Array, Triple
from uwsim.base.numerics.linear import dot, length, product

__all__ = [
    "CREASE",
    "Shape",
    "box",
    "capsule",
    "circle",
    "cylinder",
    "extrusion",
    "join",
    "lathe",
    "loft",
    "mesh",
    "quad",
    "ring",
    "rotation_to",
    "rounded_box",
    "rounded_rectangle",
    "sphere",
    "surface",
    "torus",
    "tube",
]


def rounded_rectangle(width: float, height: float, radius: float, n: int = 3) -> Array:
    """Return the outline of a rounded rectangle, counter-clockwise, (4(n+1), 2) [m]."""
    corner = np.linspace(0, math.pi / 2, n + 1)
    points = []
    for k, (sx, sy) in enumerate([(1, 1), (-1, 1), (-1, -1), (1, -1)]):
        cx, cy = sx * (width / 2 - radius), sy * (height / 2 - radius)
        angle = corner + k * math.pi / 2
        points.append(np.stack([cx + radius * np.cos(angle), cy + radius * np.sin(angle)], axis=1))
    return np.concatenate(points)


def circle(radius: float, n: int = 16) -> Array:
    """Return the outline of a circle, counter-clockwise, (n, 2) [m]."""
    angle = np.arange(n) * (2 * math.pi / n)
    return radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def loft(rings: Array, *, has_lids: bool = True) -> Shape:
    """Connect rings (k, n, 3) that go up, each counter-clockwise as seen from above.

    ``has_lids`` puts flat lids (fans round the middle) on both ends.
    """
    grid = np.concatenate([rings, rings[:, :1]], axis=1)
    shapes = [surface(grid)]
    if has_lids:
        n = rings.shape[1]
        for ring, order in ((rings[0], -1), (rings[-1], 1)):
            middle = ring.mean(axis=0)
            fan = np.stack([np.broadcast_to(middle, (n, 3)), ring, np.roll(ring, -1, axis=0)], 1)
            lid = fan[:, ::order]
            low, high = ring.min(axis=0), ring.max(axis=0)
            size = np.where(high - low < 1e-9, 1.0, high - low)
            shapes.append(Shape(lid, ((lid - low) / size)[:, :, :2]))
    return join(*shapes)


def extrusion(
    outline: Array, z0: float, z1: float, *, bevel: float = 0.0, bevel_steps: int = 1
) -> Shape:
    """A star-shaped outline (n, 2) between two heights, its rims bevelled inwards by ``bevel``."""
    if bevel == 0.0:
        levels = [(z0, 0.0), (z1, 0.0)]
    else:
        angles = np.linspace(0, math.pi / 2, bevel_steps + 1)
        low = [(z0 + bevel * (1 - math.sin(a)), bevel * (1 - math.cos(a))) for a in angles[::-1]]
        high = [(z1 - bevel * (1 - math.sin(a)), bevel * (1 - math.cos(a))) for a in angles]
        levels = [*low, *high]
    half = np.abs(outline).max(axis=0)
    rings = [
        np.column_stack([outline * (1 - inset / half), np.full(len(outline), z)])
        for z, inset in levels
    ]
    return loft(np.array(rings))


def rounded_box(lower: Triple, upper: Triple, *, radius: float, n: int = 2) -> Shape:
    """Return a box with rounded upright edges and bevelled rims."""
    low, high = np.array(lower), np.array(upper)
    size, middle = high - low, (low + high) / 2
    outline = rounded_rectangle(size[0], size[1], radius, n)
    shape = extrusion(outline, -size[2] / 2, size[2] / 2, bevel=radius * 0.6, bevel_steps=n)
    return shape.shift(*middle.tolist())


def capsule(radius: float, z0: float, z1: float, *, n: int = 20) -> Shape:
    """Return a rod with round ends at z0 and z1."""
    a = np.linspace(0, math.pi / 2, max(2, n // 4) + 1)
    low = np.stack([radius * np.sin(a), z0 + radius - radius * np.cos(a)], axis=1)
    high = np.stack([radius * np.cos(a), z1 - radius + radius * np.sin(a)], axis=1)
    return lathe(np.concatenate([low, high]), n=n)


def torus(ring: float, tube_radius: float, *, n: int = 32, m: int = 12) -> Shape:
    """Return a ring about z, by the radius of the middle line and the radius of the tube."""
    a = np.linspace(-math.pi, math.pi, m + 1)
    a[-1] = -math.pi
    profile = np.stack([ring + tube_radius * np.cos(a), tube_radius * np.sin(a)], axis=1)
    return lathe(profile, n=n)


def tube(
    path: Sequence[Triple] | Array, radius: float, *, n: int = 10, has_lids: bool = True
) -> Shape:
    """Return a bent bar along a path of points; ``has_lids`` adds flat ends."""
    points = np.asarray(path, dtype=np.float64)
    step = np.diff(points, axis=0)
    step /= np.linalg.norm(step, axis=1, keepdims=True)
    to_point, from_point = np.concatenate([step[:1], step]), np.concatenate([step, step[-1:]])
    tangent = to_point + from_point
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    normal = rotation_to(tangent[0])[:, 0]
    disc = circle(radius, n)
    rings = []
    for k, point in enumerate(points):
        normal = normal - tangent[k] * dot(normal, tangent[k])
        normal /= length(normal)
        offsets = disc[:, :1] * normal + disc[:, 1:] * np.cross(tangent[k], normal)
        bend = from_point[k] - to_point[k]
        if dot(bend, bend) > 1e-12:  # a mitre: wider across the bend, to stay as thick
            bend /= length(bend)
            stretch = 1.0 / dot(to_point[k], tangent[k]) - 1.0
            offsets += np.outer(product(offsets, bend), bend) * stretch
        rings.append(point + offsets)
    return loft(np.array(rings), has_lids=has_lids)


def ring(r_out: float, r_in: float, z0: float, z1: float, *, n: int = 24) -> Shape:
    """Return a pipe about z with both walls and both rims."""
    return lathe([(r_in, z0), (r_out, z0), (r_out, z1), (r_in, z1), (r_in, z0)], n=n)
