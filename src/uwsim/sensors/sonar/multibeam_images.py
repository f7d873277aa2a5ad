"""The original's multibeam, made of depth images: the compatibility quirk ``multibeam-images``.

A fan is seen by cameras side by side, each one pixel wide. What is nearer to a camera than `NEAR`
is cut away. The depth at a beam is interpolated between the two pixels next to it, linearly in the
angle, and divided by the cosine of the angle to the middle of the camera.
"""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.elementwise import arctan
from ...world import Rays

NEAR = 0.8
"""Near plane of the cameras [m]."""
FAR = 1.2
"""Far plane of the cameras, in ranges of the sensor [1]."""


class DepthImages:
    """The cameras of a fan of beams.

    Args:
        angles: of the beams, (n,) [rad].
        step: between beams [rad].
        widest: a camera sees no more than that [rad].
        reach: range of the sensor [m].
    """

    def __init__(self, angles: Array, step: float, widest: float, reach: float) -> None:
        first, last = float(angles.min()), float(angles.max())
        n_cameras = int((last - first) / (widest + 1e-9) + 1)
        field = (last - first) / n_cameras
        n_pixels = int(field / abs(step) + 1e-9) + 1
        self._far = FAR * reach
        rise = (2.0 * np.arange(n_pixels, dtype=np.float64) + 1.0) / n_pixels - 1.0
        self._pixels = arctan(rise * math.tan(0.5 * field))  # (m,) [rad], from the middle
        middles = first + field * (np.arange(n_cameras, dtype=np.float64) + 0.5)
        seen = (middles[:, None] + self._pixels).reshape(-1)
        self._rays = np.stack([np.zeros(len(seen)), np.sin(seen), -np.cos(seen)], axis=1)
        self._cosines = np.tile(np.cos(self._pixels), n_cameras)
        places = (angles - first) / field if field > 0.0 else np.zeros(len(angles))
        self._cameras = np.minimum(places.astype(np.intp), n_cameras - 1)
        self._off = angles - middles[self._cameras]

    def ranges(self, rays: Rays, world_from_sensor: Pose) -> Array:
        """Distances that the beams have by these images, (n,) [m]."""
        reach = self._far / float(self._cosines.min())
        hits = rays.cast(world_from_sensor, self._rays, reach, NEAR / self._cosines)
        depths = np.minimum(hits.distance * self._cosines, self._far)
        images = depths.reshape(-1, len(self._pixels))
        found = np.empty(len(self._off))
        for camera, image in enumerate(images):
            own = self._cameras == camera
            found[own] = np.interp(self._off[own], self._pixels, image)
        distances: Array = found / np.cos(self._off)
        return distances
