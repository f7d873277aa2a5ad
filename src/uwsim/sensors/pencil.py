r"""Weighted rays that represent a narrow beam with a Gaussian pattern.

In a beam with the width w at -3 dB, a ray at the angle :math:`\theta` from the axis has the weight
:math:`2^{-(2 \theta / w)^2}`: 1 on the axis, and one half at half of the width.
"""

from __future__ import annotations

import math

import numpy as np

from ..base.geometry import Array

RINGS = ((0.25, 6), (0.5, 12))
"""The radius of each ring of rays in beam widths, and its number of rays, besides the axis."""


def pencil_rays(axes: Array, normals: Array, width: float) -> tuple[Array, Array]:
    """Return the k rays of each of n beams (n, k, 3), and their weights (k,).

    Args:
        axes: the axes of the beams, unit vectors (n, 3).
        normals: a unit vector at right angles to each axis, (n, 3).
        width: the width of a beam at -3 dB [rad]; 0: the ray on the axis alone.
    """
    angles = [(0.0, 0.0)]
    if width > 0.0:
        angles += [
            (share * width, 2.0 * math.pi * k / number)
            for share, number in RINGS
            for k in range(number)
        ]
    tilt, azimuth = np.array(angles).T[:, :, None]
    binormals = np.cross(axes, normals)
    radial = np.cos(azimuth) * normals[:, None] + np.sin(azimuth) * binormals[:, None]
    rays: Array = np.cos(tilt) * axes[:, None] + np.sin(tilt) * radial
    weights = [2.0 ** -((2.0 * angle / width) ** 2) if angle else 1.0 for angle, _ in angles]
    return rays, np.array(weights)
