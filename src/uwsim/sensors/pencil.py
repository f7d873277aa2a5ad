r"""A narrow beam as rays with a Gaussian pattern: half of the power at half of its width.

The ray on the axis has the weight 1, one at the angle :math:`\theta` from it
:math:`2^{-(2 \theta / w)^2}` for a beam of the width w.
"""

from __future__ import annotations

import math

import numpy as np

from ..base.geometry import Array

RINGS = ((0.25, 6), (0.5, 12))
"""Radius of each ring in widths of the beam, and rays on it; one more is on the axis."""


def pencil(axes: Array, beside: Array, width: float) -> tuple[Array, Array]:
    """Return the rays of beams and their weights: (n, k, 3) and (k,).

    Args:
        axes: of the beams, unit vectors (n, 3).
        beside: a unit vector at right angles to each axis, (n, 3).
        width: of the beam, between its points of half power [rad]; 0: the ray on the axis alone.
    """
    angles = [(0.0, 0.0)]
    if width > 0.0:
        angles += [
            (share * width, 2.0 * math.pi * k / number)
            for share, number in RINGS
            for k in range(number)
        ]
    away, turn = np.array(angles).T[:, :, None]
    third = np.cross(axes, beside)
    around = np.cos(turn) * beside[:, None] + np.sin(turn) * third[:, None]
    rays: Array = np.cos(away) * axes[:, None] + np.sin(away) * around
    weights = [2.0 ** -((2.0 * angle / width) ** 2) if angle else 1.0 for angle, _ in angles]
    return rays, np.array(weights)
