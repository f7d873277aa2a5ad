"""Small things to grasp: a ring and a hook (``objects/torus``, ``objects/hook``)."""

from __future__ import annotations

import math

import numpy as np

from ..mesh import Mesh
from .shapes import loft, mesh, torus
from .textures import worn


def ring_object() -> tuple[Mesh, ...]:
    """A ring about z: outer radius 0.10 m, height 0.04 m."""
    return (mesh(torus(0.08, 0.02, n=40, m=16), texture=worn("torus/paint", (0.85, 0.20, 0.12))),)


def hook() -> tuple[Mesh, ...]:
    """A flat hook in the y-z plane, 0.01 x 0.049 x 0.20 m: shank, bend, open tip."""
    inner, outer = 0.0095, 0.0245
    centre_y, centre_z = 0.0, -0.10 + outer
    angle = np.linspace(0.0, -math.pi, 13)
    path = [(centre_y + outer - 0.015, 0.10), (centre_y + outer - 0.015, centre_z)]
    ring_in = [(centre_y + inner * math.cos(a), centre_z + inner * math.sin(a)) for a in angle]
    ring_out = [(centre_y + outer * math.cos(a), centre_z + outer * math.sin(a)) for a in angle]
    inside = [(path[0][0], 0.10), *ring_in, (centre_y - inner, centre_z + 0.035)]
    outside = [(centre_y + outer, 0.10), *ring_out, (centre_y - outer + 0.006, centre_z + 0.030)]
    half = 0.005
    rings = np.array(
        [
            [(half, *i), (-half, *i), (-half, *o), (half, *o)]
            for i, o in zip(inside, outside, strict=True)
        ]
    )
    steel = worn("hook/steel", (0.62, 0.63, 0.64), size=128)
    return (mesh(loft(rings).projected(0.1), texture=steel, crease=0.6),)
