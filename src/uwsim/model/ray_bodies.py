"""The visible surfaces of a scene for ray casting, grouped by body, with acoustic materials."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property

import numpy as np

from ..acoustics import MATERIALS, Material, MaterialName
from ..base.geometry import Array, Pose
from ..base.numerics.linear import determinant, product, transform_points
from ..bathymetry.height_grid import HeightGrid
from ..rays import RayScene, Surface
from ..scene.spec import SceneSpec
from .parts import Part
from .terrain import floor_materials, height_rays

Owner = tuple[int | None, str, int | None]
"""The vehicle index and the link of a body; or None, an empty text and the object index; or None,
the name of `segment_body` and None."""


class RayBodies:
    """The visible parts of a scene for ray casting, without ghosts (``<vr>``).

    The search tree of their triangles is built at the first access to `scene`.

    Args:
        scene: the spec of the scene.
        parts: the visible parts of the scene.
        fixed_poses: ``world_from_object`` of each object that never moves, by its index.
    """

    def __init__(
        self, scene: SceneSpec, parts: Sequence[Part], fixed_poses: Mapping[int, Pose]
    ) -> None:
        self._parts = [part for part in parts if not part.is_hidden and part.grid is None]
        self._charts: list[tuple[int, HeightGrid]] = []  # with the surface index of the class 0
        self._fixed_poses = fixed_poses
        names = {part.id: _material(scene, part) for part in parts if not part.is_hidden}
        owners = {
            p.id: p.name if p.vehicle is None else scene.vehicles[p.vehicle].name
            for p in self._parts
            if p.object is None
        }
        numbers = range(max(names, default=0) + 1)
        materials = [MATERIALS[names.get(number, "sand")] for number in numbers]
        part_ids = list(numbers)
        for part in parts:
            if part.grid is None or part.object is None:
                continue
            self._charts.append((len(materials), part.grid))
            floor = floor_materials(scene.objects[part.object])
            materials += [MATERIALS[name] for name in floor]
            part_ids += [part.id] * len(floor)
        self.materials: tuple[Material, ...] = tuple(materials)
        """The acoustic material of each surface, by the surface's index."""
        self.part_ids: tuple[int, ...] = tuple(part_ids)
        """The number of the part of each surface, by the surface's index."""
        self.vehicles = tuple(owners.get(number, "") for number in part_ids)
        """The name of the vehicle or tether of each surface, by its index; empty for an object."""

    @property
    def moving_owners(self) -> tuple[Owner, ...]:
        """The link or object of each moving body, in the order of the bodies in `scene`."""
        return tuple(self._moving_surfaces)

    @cached_property
    def scene(self) -> RayScene:
        """The charts, the fixed surfaces in W as the first body, each moving body in its frame."""
        fixed: list[Surface] = []
        for part in self._parts:
            world_from_object = None if part.object is None else self._fixed_poses.get(part.object)
            if world_from_object is not None:
                fixed += _surfaces(part, product(world_from_object.matrix, part.frame_from_mesh))
        grids = [height_rays(grid, number) for number, grid in self._charts]
        return RayScene([fixed, *self._moving_surfaces.values()], grids)

    @cached_property
    def _moving_surfaces(self) -> dict[Owner, list[Surface]]:
        surfaces: dict[Owner, list[Surface]] = {}
        for part in self._parts:
            if part.object not in self._fixed_poses:
                owner = part.vehicle, part.link, part.object
                surfaces.setdefault(owner, []).extend(_surfaces(part, part.frame_from_mesh))
        return surfaces


def _material(scene: SceneSpec, part: Part) -> MaterialName:
    if part.object is None:
        return "wood" if part.vehicle is None else "steel"  # a plastic sheath is as weak
    spec = scene.objects[part.object]
    return spec.acoustic_material or ("sand" if spec.is_ground else "steel")


def _surfaces(part: Part, frame: Array) -> list[Surface]:
    """Return the surfaces of a part.

    Args:
        part: the part.
        frame: the matrix that maps the mesh to the frame of the surfaces, (4, 4) [m]. If it is a
            reflection, the corners of the triangles are reversed.
    """
    surfaces = []
    for mesh in part.model.meshes:
        if mesh.opacity > 0.0:
            vertices = mesh.vertices.astype(np.float64)
            corners = transform_points(vertices, frame[:3, :3], frame[:3, 3])[mesh.triangles]
            if determinant(np.ascontiguousarray(frame[:3, :3])) < 0.0:
                corners = corners[:, ::-1]
            surfaces.append(Surface(part.id, corners, mesh.two_sided))
    return surfaces
