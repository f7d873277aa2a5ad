"""Solid grounds: fixed objects below which a body gets only by passing through their surface.

They are:

- ``terrain``, whatever its shape;
- a sheet over a rectangle whose faces face up: the only other way below it is around its edge;
- a closed mesh, whose inside is solid.

They are not: meshes with holes, which a vehicle may enter; boxes, spheres, cylinders and hulls,
whose inside pushes bodies out.
"""

from __future__ import annotations

from collections.abc import Collection
from functools import cached_property, partial
from pathlib import Path

import numpy as np

from ...base.geometry import Array
from ...scene.spec import SceneSpec
from ..body_names import object_body
from ..terrain import height_grid
from .ground import MIN_UPWARD_PART, Ground
from .scene_shapes import fixed_box, fixed_faces
from .shapes import PLATE_THICKNESS, TRIMESHES

MIN_DISTANCE = 1e-5
"""The distance below which corners of a mesh count as equal [m]."""
MAX_AREA_ERROR = 1e-3
"""The greatest relative difference between the horizontal area of a sheet and its rectangle [1]."""


class SolidGround:
    """A fixed object that may be solid ground; its faces are read once a body comes near.

    Args:
        scene: the spec of the scene.
        index: the index of the object.
        data_path: the folders that are searched for files.
    """

    def __init__(self, scene: SceneSpec, index: int, data_path: tuple[Path, ...]) -> None:
        spec = scene.objects[index]
        self.name = spec.name
        """The name of the object."""
        self._is_terrain = spec.is_ground
        self._find_faces = partial(fixed_faces, scene, index, spec.solid, data_path)
        self._grid = height_grid(scene, spec, data_path)
        self._low, self._high = fixed_box(scene, index, spec.solid, data_path)  # in W [m]

    @property
    def has_edge(self) -> bool:
        """True if the ground is a sheet, below which a body can get around the edge."""
        return not self._is_terrain and self._is_sheet

    def is_above(self, point: Array) -> bool:
        """Return whether a point in W (3,) is above the surface, or within a plate's thickness."""
        if self._edge_distance(point) < 0.0:
            return False
        if float(point[2]) > float(self._high[2]):
            return True
        if self._ground is None:
            return False
        height = self._ground.height_at(point)
        return height is not None and float(point[2]) > height - PLATE_THICKNESS

    def path_length_around(self, start: Array, end: Array) -> float:
        """Compute the shortest horizontal path from one point to another around the edge [m].

        It is 0 if one of the points, (3,) in W [m], is outside the bounding box of the ground.
        """
        edges = self._edge_distance(start), self._edge_distance(end)
        return sum(edges) if min(edges) > 0.0 else 0.0

    def _edge_distance(self, point: Array) -> float:
        """Return the distance to the nearest side of the bounding box [m]; negative outside."""
        return float(np.minimum(point - self._low, self._high - point)[:2].min())

    def depth(self, points: Array) -> float:
        """Compute the depth of a body's highest point below the surface [m]; 0 if it is above.

        The result is also 0 up to the thickness of a plate, into which heavy bodies sink.

        Args:
            points: the corners of the body's bounding box in W, (n, 3) [m].
        """
        low, high = points.min(axis=0), points.max(axis=0)
        if (high[:2] < self._low[:2]).any() or (low[:2] > self._high[:2]).any():
            return 0.0
        if high[2] + PLATE_THICKNESS > self._high[2] or self._ground is None:
            return 0.0
        depth = np.inf
        for point in points:
            height = self._ground.height_at(point) if self._ground.covers(point) else None
            depth = min(depth, 0.0 if height is None else height - float(point[2]))
            if depth <= PLATE_THICKNESS:
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
        """The surface; None if a body can get below it in another way than through or around it."""
        if self._grid is not None:
            return Ground(np.zeros((0, 3, 3)), [self._grid])
        is_solid = self._is_terrain or self._is_sheet or is_closed(self._faces)
        return Ground(self._faces) if is_solid and len(self._faces) else None


def solid_grounds(
    scene: SceneSpec, contact_bodies: Collection[str], data_path: tuple[Path, ...]
) -> list[SolidGround]:
    """Return the objects of a scene that may be solid ground.

    Args:
        scene: the spec of the scene.
        contact_bodies: the names of the bodies that have collision shapes.
        data_path: the folders that are searched for files.
    """
    return [
        SolidGround(scene, i, data_path)
        for i, spec in enumerate(scene.objects)
        if not spec.solid.is_loose
        and object_body(i) in contact_bodies
        and (spec.is_ground or spec.solid.collision_shape_type in TRIMESHES)
    ]


def is_level_sheet(faces: Array) -> bool:
    """Return whether triangles (n, 3, 3) [m] all face up and cover a rectangle in x, y once."""
    normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    lengths = np.sqrt((normals * normals).sum(axis=1))
    has_area = lengths > 0.0
    if not has_area.any() or (normals[has_area, 2] <= MIN_UPWARD_PART * lengths[has_area]).any():
        return False
    extent = np.ptp(faces.reshape(-1, 3), axis=0)
    area = 0.5 * float(normals[:, 2].sum())
    return bool(abs(area - extent[0] * extent[1]) <= MAX_AREA_ERROR * area)


def is_closed(faces: Array) -> bool:
    """Return whether triangles (n, 3, 3) [m] are a closed surface that faces outwards."""
    corners = np.round(faces.reshape(-1, 3) / MIN_DISTANCE).astype(np.int64)
    _, numbers = np.unique(corners, axis=0, return_inverse=True)
    triangles = numbers.reshape(-1, 3)
    has_area = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
    triangles = triangles[has_area]
    starts, ends = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    n = int(numbers.max(initial=0)) + 1
    edges, reverse_edges = np.sort(starts * n + ends), np.sort(ends * n + starts)
    if not len(triangles) or not np.array_equal(edges, reverse_edges):
        return False
    a, b, c = (faces[:, k] - faces[0, 0] for k in range(3))
    return bool((a * np.cross(b, c)).sum() > 0.0)
