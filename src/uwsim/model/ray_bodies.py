"""The bodies of a scene that rays meet, with their surfaces and acoustic materials."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property

import numpy as np

from ..acoustics import MATERIALS, Material, MaterialName
from ..base.geometry import Array, Pose
from ..base.numerics.linear import determinant, product, transform_points
from ..rays import RayScene, Surface
from ..scene.spec import SceneSpec
from .parts import Part

Owner = tuple[int | None, str, int | None]
"""The number of a vehicle and its link, or the number of an object."""


class RayBodies:
    """The visible models of a scene for ray casting, without ghosts (``vr``).

    Their triangles are sorted at the first access to `scene` or `movers`.

    Args:
        scene: the spec of the scene.
        parts: the models of the scene.
        fixed_places: ``world_from_object`` of each object that never moves, by its number.
    """

    def __init__(
        self, scene: SceneSpec, parts: Sequence[Part], fixed_places: Mapping[int, Pose]
    ) -> None:
        self._parts = [part for part in parts if not part.is_hidden]
        self._fixed_places = fixed_places
        names = {part.id: _material(scene, part) for part in self._parts}
        owners = {
            p.id: scene.vehicles[p.vehicle].name for p in self._parts if p.vehicle is not None
        }
        numbers = range(max(names, default=0) + 1)
        self.materials: tuple[Material, ...] = tuple(
            MATERIALS[names.get(number, "sand")] for number in numbers
        )
        """The material of each surface, by its number."""
        self.vehicles = tuple(owners.get(number, "") for number in numbers)
        """The name of the vehicle of each surface, by its number; empty for an object."""

    @property
    def movers(self) -> tuple[Owner, ...]:
        """The owner of each moving body."""
        return tuple(self._moving_surfaces)

    @cached_property
    def scene(self) -> RayScene:
        """The fixed surfaces as the first body, then those of `movers`; all in the place of W."""
        fixed: list[Surface] = []
        for part in self._parts:
            place = None if part.object is None else self._fixed_places.get(part.object)
            if place is not None:
                fixed += _surfaces(part, product(place.matrix, part.frame_from_mesh))
        return RayScene([fixed, *self._moving_surfaces.values()])

    @cached_property
    def _moving_surfaces(self) -> dict[Owner, list[Surface]]:
        surfaces: dict[Owner, list[Surface]] = {}
        for part in self._parts:
            if part.object not in self._fixed_places:
                owner = part.vehicle, part.link, part.object
                surfaces.setdefault(owner, []).extend(_surfaces(part, part.frame_from_mesh))
        return surfaces


def _material(scene: SceneSpec, part: Part) -> MaterialName:
    if part.object is None:
        return "steel"
    spec = scene.objects[part.object]
    return spec.acoustic_material or ("sand" if spec.is_ground else "steel")


def _surfaces(part: Part, frame: Array) -> list[Surface]:
    """Return the triangles of a part in a frame; a reflection reverses their orientation."""
    surfaces = []
    for mesh in part.model.meshes:
        if mesh.opacity > 0.0:
            vertices = mesh.vertices.astype(np.float64)
            corners = transform_points(vertices, frame[:3, :3], frame[:3, 3])[mesh.triangles]
            if determinant(np.ascontiguousarray(frame[:3, :3])) < 0.0:
                corners = corners[:, ::-1]
            surfaces.append(Surface(part.id, corners, mesh.two_sided))
    return surfaces
