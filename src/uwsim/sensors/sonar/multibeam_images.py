"""Multibeam ranges from depth images, as in the original UWSim (``multibeam-images``).

Adjacent cameras, whose images are one pixel wide, cover the fan. Surfaces nearer than `NEAR` are
clipped. The depth at a beam is interpolated between the two pixels next to it, linearly in the
angle, and divided by the cosine of the angle to the middle of the camera.
"""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.elementwise import arctan
from ...world import Rays

NEAR = 0.8
"""The near plane of the cameras [m]."""
FAR = 1.2
"""The far plane of the cameras, as a multiple of the sensor's range [1]."""


class DepthImages:
    """The depth cameras that cover a fan of beams.

    Args:
        angles: the angles of the beams, (n,) [rad].
        step: the angle between beams [rad].
        max_field: the largest field of view of a camera [rad].
        reach: the greatest range of the sensor [m].
    """

    def __init__(self, angles: Array, step: float, max_field: float, reach: float) -> None:
        min_angle, max_angle = float(angles.min()), float(angles.max())
        n_cameras = int((max_angle - min_angle) / (max_field + 1e-9) + 1)
        field = (max_angle - min_angle) / n_cameras
        n_pixels = int(field / abs(step) + 1e-9) + 1
        self._far = FAR * reach
        positions = (2.0 * np.arange(n_pixels, dtype=np.float64) + 1.0) / n_pixels - 1.0
        self._pixels = arctan(positions * math.tan(0.5 * field))  # (m,) [rad], from the middle
        middles = min_angle + field * (np.arange(n_cameras, dtype=np.float64) + 0.5)
        pixel_angles = (middles[:, None] + self._pixels).reshape(-1)
        self._rays = np.stack(
            [np.zeros(len(pixel_angles)), np.sin(pixel_angles), -np.cos(pixel_angles)], axis=1
        )
        self._cosines = np.tile(np.cos(self._pixels), n_cameras)
        positions = (angles - min_angle) / field if field > 0.0 else np.zeros(len(angles))
        self._cameras = np.minimum(positions.astype(np.intp), n_cameras - 1)
        self._offsets = angles - middles[self._cameras]

    def ranges(self, rays: Rays, world_from_sensor: Pose) -> Array:
        """Return the ranges of the beams from the images at a pose, (n,) [m]."""
        reach = self._far / float(self._cosines.min())
        hits = rays.cast(world_from_sensor, self._rays, reach, NEAR / self._cosines)
        depths = np.minimum(hits.distance * self._cosines, self._far)
        images = depths.reshape(-1, len(self._pixels))
        beam_depths = np.empty(len(self._offsets))
        for camera, image in enumerate(images):
            beams = self._cameras == camera
            beam_depths[beams] = np.interp(self._offsets[beams], self._pixels, image)
        distances: Array = beam_depths / np.cos(self._offsets)
        return distances
