"""Small objects to grasp: a ring and a hook (``objects/torus``, ``objects/hook``)."""

from __future__ import annotations

import math

import numpy as np

from uwsim.assets.mesh import Mesh

from ..shapes import loft, mesh, torus
from ..textures import worn_paint


def ring_object() -> tuple[Mesh, ...]:
    """A ring about z: outer radius 0.10 m, height 0.04 m."""
    return (
        mesh(torus(0.08, 0.02, n=40, m=16), texture=worn_paint("torus/paint", (0.85, 0.20, 0.12))),
    )


def hook() -> tuple[Mesh, ...]:
    """A flat hook in the y-z plane, 0.01 x 0.049 x 0.20 m: shank, bend, open tip."""
    r_in, r_out = 0.0095, 0.0245
    centre_y, centre_z = 0.0, -0.10 + r_out
    angle = np.linspace(0.0, -math.pi, 13)
    path = [(centre_y + r_out - 0.015, 0.10), (centre_y + r_out - 0.015, centre_z)]
    ring_in = [(centre_y + r_in * math.cos(a), centre_z + r_in * math.sin(a)) for a in angle]
    ring_out = [(centre_y + r_out * math.cos(a), centre_z + r_out * math.sin(a)) for a in angle]
    inner_line = [(path[0][0], 0.10), *ring_in, (centre_y - r_in, centre_z + 0.035)]
    outer_line = [(centre_y + r_out, 0.10), *ring_out, (centre_y - r_out + 0.006, centre_z + 0.030)]
    half = 0.005
    rings = np.array(
        [
            [(half, *i), (-half, *i), (-half, *o), (half, *o)]
            for i, o in zip(inner_line, outer_line, strict=True)
        ]
    )
    steel = worn_paint("hook/steel", (0.62, 0.63, 0.64), size=128)
    return (mesh(loft(rings).project_uv(0.1), texture=steel, crease=0.6),)
