"""Ray casting against the visible models of a scene, with their acoustic materials."""

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
from .sand import Heap


class SceneRays:
    """Rays against the models of a scene (`uwsim.world.Rays`); ghosts (``vr``) are not met.

    The triangles of a scene are sorted when the first ray is cast.

    Args:
        model: of the scene.
        engine: where everything is.
        heaps: the sand over buried objects.
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
        self._carried: list[int] = []  # when it was seen last which bodies are to be placed
        self._placed: list[tuple[int, Callable[[], Array]]] = []
        self.materials: tuple[Material, ...] = (
            *self._bodies.materials,
            *(MATERIALS["sand"] for _ in heaps),
        )
        """Of each surface, by its number."""
        self.vehicles: tuple[str, ...] = (*self._bodies.vehicles, *("" for _ in heaps))
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
        scene, poses = self._scene, self._engine.poses
        poses.refresh()
        if self._carried != list(poses.state.carried):
            self._carried = list(poses.state.carried)
            scene.let_follow(self._followed())
        for body, frame in self._placed:
            scene.place(body, frame())

    def _sand(self, number: int, heap: Heap) -> RayScene:
        """The triangles of a heap as it is now."""
        if (known := self._cast_heaps.get(number)) is None or known[0] != heap.version:
            mesh = heap.mesh()
            triangles = mesh.vertices.astype(np.float64)[mesh.triangles]
            surface = len(self.materials) - len(self._heaps) + number
            known = heap.version, RayScene([[Surface(surface, triangles)]])
            self._cast_heaps[number] = known
        return known[1]

    def _followed(self) -> npt.NDArray[np.int32]:
        """The engine's body that each body is where it is, or below 0; the first is what is fixed.

        The others are noted as those that are to be placed.
        """
        poses = self._engine.poses
        movers = self._bodies.movers
        found = np.array([-1, *(poses.engine_body(*each) for each in movers)], np.int32)
        self._placed = [
            (number, self._frame(*owner))
            for number, owner in enumerate(movers, start=1)
            if found[number] < 0
        ]
        return found

    @cached_property
    def _scene(self) -> RayScene:
        """Fixed bodies as the first body, then all that move."""
        poses = self._engine.poses
        return self._bodies.scene.following(self._followed(), poses.origins, poses.axes)

    def _frame(self, vehicle: int | None, link: str, thing: int | None) -> Callable[[], Array]:
        """The present pose of a link or an object, (4, 4) [m]."""
        engine = self._engine
        if vehicle is not None:
            return lambda: engine.poses.link_frame(vehicle, link)
        assert thing is not None
        return lambda: engine.poses.object(thing).matrix
