"""Oriented bounding boxes of the links and objects of a scene."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.linear import cross, dot, length, product
from ...model.parts import Part
from ...world import Box
from ..scenery.scenery import Scenery


@dataclass(frozen=True, eq=False)
class OrientedBox:
    """A bounding box of a link or an object, with the axes of its first mesh."""

    pose: Pose
    """The pose of the box in the requested frame: its centre and its axes."""
    size: Array
    """The lengths of the edges along the axes of the box, (3,) [m]."""

    @property
    def corners(self) -> Array:
        """The corners in the requested frame, (8, 3) [m]; x varies fastest, z slowest."""
        half = 0.5 * self.size
        return self.pose.transform(Box(tuple(-half), tuple(half)).corners())


def oriented_boxes(scenery: Scenery, frame_from_world: Pose) -> dict[str, OrientedBox]:
    """Return the boxes of all links and objects in a frame, by their names in segmentation images.

    All parts of one link or object share a box with the axes of the first part. Sand over buried
    objects has no box.
    """
    groups: dict[str, list[Part]] = {}
    names = scenery.part_names
    for part in scenery.parts:
        groups.setdefault(names[part.id], []).append(part)
    boxes = {name: _box(scenery, parts) for name, parts in groups.items()}
    return {name: OrientedBox(frame_from_world @ box.pose, box.size) for name, box in boxes.items()}


def _box(scenery: Scenery, parts: list[Part]) -> OrientedBox:
    """Return the box in W around the parts of one link or object."""
    x, y, _ = scenery.world_from_mesh(parts[0])[:3, :3].T  # the columns, which include the scale
    x = x / length(x)
    y = y - dot(x, y) * x
    y = y / length(y)
    rotation = np.stack([x, y, cross(x, y)], axis=1)
    corners = np.concatenate([scenery.corners(part) for part in parts])  # (8 n, 3) [m]
    coordinates = product(corners, rotation)
    low, high = coordinates.min(axis=0), coordinates.max(axis=0)
    centre = product(0.5 * (low + high), rotation.T)
    return OrientedBox(Pose(centre, rotation), high - low)
