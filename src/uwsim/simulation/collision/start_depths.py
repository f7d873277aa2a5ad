"""The depths at which vehicles and objects begin in the ground, and the lift out of it.

Each fixed object with contacts is a ground. A body that begins deeper in it than a fraction of its
own height is a mistake in the scene, about which `uwsim check` warns. When a run begins, bodies
whose origin is less than their height below the surface are lifted to it
(`uwsim.physics.kinematics.lift`), unless the scene accepts their start. Deeper bodies stay.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array, Pose
from ...model.collision.ground import Ground
from ...model.placement import Floor
from ...model.resolved_scene import ResolvedScene
from ...model.scene_model import SceneModel
from ...physics.engine import Engine, Kind

MAX_SUNK_SHARE = 0.1
"""The fraction of its height by which a body may begin in the ground without a warning [1]:
contacts push it out."""
MIN_LIFT = 0.02
"""The depth up to which a body of any height may begin in the ground [m]."""


@dataclass(frozen=True)
class StartDepth:
    """The depth at which a body begins in the ground."""

    ground: str
    """The name of the object that is the ground."""
    rise: float
    """The height by which it must be lifted to rest on the ground [m]."""
    centre_depth: float | None
    """The depth of the centre of its bounding box below the surface [m]; None: it is above."""
    origin_depth: float
    """The depth of the body's origin below the surface [m]; negative above it."""
    height: float
    """The height of the body [m]."""


class StartDepths:
    """The depths in the ground of a scene's vehicles and objects at their start poses.

    Raises:
        UwsimError: a mesh cannot be read.
    """

    def __init__(self, resolved_scene: ResolvedScene) -> None:
        self._scene = scene = resolved_scene.scene
        self.floor = Floor(resolved_scene)
        """The faces of each ground, and the collision shapes of bodies."""
        self._grounds = {
            scene.objects[index].name: Ground(faces) for index, faces in self.floor.faces.items()
        }
        for index, grid in self.floor.grids.items():
            self._grounds[scene.objects[index].name] = Ground(np.zeros((0, 3, 3)), [grid])

    def vehicle_depth(self, index: int) -> StartDepth | None:
        """Return the start depth of a vehicle; None if it is above the ground or has no shape."""
        pose = self._scene.world_from_localized @ self._scene.vehicles[index].localized_from_base
        return self.body_depth(self.floor.body_of_vehicle(index, pose), pose)

    def object_depth(self, index: int) -> StartDepth | None:
        """Return the start depth of an object; None if it is above the ground."""
        pose = self._scene.world_from_localized @ self._scene.objects[index].localized_from_object
        return self.body_depth(self.floor.body_of_object(index, pose), pose)

    def body_depth(self, body: Array, pose: Pose) -> StartDepth | None:
        """Return the start depth of a body; None if it is above the ground.

        Args:
            body: the triangles of its collision shapes in W, (n, 3, 3) [m].
            pose: its pose in W.
        """
        if not len(body):
            return None
        low, high = body.min(axis=(0, 1)), body.max(axis=(0, 1))
        centre, height = 0.5 * (low + high), float(high[2] - low[2])
        for name, ground in self._grounds.items():
            rise = ground.rise(body)
            if rise is None:
                continue
            depth: float | None = None
            if ground.covers(centre):
                surface_z = ground.height_at(centre)
                depth = 0.0 if surface_z is None else surface_z - float(centre[2])
            elif not max(MIN_LIFT, MAX_SUNK_SHARE * height) < rise < height:
                continue
            surface_z = ground.height_at(pose.position)
            origin_depth = -np.inf if surface_z is None else surface_z - float(pose.position[2])
            return StartDepth(name, rise, depth, origin_depth, height)
        return None


def lift_from_ground(model: SceneModel, engine: Engine) -> None:
    """Begin to lift vehicles with dynamics and loose objects that begin in the ground."""
    for kind, index, rise in model.compute_once(_start_lifts):
        engine.begin_lift(kind, index, rise)


def _start_lifts(model: SceneModel) -> list[tuple[Kind, int, float]]:
    """Return kind and number of each body to lift when the run begins, and the height [m].

    Only bodies that are in contact with a fixed body at the start are examined.
    """
    lifts: list[tuple[Kind, int, float]] = []
    contact_bodies = Engine(model).find_deep_bodies(MIN_LIFT)
    if not contact_bodies:
        return lifts
    scene = model.scene
    depths = StartDepths(model)
    for kind, index in contact_bodies:
        spec = scene.vehicles[index] if kind == "vehicle" else scene.objects[index]
        if "start" in spec.accepts:
            continue
        depth = depths.vehicle_depth(index) if kind == "vehicle" else depths.object_depth(index)
        if depth is not None and depth.rise > 0.0 and depth.origin_depth < depth.height:
            lifts.append((kind, index, depth.rise))
    return lifts
