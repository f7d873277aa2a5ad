"""Boats and ships: ``objects/boat``, ``objects/ship``; z up, bow at +x, water line at z = 0.

The sizes are assumed, because the sizes of UWSim's models are not known.
"""

from __future__ import annotations

import math

import numpy as np

from uwsim.assets.mesh import Mesh

from ..shapes import Shape, box, cylinder, loft, mesh
from ..textures import worn_paint


def hull(length: float, beam: float, draught: float, freeboard: float, *, n: int = 14) -> Shape:
    """Return a round-bilged hull with a raked bow, a transom and a deck."""
    stations = np.linspace(0.0, 1.0, n)
    rings = []
    for s in stations:
        half_beam = (
            beam / 2 * (1.0 - max(0.0, (s - 0.45) / 0.55) ** 2.2) * (0.86 + 0.14 * min(1, s * 4))
        )
        half_beam = max(half_beam, 0.004 * length)
        keel_depth = (
            draught * (1.0 - max(0.0, (s - 0.6) / 0.4) ** 2.5) * (0.75 + 0.25 * min(1, s * 3))
        )
        deck_height = freeboard * (1.0 + 0.5 * s**3)
        x = length * (s - 0.5)
        ring = []
        for t in np.linspace(0.0, math.pi, 11):  # from starboard deck edge under the keel to port
            y = -half_beam * math.copysign(abs(math.cos(t)) ** 0.7, math.cos(t))
            z = deck_height - (deck_height + keel_depth) * math.sin(t) ** 0.8
            rake = 0.06 * length * s**6 * (z + keel_depth) / (deck_height + keel_depth)
            ring.append((x + rake, y, z))
        rings.append(ring)
    return loft(np.array(rings))


def boat() -> tuple[Mesh, ...]:
    """A work boat of 6 m with a cabin."""
    white, blue = (
        worn_paint("ships/white", (0.90, 0.90, 0.88)),
        worn_paint("ships/blue", (0.12, 0.25, 0.50)),
    )
    cabin = [box((-1.2, -0.7, 0.5), (0.6, 0.7, 1.9)), box((-1.3, -0.8, 1.9), (0.8, 0.8, 1.98))]
    mast = [cylinder((-0.3, 0.0, 1.9), (-0.3, 0.0, 3.4), 0.03, n=8)]
    return (
        mesh(hull(6.0, 2.1, 0.45, 0.65), texture=blue, crease=0.7),
        mesh(*cabin, *mast, texture=white),
    )


def ship() -> tuple[Mesh, ...]:
    """A research ship of 32 m: hull, superstructure, funnel, mast, stern frame."""
    white, red = (
        worn_paint("ships/white", (0.90, 0.90, 0.88)),
        worn_paint("ships/red", (0.55, 0.14, 0.10)),
    )
    house = [
        box((-2.0, -2.8, 2.0), (8.5, 2.8, 4.6)),
        box((1.0, -2.6, 4.6), (7.5, 2.6, 7.0)),
        box((0.6, -3.2, 7.0), (7.8, 3.2, 7.2)),
        cylinder((4.0, 0.0, 7.2), (4.0, 0.0, 12.0), 0.15, n=8),
        cylinder((-0.4, 0.0, 4.6), (-0.6, 0.0, 7.4), 0.7, n=14),
    ]
    frame = [
        cylinder((-14.5, side * 2.2, 1.8), (-15.5, side * 1.8, 6.0), 0.16, n=8)
        for side in (-1.0, 1.0)
    ]
    frame.append(cylinder((-15.5, -1.9, 6.0), (-15.5, 1.9, 6.0), 0.16, n=8))
    return (
        mesh(hull(32.0, 8.0, 2.6, 2.2, n=18).scale_uv(4.0, 4.0), texture=red, crease=0.7),
        mesh(*house, *frame, texture=white),
    )
