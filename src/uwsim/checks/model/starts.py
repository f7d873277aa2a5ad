"""Warnings about start poses: in or under the ground, or above the water.

Ground is what stands fixed and can be touched, each thing of it looked at alone. What a
``<u:accept>start</u:accept>`` stands in, what ``<u:onFloor>`` sets down and ghosts are not asked
about. Not looked at: vehicles inside one another.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress

import numpy as np

from ...base.geometry import Pose
from ...errors import Diagnostic, UwsimError
from ...model.resolved_scene import ResolvedScene
from ...scene.accepted_warnings import unless_meant
from ...scene.object import ObjectSpec
from ...scene.vehicle import VehicleSpec
from ...simulation.collision.start_depths import StartDepth, StartDepths
from ..subjects import MAX_LOOSE, CheckedScene

CLEARANCE = 1e-3
"""Of the position that a message names, above the ground [m]."""


def start_poses(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of vehicles and free objects that begin in or under the ground, or above the water."""
    loose = [index for index, solid in scene.spec.solid_objects.items() if solid.is_loose]
    with suppress(UwsimError):  # reported where models are checked
        starts = Starts(scene.resolved)
        for i in scene.checked_vehicles:
            yield from _start(scene, "vehicle", scene.spec.vehicles[i], starts.of_vehicle, i)
        for i in loose[:MAX_LOOSE]:
            yield from _start(scene, "object", scene.spec.objects[i], starts.of_object, i)


def _start(
    scene: CheckedScene,
    kind: str,
    spec: VehicleSpec | ObjectSpec,
    text_of: Callable[[int], str],
    index: int,
) -> Iterator[Diagnostic]:
    if "start" not in spec.accepts and (text := text_of(index)):
        message = f"the {kind} {spec.name!r}: {text}. {unless_meant('start')}"
        yield scene.warning(spec, message, "position")


class Starts:
    """The start poses of a scene's vehicles and objects.

    Args:
        resolved: the scene.

    Raises:
        UwsimError: a mesh cannot be read.
    """

    def __init__(self, resolved: ResolvedScene) -> None:
        self._scene = resolved.scene
        self._depths = StartDepths(resolved)

    def of_vehicle(self, index: int) -> str:
        """Warn of the start pose of a vehicle."""
        vehicle = self._scene.vehicles[index]
        if vehicle.vr or vehicle.on_floor is not None:
            return ""
        world_from_base = self._scene.world_from_localized @ vehicle.localized_from_base
        body = self._depths.floor.body_of_vehicle(index, world_from_base)
        if not len(body):
            return ""
        height = float(body[..., 2].min()) - self._scene.ocean_state.ocean_surface_height
        if vehicle.dynamics is not None and height > 0.0:
            return (
                f"it begins {height:.3g} m above the water: it falls; expected in it (up is "
                f"{self._up()} in the file's frame)"
            )
        return self._in_ground(self._depths.of_body(body, world_from_base), world_from_base)

    def of_object(self, index: int) -> str:
        """Warn of the start pose of a free object."""
        thing = self._scene.objects[index]
        if thing.on_floor is not None:
            return ""
        world_from_object = self._scene.world_from_localized @ thing.localized_from_object
        return self._in_ground(self._depths.of_object(index), world_from_object)

    def _in_ground(self, depth: StartDepth | None, world_from_body: Pose) -> str:
        """Warn of the ground in or under which a body starts, with the position that clears it."""
        if depth is None:
            return ""
        where = (
            f"it begins {depth.rise:.3g} m deep in {depth.ground!r}"
            if depth.middle is None
            else f"it begins under the surface of {depth.ground!r}, its middle "
            f"{depth.middle:.3g} m deep"
        )
        clear = self._clear_position(world_from_body, depth.rise)
        return f"{where}; expected above it, at {clear}: <u:onFloor/> sets it there"

    def _clear_position(self, world_from_body: Pose, rise: float) -> str:
        """The position in the file's frame at which a body is clear of the ground."""
        lifted = world_from_body.position + np.array([0.0, 0.0, rise + CLEARANCE])
        file_from_world = self._scene.world_from_localized.inverse()
        before = file_from_world.transform(world_from_body.position[None])[0]
        after = file_from_world.transform(lifted[None])[0]
        moved = [i for i in range(3) if abs(after[i] - before[i]) > 1e-6]
        return ", ".join(f"{'xyz'[i]} {after[i]:.3f}" for i in moved)

    def _up(self) -> str:
        """The vertical axis of the file's frame, upwards."""
        up = self._scene.world_from_localized.rotation[2]
        axis = int(np.argmax(np.abs(up)))
        return f"{'-' if up[axis] < 0.0 else ''}{'xyz'[axis]}"
