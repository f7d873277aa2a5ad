"""Warnings about start poses: in or under the ground, or above the water.

Ground is what stands fixed and can be touched, each thing of it looked at alone. What a
``<u:accept>start</u:accept>`` stands in, what ``<u:onFloor>`` sets down and ghosts are not asked
about. Not looked at: vehicles inside one another.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ...geometry import Array
from ...physics.collision.ground import Ground
from ...scene.spec import SceneSpec
from ...scene.urdf.robot import RobotSpec
from ..collision.floor import Floor

SUNK = 0.1
"""Share of its height by which a body may begin in the ground; what is sunk less is lifted."""
MIN_RISE = 0.02
"""But no less than this [m]."""


class Starts:
    """The start poses of a scene's vehicles and objects.

    Args:
        scene: spec of the scene.
        robots: the robot of each vehicle, by its number.
        data_path: folders in which files are looked for.

    Raises:
        UwsimError: a mesh cannot be read.
    """

    def __init__(
        self, scene: SceneSpec, robots: Mapping[int, RobotSpec], data_path: tuple[Path, ...]
    ) -> None:
        self._scene = scene
        self._floor = Floor(scene, robots, data_path)
        self._grounds = {
            scene.objects[index].name: Ground(faces) for index, faces in self._floor.faces.items()
        }

    def of_vehicle(self, index: int) -> str:
        """Warn of the start pose of a vehicle."""
        vehicle = self._scene.vehicles[index]
        if vehicle.vr or vehicle.on_floor is not None:
            return ""
        world_from_base = self._scene.world_from_localized @ vehicle.localized_from_base
        body = self._floor.body_of_vehicle(index, world_from_base)
        if not len(body):
            return ""
        height = float(body[..., 2].min()) - self._scene.ocean_state.ocean_surface_height
        if vehicle.dynamics is not None and height > 0.0:
            return (
                f"it begins {height:.3g} m above the water: it falls; expected in it (up is "
                f"{self._up()} in the file's frame)"
            )
        return self._in_ground(body)

    def of_object(self, index: int) -> str:
        """Warn of the start pose of a free object."""
        thing = self._scene.objects[index]
        if thing.on_floor is not None:
            return ""
        world_from_object = self._scene.world_from_localized @ thing.localized_from_object
        return self._in_ground(self._floor.body_of_object(index, world_from_object))

    def _in_ground(self, body: Array) -> str:
        """Warn of the ground in or under which a body, (n, 3, 3) [m], starts."""
        low, high = body.min(axis=(0, 1)), body.max(axis=(0, 1))
        for name, ground in self._grounds.items():
            rise = ground.rise(body)
            middle = 0.5 * (low + high)
            if ground.covers(middle):
                level = ground.level(middle)
                depth = 0.0 if level is None else level - float(middle[2])
                return (
                    f"it begins under the surface of {name!r}, its middle {depth:.3g} m deep; "
                    "expected above it: <u:onFloor/> sets it there"
                )
            if (
                rise is not None
                and max(MIN_RISE, SUNK * (high[2] - low[2])) < rise < high[2] - low[2]
            ):
                return (
                    f"it begins {rise:.3g} m deep in {name!r}; expected above it: <u:onFloor/> "
                    "sets it there"
                )
        return ""

    def _up(self) -> str:
        """The vertical axis of the file's frame, upwards."""
        up = self._scene.world_from_localized.rotation[2]
        axis = int(np.argmax(np.abs(up)))
        return f"{'-' if up[axis] < 0.0 else ''}{'xyz'[axis]}"
