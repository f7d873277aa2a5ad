"""Vehicles as what carries sensors, cameras and lamps."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

from ..errors import UnknownName
from ..geometry import Pose
from ..physics.state import State
from ..scene.mounts import Stand, link_from_frame
from ..scene.spec import SceneSpec
from ..scene.urdf import RobotSpec
from ..sensors.sensor import Mounted
from .bodies import SceneBody


class VehicleCarrier:
    """One vehicle of a scene (`uwsim.world.Carrier`); told by its number, not by its name.

    Args:
        index: its number in the scene.
        stand: the vehicle where its file puts it.
        state: where its links are.
    """

    def __init__(self, index: int, stand: Stand, state: State) -> None:
        self._index, self._stand, self._state = index, stand, state
        self.name = stand.vehicle.name
        """Its name in the scene."""

    def has_link(self, name: str) -> bool:
        """Whether one of its links is called so."""
        return self._stand.robot.link(name) is not None

    def mount(self, spec: Mounted, *, visual: bool = False) -> SceneBody:
        """Fix something to its link; raises UnknownName if there is no such link."""
        link, robot = spec.relative_to, self._stand.robot
        if not self.has_link(link):
            raise UnknownName("link", link, [each.name for each in robot.links])
        link_from_part = link_from_frame(robot, link, visual) @ self._stand.frame_from_mounted(
            spec, visual=visual
        )
        pose: Callable[[], Pose] = partial(
            self._state.mounted_pose, self._index, link, link_from_part
        )
        return SceneBody(f"{self.name}/{link}", pose, None)


def carriers_of(
    scene: SceneSpec, robots: Mapping[int, RobotSpec], state: State
) -> tuple[VehicleCarrier, ...]:
    """The vehicles of a scene, in the file's order."""
    return tuple(
        VehicleCarrier(index, Stand(vehicle, robots[index], scene.world_from_localized), state)
        for index, vehicle in enumerate(scene.vehicles)
    )
