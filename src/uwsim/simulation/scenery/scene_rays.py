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
from ...rays.ray_scene import cast
from ...rays.scene_record import SCENE, rays_record
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
        self._carried: list[int] | None = None  # the objects that followed links when it was laid
        self._laid: RayScene | None = None  # fixed bodies as the first body, then all that move
        self._placed: list[tuple[int, Callable[[], Array]]] = []  # those that follow no engine's
        self._noted: RayScene | None = None  # whose record is the first of these
        self._records = np.zeros(1 + len(heaps), SCENE)  # of what was laid, and of each heap
        self.materials: tuple[Material, ...] = (
            *self._bodies.materials,
            *(MATERIALS["sand"] for _ in heaps),
        )
        """Of each surface, by its number."""
        self.vehicles: tuple[str, ...] = (*self._bodies.vehicles, *("" for _ in heaps))
        """Name of the vehicle that each surface belongs to, by its number; or empty."""

    @cached_property
    def functions(self) -> npt.NDArray[np.void]:
        """What casts rays from compiled code, a record of `uwsim.rays.scene_record.RAYS`, (1,)."""
        return rays_record(self._records)

    def cast(
        self,
        world_from_sensor: Pose,
        directions: Array,
        reach: float,
        begins: Array | None = None,
    ) -> Hits:
        """Cast rays from the origin of a sensor; see `RayScene.cast`."""
        self.prepare()
        return cast(self.functions, world_from_sensor, directions, reach, begins)

    @property
    def is_compiled(self) -> bool:
        """Whether compiled code finds everything where it is in compiled steps without `prepare`.

        It does where all follow bodies of the engine; sand, and what is placed or carried, do not.
        """
        return (
            self._laid is not None
            and not self._heaps
            and not self._placed
            and not self._engine.poses.state.carriers
        )

    def prepare(self) -> None:
        """Bring what compiled code reads up to date."""
        laid = self._scene
        if self._noted is not laid:
            self._records[0], self._noted = laid.record[0], laid
        for number, heap in enumerate(self._heaps, start=1):
            self._records[number] = self._sand(number - 1, heap).record[0]

    def balls(self) -> Balls:
        """Balls that cover each surface, but for the sand of heaps; see `RayScene.balls`."""
        return self._scene.balls()

    @property
    def _scene(self) -> RayScene:
        """The bodies of the scene, where they are now."""
        poses, carried = self._engine.poses, list(self._engine.poses.state.carriers)
        poses.refresh()
        if self._laid is None or self._carried != carried:
            movers = self._bodies.movers
            engine = np.array([-1, *(poses.engine_body(*each) for each in movers)], np.int32)
            self._laid = self._bodies.scene.with_engine(engine, poses.origins, poses.axes)
            self._carried = carried
            self._placed = [
                (number, self._frame(*owner))
                for number, owner in enumerate(movers, start=1)
                if engine[number] < 0
            ]
        for body, frame in self._placed:
            self._laid.place(body, frame())
        return self._laid

    def _sand(self, number: int, heap: Heap) -> RayScene:
        """The triangles of a heap as it is now."""
        if (known := self._cast_heaps.get(number)) is None or known[0] != heap.version:
            mesh = heap.mesh()
            triangles = mesh.vertices.astype(np.float64)[mesh.triangles]
            surface = len(self.materials) - len(self._heaps) + number
            known = heap.version, RayScene([[Surface(surface, triangles)]])
            self._cast_heaps[number] = known
        return known[1]

    def _frame(self, vehicle: int | None, link: str, thing: int | None) -> Callable[[], Array]:
        """The present pose of a link or an object, (4, 4) [m]."""
        engine = self._engine
        if vehicle is not None:
            return lambda: engine.poses.link_frame(vehicle, link)
        assert thing is not None
        return lambda: engine.poses.object(thing).matrix
