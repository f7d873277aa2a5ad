"""How the water of a scene moves: its own currents, and what scene updaters add."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..currents import Place, TotalCurrent, bind_currents
from ..geometry import Array, Pose
from ..linear import product
from ..scene.spec import SceneSpec
from ..world import Flow


class WaterMotion:
    """The flow that the vehicles of a scene feel, in W.

    Args:
        scene: what the file says.
        place: what currents may see of the scene.
    """

    def __init__(self, scene: SceneSpec, place: Place) -> None:
        specs = scene.ocean_state.currents
        self._world_from_localized = scene.world_from_localized
        self._localized_from_world = scene.world_from_localized.inverse()
        self._scene_current = bind_currents(specs, place)
        self._has_scene_current = bool(specs)
        self._flow: Flow = self._scene_current
        self._is_still = not specs
        self.files: dict[str, Path] = {}
        """Files that the currents read, by name."""
        for spec in specs:
            self.files |= spec.files(place)

    def set(self, current: Flow | None) -> None:
        """Let the water move so, besides the scene's own currents; None: no more."""
        self._is_still = current is None and not self._has_scene_current
        if current is None:
            self._flow = self._scene_current
        elif self._has_scene_current:
            self._flow = TotalCurrent([self._scene_current, current])
        else:
            self._flow = current

    @property
    def is_still(self) -> bool:
        """Whether the water does not move at all."""
        return self._is_still

    def at(self, points: Array, time: float, vehicles: Sequence[str]) -> tuple[Array, Array]:
        """Return the water's velocity and its rate of change at fixed points, in W.

        Args:
            points: in W, (n, 3) [m].
            time: [s].
            vehicles: the name of the vehicle that each point belongs to, or empty.

        Returns:
            The velocity, (n, 3) [m/s], and its derivative, (n, 3) [m/s2].
        """
        localized = self._localized_from_world.transform(points)
        turn = self._localized_from_world.rotation
        velocity = self._flow.velocity(localized, time, vehicles)
        acceleration = self._flow.acceleration(localized, time, vehicles)
        return product(velocity, turn), product(acceleration, turn)

    def carried(self, world_from_base: Pose, time: float, timestep: float, vehicle: str) -> Pose:
        """Return where a vehicle is after a step of drifting with the water: ``p += v dt``."""
        point = self._localized_from_world.transform(world_from_base.position[None])  # (1, 3) [m]
        velocity = self._flow.velocity(point, time, (vehicle,))[0]  # (3,) [m/s]
        moved = self._world_from_localized.transform(point + velocity * timestep)[0]
        return Pose(moved, world_from_base.rotation)
