"""Warnings about start poses: in or under the ground, or above the water.

The ground consists of the fixed objects that have contacts, each checked separately. Not checked:
bodies with ``<u:accept>start</u:accept>`` or ``<u:onFloor>``, ghosts (``<vr>``), vehicles inside
one another.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress

import numpy as np

from ...base.geometry import Pose
from ...errors import Diagnostic, UwsimError
from ...model.resolved_scene import ResolvedScene
from ...scene.accepted_warnings import acceptance_hint
from ...scene.object import ObjectSpec
from ...scene.vehicle import VehicleSpec
from ...simulation.collision.start_depths import StartDepth, StartDepths
from ..subjects import MAX_LOOSE_OBJECTS, CheckedScene

Body = VehicleSpec | ObjectSpec
CLEARANCE = 1e-3
"""The height above the ground of the position that a message recommends [m]."""


def start_poses(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of vehicles and loose objects that begin in or under the ground, or above the water."""
    solids = scene.spec.solid_objects.items()
    loose_objects = [i for i, solid in solids if solid.is_loose and not scene.spec.objects[i].joint]
    with suppress(UwsimError):  # reported where models are checked
        starts = Starts(scene.resolved_scene)
        for i in scene.checked_vehicles:
            yield from _start(scene, "vehicle", scene.spec.vehicles[i], starts.describe_vehicle, i)
        for i in loose_objects[:MAX_LOOSE_OBJECTS]:
            yield from _start(scene, "object", scene.spec.objects[i], starts.describe_object, i)


def _start(
    scene: CheckedScene, kind: str, spec: Body, describe: Callable[[int], str], index: int
) -> Iterator[Diagnostic]:
    if "start" not in spec.accepts and (text := describe(index)):
        message = f"the {kind} {spec.name!r}: {text}. {acceptance_hint('start')}"
        yield scene.warning(spec, message, "position")


class Starts:
    """The start poses of a scene's vehicles and objects.

    Args:
        resolved_scene: the scene.

    Raises:
        UwsimError: a mesh cannot be read.
    """

    def __init__(self, resolved_scene: ResolvedScene) -> None:
        self._scene = resolved_scene.scene
        self._depths = StartDepths(resolved_scene)

    def describe_vehicle(self, index: int) -> str:
        """Describe an unlikely start pose of a vehicle; empty if it is likely."""
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
                f"it begins {height:.3g} m above the water and falls; expected a position in it "
                f"(up is {self._vertical_axis()} in the file's frame)"
            )
        return self._describe_depth(self._depths.body_depth(body, world_from_base), world_from_base)

    def describe_object(self, index: int) -> str:
        """Describe an unlikely start pose of a loose object; empty if it is likely."""
        spec = self._scene.objects[index]
        if spec.on_floor is not None:
            return ""
        world_from_object = self._scene.world_from_localized @ spec.localized_from_object
        return self._describe_depth(self._depths.object_depth(index), world_from_object)

    def _describe_depth(self, depth: StartDepth | None, world_from_body: Pose) -> str:
        """Describe the ground in or under which a body starts, and a position above it."""
        if depth is None:
            return ""
        description = (
            f"it begins {depth.rise:.3g} m deep in {depth.ground!r}"
            if depth.centre_depth is None
            else f"it begins under the surface of {depth.ground!r}, its middle "
            f"{depth.centre_depth:.3g} m deep"
        )
        position = self._clear_position(world_from_body, depth.rise)
        return f"{description}; expected above it, at {position}: <u:onFloor/> sets it there"

    def _clear_position(self, world_from_body: Pose, rise: float) -> str:
        """Return the position in the file's frame at which a body is above the ground, as text.

        Args:
            world_from_body: the start pose of the body.
            rise: the height by which the body must be raised to be on the ground [m].
        """
        clear_position = world_from_body.position + np.array([0.0, 0.0, rise + CLEARANCE])
        file_from_world = self._scene.world_from_localized.inverse()
        start = file_from_world.transform(world_from_body.position[None])[0]
        end = file_from_world.transform(clear_position[None])[0]
        axes = [i for i in range(3) if abs(end[i] - start[i]) > 1e-6]
        return ", ".join(f"{'xyz'[i]} {end[i]:.3f}" for i in axes)

    def _vertical_axis(self) -> str:
        """Return the axis of the file's frame that points up, such as ``-z``."""
        up = self._scene.world_from_localized.rotation[2]
        axis = int(np.argmax(np.abs(up)))
        return f"{'-' if up[axis] < 0.0 else ''}{'xyz'[axis]}"
