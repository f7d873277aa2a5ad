"""The fixed things of a scene that nothing can get below without passing through them.

- ``terrain``, whatever its shape;
- a sheet over a rectangle whose faces look up (a height field): one can get below it around its
  edge only;
- a closed mesh, whose inside is solid.

Not among them: meshes with holes, into which a vehicle may swim, and boxes, balls, cylinders and
hulls, which are solid through and through and push out what is in them.
"""

from __future__ import annotations

from collections.abc import Collection
from functools import cached_property, partial
from pathlib import Path

import numpy as np

from ...base.geometry import Array
from ...scene.spec import SceneSpec
from ..body_names import object_body
from .ground import STEEPEST, Ground
from .scene_shapes import standing_box, standing_faces
from .shapes import THICKNESS, TRIMESHES

SAME = 1e-5
"""Corners of a mesh at this distance are one [m]."""
RECTANGULAR = 1e-3
"""Share of its rectangle by which the area of a sheet, seen from above, may differ from it."""


class SolidGround:
    """A fixed thing that may be one of them; its faces are looked at when something is near.

    Args:
        scene: spec of the scene.
        index: number of the object.
        data_path: folders in which files are looked for.
    """

    def __init__(self, scene: SceneSpec, index: int, data_path: tuple[Path, ...]) -> None:
        thing = scene.objects[index]
        self.name = thing.name
        """Of the object."""
        self._is_terrain = thing.is_ground
        self._find_faces = partial(standing_faces, scene, index, thing.solid, data_path)
        self._low, self._high = standing_box(scene, index, thing.solid, data_path)  # in W [m]

    @property
    def has_edge(self) -> bool:
        """Whether it is a sheet around whose edge one can get below it."""
        return not self._is_terrain and self._is_sheet

    def is_above(self, point: Array) -> bool:
        """Whether a point, (3,) in W [m], is above its surface, or in it by less than a plate."""
        if self._inside(point) < 0.0:
            return False
        if float(point[2]) > float(self._high[2]):
            return True
        if self._ground is None:
            return False
        level = self._ground.level(point)
        return level is not None and float(point[2]) > level - THICKNESS

    def way_around(self, before: Array, now: Array) -> float:
        """Shortest way from a point (3,) to another around its edge, seen from above [m].

        0 where one of them lies outside of its box.
        """
        edges = self._inside(before), self._inside(now)
        return sum(edges) if min(edges) > 0.0 else 0.0

    def _inside(self, point: Array) -> float:
        """Distance of a point from the edge of its box, seen from above [m]; < 0 outside."""
        return float(np.minimum(point - self._low, self._high - point)[:2].min())

    def depth(self, points: Array) -> float:
        """How deep all of a body is below the surface [m]; 0 where it is not wholly below it.

        By more than a plate: what is heavy rests in it.

        Args:
            points: around the body in W, (n, 3) [m].
        """
        low, high = points.min(axis=0), points.max(axis=0)
        if (high[:2] < self._low[:2]).any() or (low[:2] > self._high[:2]).any():
            return 0.0
        if high[2] + THICKNESS > self._high[2] or self._ground is None:
            return 0.0
        depth = np.inf
        for point in points:
            level = self._ground.level(point) if self._ground.covers(point) else None
            depth = min(depth, 0.0 if level is None else level - float(point[2]))
            if depth <= THICKNESS:
                return 0.0
        return float(depth)

    @cached_property
    def _faces(self) -> Array:
        return self._find_faces()

    @cached_property
    def _is_sheet(self) -> bool:
        return is_level_sheet(self._faces)

    @cached_property
    def _ground(self) -> Ground | None:
        """Its faces; None where one can get below it without passing through it."""
        is_solid = self._is_terrain or self._is_sheet or is_closed(self._faces)
        return Ground(self._faces) if is_solid and len(self._faces) else None


def solid_grounds(
    scene: SceneSpec, touched: Collection[str], data_path: tuple[Path, ...]
) -> list[SolidGround]:
    """Find what may be solid ground in a scene.

    Args:
        scene: spec of the scene.
        touched: names of the bodies that have collision shapes.
        data_path: folders in which files are looked for.
    """
    return [
        SolidGround(scene, i, data_path)
        for i, thing in enumerate(scene.objects)
        if not thing.solid.is_loose
        and object_body(i) in touched
        and (thing.is_ground or thing.solid.collision_shape_type in TRIMESHES)
    ]


def is_level_sheet(faces: Array) -> bool:
    """Whether triangles, (n, 3, 3) [m], look up and cover a rectangle of x and y once."""
    normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    lengths = np.sqrt((normals * normals).sum(axis=1))
    has_area = lengths > 0.0
    if not has_area.any() or (normals[has_area, 2] <= STEEPEST * lengths[has_area]).any():
        return False
    extent = np.ptp(faces.reshape(-1, 3), axis=0)
    area = 0.5 * float(normals[:, 2].sum())
    return bool(abs(area - extent[0] * extent[1]) <= RECTANGULAR * area)


def is_closed(faces: Array) -> bool:
    """Whether triangles, (n, 3, 3) [m], are the whole surface of a body, seen from outside."""
    corners = np.round(faces.reshape(-1, 3) / SAME).astype(np.int64)
    _, numbers = np.unique(corners, axis=0, return_inverse=True)
    triangles = numbers.reshape(-1, 3)
    has_area = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
    triangles = triangles[has_area]
    begins, ends = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    n = int(numbers.max(initial=0)) + 1
    there, back = np.sort(begins * n + ends), np.sort(ends * n + begins)
    if not len(triangles) or not np.array_equal(there, back):
        return False
    a, b, c = (faces[:, k] - faces[0, 0] for k in range(3))
    return bool((a * np.cross(b, c)).sum() > 0.0)
