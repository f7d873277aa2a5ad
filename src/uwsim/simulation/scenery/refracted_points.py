"""Where a camera above level water sees points below it."""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array
from ...rendering.physical.daylight_field import REFRACTIVE_INDEX

N_HALVINGS = 48
"""The number of halvings of the interval that contains the point of refraction."""


def refract_points(eye: Array, points: Array, surface_height: float) -> Array:
    r"""Return points that a pinhole without refraction would see where ``eye`` sees ``points``.

    The ray from the eye at the height :math:`h` meets the level surface at the horizontal distance
    :math:`r` and the point at the depth :math:`d` and the distance :math:`R`, where
    :math:`r / \sqrt{r^2 + h^2} = n (R - r) / \sqrt{(R - r)^2 + d^2}` (Snell). Each point below the
    surface is moved onto the straight continuation of its ray in air, at its distance from the eye.
    Points above the surface, and all points for an eye below it, are returned unchanged. Waves are
    not modelled.

    Args:
        eye: the position of the camera in W, (3,) [m].
        points: points in W, (n, 3) [m].
        surface_height: the height of the still surface in W [m].
    """
    height = float(eye[2]) - surface_height
    depths = surface_height - points[:, 2]
    if height <= 0.0:
        return points
    offsets = points - eye
    ranges = np.sqrt(offsets[:, 0] ** 2 + offsets[:, 1] ** 2)
    lower, upper = np.zeros_like(ranges), ranges.copy()
    depths_below = np.maximum(depths, 0.0)
    for _ in range(N_HALVINGS):
        middle = 0.5 * (lower + upper)
        remainder = ranges - middle
        is_before = middle * np.sqrt(remainder**2 + depths_below**2) < REFRACTIVE_INDEX * (
            remainder * np.sqrt(middle**2 + height**2)
        )
        lower, upper = np.where(is_before, middle, lower), np.where(is_before, upper, middle)
    shares = np.divide(upper, ranges, out=np.ones_like(ranges), where=ranges > 0.0)
    directions = np.stack(
        [offsets[:, 0] * shares, offsets[:, 1] * shares, np.full_like(ranges, -height)], axis=1
    )
    distances = np.sqrt((offsets**2).sum(axis=1))
    scales = distances / np.sqrt((directions**2).sum(axis=1))
    apparent_points = eye + directions * scales[:, None]
    refracted_points: Array = np.where(depths[:, None] > 0.0, apparent_points, points)
    return refracted_points
