"""A straight piece of green pipe with flanges: ``objects/pipe_green``; axis y."""

from __future__ import annotations

import numpy as np

from uwsim.assets.mesh import Mesh

from ..shapes import cylinder, join, mesh, ring, rotation_to
from ..textures import worn_paint

LENGTH, RADIUS, FLANGE = 1.885, 0.15, 0.20
"""Length (the spacing of the pieces in UWSim's scene), radius of pipe and of flanges [m]."""


def pipe() -> tuple[Mesh, ...]:
    """The pipe, a flange at each end, eight bolts in each."""
    half, along_y = LENGTH / 2, rotation_to(np.array([0.0, 1.0, 0.0]))
    parts = [ring(RADIUS, RADIUS - 0.012, -half, half, n=28).scale_uv(2.0, 4.0)]
    bolts = []
    for low, high in ((-half, -half + 0.03), (half - 0.03, half)):
        parts.append(ring(FLANGE, RADIUS - 0.012, low, high, n=28))
        for k in range(8):
            x, y = 0.178 * np.cos(k * np.pi / 4), 0.178 * np.sin(k * np.pi / 4)
            low_bolt, high_bolt = (low + 0.03, high + 0.015) if low < 0 else (low - 0.015, low)
            bolts.append(cylinder((x, y, low_bolt), (x, y, high_bolt), 0.012, n=6))
    green = worn_paint("pipe/green", (0.16, 0.45, 0.22), grain=0.09)
    steel = worn_paint("pipe/steel", (0.60, 0.61, 0.62), size=128)
    return (
        mesh(*(part.rotate(along_y) for part in parts), texture=green),
        mesh(join(*bolts).rotate(along_y), texture=steel),
    )
