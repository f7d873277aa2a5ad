"""The extent of a vehicle: the bounding boxes of its links, in the frame of its base."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import length
from ...scene.urdf.kinematics import link_poses
from ..resolved_scene import ResolvedScene
from .ground import triangles_of
from .scene_shapes import collision_shapes


@dataclass(frozen=True, eq=False)
class LinkBox:
    """The bounding box of a link."""

    low: Array
    """The lower corner in the base's frame, (3,) [m]."""
    high: Array
    """The upper corner in the base's frame, (3,) [m]."""
    volume: float
    """The total volume of the boxes of the link's shapes; overlaps count twice [m3]."""

    @property
    def extent(self) -> Array:
        """The extent along x, y, z of the base, (3,) [m]."""
        return self.high - self.low


@dataclass(frozen=True, eq=False)
class Hull:
    """The bounding boxes of the links of a vehicle that have a shape; at least one."""

    links: Mapping[str, LinkBox]
    """The bounding box of each link, by the link's name."""

    @property
    def low(self) -> Array:
        """The lower corner of the whole bounding box in the base's frame, (3,) [m]."""
        low: Array = np.min([box.low for box in self.links.values()], axis=0)
        return low

    @property
    def high(self) -> Array:
        """The upper corner of the whole bounding box in the base's frame, (3,) [m]."""
        high: Array = np.max([box.high for box in self.links.values()], axis=0)
        return high

    @property
    def size(self) -> float:
        """The longest edge of the whole bounding box [m]."""
        return float((self.high - self.low).max())

    @property
    def volume(self) -> float:
        """The total volume of the boxes of all links [m3]."""
        return sum(box.volume for box in self.links.values())

    def distance(self, point: Array) -> float:
        """Compute the distance of a point in the base's frame, (3,), from the whole box [m]."""
        offset = np.maximum(np.maximum(self.low - point, point - self.high), 0.0)
        return float(length(offset))


def hull_of(scene: ResolvedScene, index: int) -> Hull | None:
    """Return the extent of a vehicle at the joint values of the scene file; None without shapes.

    Args:
        scene: the scene with its robots.
        index: the index of the vehicle.

    Raises:
        UwsimError: a mesh cannot be read.
    """
    poses = link_poses(scene.robots[index], scene.scene.vehicles[index].joint_values)
    links: dict[str, LinkBox] = {}
    for name, shapes in collision_shapes(scene, [index], {}).items():
        link = name.split("/", 2)[2]
        corners = triangles_of(shapes, poses[link]).reshape(-1, 3)  # in the base's frame
        volume = sum(8.0 * float(np.prod(shape.size)) for shape in shapes)
        links[link] = LinkBox(corners.min(axis=0), corners.max(axis=0), volume)
    return Hull(links) if links else None
