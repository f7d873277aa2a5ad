"""An old ship's gun lying on the sea floor: ``objects/gun``; axis x, muzzle at +x."""

from __future__ import annotations

import numpy as np

from uwsim.assets.mesh import Mesh

from ..shapes import cylinder, lathe, mesh, rotation_to
from ..textures import worn_paint

LENGTH = 2.4
"""The length from button to muzzle [m]; the size of UWSim's model is not known."""


def cannon() -> tuple[Mesh, ...]:
    """Return a barrel with mouldings, button, trunnions and an open bore."""
    profile = [
        (0.0, -1.20), (0.05, -1.19), (0.065, -1.14), (0.05, -1.09), (0.04, -1.07), (0.12, -1.04),
        (0.20, -1.02), (0.20, -0.96), (0.18, -0.94), (0.17, -0.40), (0.18, -0.39), (0.18, -0.34),
        (0.16, -0.32), (0.145, 0.20), (0.155, 0.21), (0.155, 0.26), (0.14, 0.28), (0.115, 1.00),
        (0.125, 1.02), (0.16, 1.14), (0.15, 1.20), (0.065, 1.20), (0.065, 0.80), (0.0, 0.78),
    ]  # fmt: skip
    barrel = lathe(profile, n=24).rotate(rotation_to(np.array([1.0, 0.0, 0.0])))
    trunnions = cylinder((-0.10, -0.30, -0.03), (-0.10, 0.30, -0.03), 0.06, n=14, bevel=0.008)
    rust = worn_paint("cannon/rust", (0.36, 0.29, 0.23), grain=0.14)
    return (mesh(barrel.scale_uv(2.0, 4.0), trunnions, texture=rust),)
