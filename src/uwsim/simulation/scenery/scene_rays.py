"""Ray casting against the visible surfaces of a scene, with their acoustic materials."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ...acoustics import MATERIALS, Material
from ...base.geometry import Array, Pose
from ...model.scene_model import SceneModel
from ...physics.engine import Engine
from ...rays import Balls, Hits, RayScene, Surface
from ...rays.ray_scene import cast
from ...rays.scene_record import SCENE, rays_record
from .sand import Heap


class SceneRays:
    """The ray casting against the surfaces of a scene (`uwsim.world.Rays`).

    Rays pass through ghosts, the vehicles with ``<vr>`` 1.

    Args:
        model: the compiled scene.
        engine: the engine, which stores the poses.
        heaps: the heaps of sand.
    """

    def __init__(
        self,
        model: SceneModel,
        engine: Engine,
        heaps: Sequence[Heap] = (),
    ) -> None:
        self._bodies, self._heaps = model.ray_bodies, tuple(heaps)
        self._engine = engine
        self._cast_heaps: dict[int, tuple[int, RayScene]] = {}
        self._carried_objects: list[int] | None = None  # for which `_ray_scene` is valid
        self._ray_scene: RayScene | None = (
            None  # fixed bodies as the first body, then all that move
        )
        self._placed_bodies: list[
            tuple[int, Callable[[], Array]]
        ] = []  # those without a body of the engine
        self._recorded_scene: RayScene | None = None  # the scene of the first record
        self._records = np.zeros(1 + len(heaps), SCENE)  # of `_ray_scene`, and of each heap
        self.materials: tuple[Material, ...] = (
            *self._bodies.materials,
            *(MATERIALS["sand"] for _ in heaps),
        )
        """The acoustic material of each surface, by the surface's index."""
        first_heap_id = max(self._bodies.part_ids) + 1
        self.part_ids: tuple[int, ...] = (
            *self._bodies.part_ids,
            *(first_heap_id + index for index in range(len(heaps))),
        )
        """The number in segmentation images of each surface, by the surface's index."""
        self.vehicles: tuple[str, ...] = (*self._bodies.vehicles, *("" for _ in heaps))
        """The name of the vehicle or tether of each surface, by its index; empty for none."""

    @cached_property
    def functions(self) -> npt.NDArray[np.void]:
        """The scene for compiled ray casting, a record of `uwsim.rays.scene_record.RAYS`, (1,)."""
        return rays_record(self._records, self._bodies.scene.grid_records)

    def cast(
        self,
        world_from_sensor: Pose,
        directions: Array,
        reach: float,
        starts: Array | None = None,
    ) -> Hits:
        """Cast rays from a sensor at the present poses of the scene; see `RayScene.cast`."""
        self.prepare()
        return cast(self.functions, world_from_sensor, directions, reach, starts)

    @property
    def is_compiled(self) -> bool:
        """True if rays read up-to-date poses in compiled steps without a call of `prepare`.

        This is so if all surfaces move with bodies of the engine. It is not so with sand, or with
        objects that Python places or that a vehicle carries.
        """
        return (
            self._ray_scene is not None
            and not self._heaps
            and not self._placed_bodies
            and not self._engine.poses.state.carriers
        )

    def prepare(self) -> None:
        """Update the records that compiled code reads."""
        scene = self._scene
        if self._recorded_scene is not scene:
            self._records[0], self._recorded_scene = scene.record[0], scene
        for index, heap in enumerate(self._heaps, start=1):
            self._records[index] = self._sand_scene(index - 1, heap).record[0]

    def balls(self) -> Balls:
        """Return balls that cover each surface without the heaps of sand; see `RayScene.balls`."""
        return self._scene.balls()

    @property
    def _scene(self) -> RayScene:
        """The bodies of the scene at their present poses."""
        poses, carried_objects = self._engine.poses, list(self._engine.poses.state.carriers)
        poses.refresh()
        if self._ray_scene is None or self._carried_objects != carried_objects:
            owners = self._bodies.moving_owners
            engine = np.array([-1, *(poses.engine_body(*owner) for owner in owners)], np.int32)
            self._ray_scene = self._bodies.scene.with_engine(engine, poses.origins, poses.axes)
            self._carried_objects = carried_objects
            self._placed_bodies = [
                (body_index, self._frame(*owner))
                for body_index, owner in enumerate(owners, start=1)
                if engine[body_index] < 0
            ]
        for body, frame in self._placed_bodies:
            self._ray_scene.place(body, frame())
        return self._ray_scene

    def _sand_scene(self, index: int, heap: Heap) -> RayScene:
        if (entry := self._cast_heaps.get(index)) is None or entry[0] != heap.version:
            mesh = heap.mesh()
            triangles = mesh.vertices.astype(np.float64)[mesh.triangles]
            surface = len(self.materials) - len(self._heaps) + index
            entry = heap.version, RayScene([[Surface(surface, triangles)]])
            self._cast_heaps[index] = entry
        return entry[1]

    def _frame(
        self, vehicle: int | None, link: str, object_index: int | None
    ) -> Callable[[], Array]:
        """Return a function that returns the present pose of a link or object in W, (4, 4) [m]."""
        engine = self._engine
        if vehicle is not None:
            return lambda: engine.poses.link_frame(vehicle, link)
        assert object_index is not None
        return lambda: engine.poses.object(object_index).matrix
