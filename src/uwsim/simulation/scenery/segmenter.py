"""Segmentation images, from the renderer or by ray casting."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from ...base.geometry import Intrinsics, Pose
from ...sensors.pinhole import cast_surfaces
from .scene_rays import SceneRays
from .scenery import Scenery


class SceneSegmenter:
    """The source of segmentation images (`uwsim.topics.interface.Segmenter`).

    Args:
        scenery: the rendering of the scene.
        rays: the ray casting against the scene.
        is_blind: True to cast rays instead of rendering.
    """

    def __init__(self, scenery: Scenery, rays: SceneRays, *, is_blind: bool) -> None:
        self._scenery, self._rays, self._is_blind = scenery, rays, is_blind

    @property
    def part_names(self) -> Mapping[int, str]:
        """The names of parts, ``vehicle/link`` or object, by segmentation ID."""
        return self._scenery.part_names

    def segmentation(
        self, world_from_camera: Pose, intrinsics: Intrinsics
    ) -> npt.NDArray[np.uint16]:
        """Return the number of the part that is visible at each pixel, (h, w); 0: none."""
        if self._is_blind:
            surfaces = cast_surfaces(self._rays, world_from_camera, intrinsics)
            return np.array(self._rays.part_ids, np.uint16)[surfaces]
        return self._scenery.segmentation(world_from_camera, intrinsics)
