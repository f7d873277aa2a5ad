"""Ray casting against the visible models of a scene, with their acoustic materials."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property

import numpy as np

from ...acoustics import MATERIALS, Material, MaterialName
from ...base.geometry import Array, Pose
from ...base.numerics.linear import determinant, placed, product
from ...model.parts import Part
from ...model.scene_model import SceneModel
from ...physics.engine import Engine
from ...rays import Balls, Hits, RayScene, Surface
from ...scene.spec import SceneSpec
from .sand import Heap


class SceneRays:
    """Rays against the models of a scene (`uwsim.world.Rays`); ghosts (``vr``) are not met.

    The triangles of a scene are sorted when the first ray is cast.

    Args:
        model: of the scene.
        state: where everything is.
        heaps: the sand over buried objects.
    """

    def __init__(
        self,
        model: SceneModel,
        state: Engine,
        heaps: Sequence[Heap] = (),
    ) -> None:
        scene = model.scene
        self._state, self._heaps = state, tuple(heaps)
        self._cast_heaps: dict[int, tuple[int, RayScene]] = {}
        self._parts = tuple(part for part in model.parts if not part.is_hidden)
        names = {part.id: _material(scene, part) for part in self._parts}
        numbers = range(max(names, default=0) + 1)
        self.materials: tuple[Material, ...] = tuple(
            MATERIALS[names.get(number, "sand")] for number in (*numbers, *heaps)
        )
        """Of each surface, by its number."""
        owners = {
            p.id: scene.vehicles[p.vehicle].name for p in self._parts if p.vehicle is not None
        }
        self.vehicles: tuple[str, ...] = (
            *(owners.get(number, "") for number in numbers),
            *("" for _ in heaps),
        )
        """Name of the vehicle that each surface belongs to, by its number; or empty."""

    def cast(
        self,
        world_from_sensor: Pose,
        directions: Array,
        reach: float,
        begins: Array | None = None,
    ) -> Hits:
        """Cast rays from the origin of a sensor; see `RayScene.cast`."""
        self._place()
        hits = self._scene.cast(world_from_sensor, directions, reach, begins)
        for number, heap in enumerate(self._heaps):
            on_sand = self._sand(number, heap).cast(world_from_sensor, directions, reach, begins)
            nearer = on_sand.distance < hits.distance
            hits.distance[nearer] = on_sand.distance[nearer]
            hits.normal[nearer] = on_sand.normal[nearer]
            hits.surface[nearer] = on_sand.surface[nearer]
        return hits

    def balls(self) -> Balls:
        """Balls that cover each surface, but for the sand of heaps; see `RayScene.balls`."""
        self._place()
        return self._scene.balls()

    def _place(self) -> None:
        """Put all bodies where they are now."""
        for body, frame in enumerate(self._frames):
            self._scene.place(body + 1, frame())

    def _sand(self, number: int, heap: Heap) -> RayScene:
        """The triangles of a heap as it is now."""
        if (known := self._cast_heaps.get(number)) is None or known[0] != heap.version:
            mesh = heap.mesh()
            triangles = mesh.vertices.astype(np.float64)[mesh.triangles]
            surface = len(self.materials) - len(self._heaps) + number
            known = heap.version, RayScene([[Surface(surface, triangles)]])
            self._cast_heaps[number] = known
        return known[1]

    @cached_property
    def _frames(self) -> tuple[Callable[[], Array], ...]:
        """Where each body that moves is; in the order of `_scene`."""
        return tuple(frame for frame, _ in self._moving)

    @cached_property
    def _moving(self) -> list[tuple[Callable[[], Array], list[Surface]]]:
        """Links, and objects that move, with their surfaces."""
        bodies: dict[tuple[int | None, str, int | None], list[Surface]] = {}
        for part in self._parts:
            if not self._is_fixed(part):
                whose = part.vehicle, part.link, part.object
                bodies.setdefault(whose, []).extend(_surfaces(part, part.frame_from_mesh))
        return [(self._frame(*whose), surfaces) for whose, surfaces in bodies.items()]

    @cached_property
    def _scene(self) -> RayScene:
        """Fixed bodies as the first body, then all that move."""
        fixed: list[Surface] = []
        for part in self._parts:
            if self._is_fixed(part):
                frame = self._frame(part.vehicle, part.link, part.object)()
                fixed += _surfaces(part, product(frame, part.frame_from_mesh))
        return RayScene([fixed, *(surfaces for _, surfaces in self._moving)])

    def _is_fixed(self, part: Part) -> bool:
        return part.object is not None and self._state.poses.is_fixed(part.object)

    def _frame(self, vehicle: int | None, link: str, thing: int | None) -> Callable[[], Array]:
        """The present pose of a link or an object, (4, 4) [m]."""
        state = self._state
        if vehicle is not None:
            return lambda: state.poses.link_frame(vehicle, link)
        assert thing is not None
        return lambda: state.poses.object(thing).matrix


def _material(scene: SceneSpec, part: Part) -> MaterialName:
    """The acoustic material of a part."""
    if part.object is None:
        return "steel"
    thing = scene.objects[part.object]
    return thing.acoustic_material or ("sand" if thing.is_ground else "steel")


def _surfaces(part: Part, frame: Array) -> list[Surface]:
    """The triangles of a part in a frame; a mirror turns them round."""
    found = []
    for mesh in part.model.meshes:
        if mesh.opacity > 0.0:
            vertices = mesh.vertices.astype(np.float64)
            corners = placed(vertices, frame[:3, :3], frame[:3, 3])[mesh.triangles]
            if determinant(np.ascontiguousarray(frame[:3, :3])) < 0.0:
                corners = corners[:, ::-1]
            found.append(Surface(part.id, corners, mesh.two_sided))
    return found
