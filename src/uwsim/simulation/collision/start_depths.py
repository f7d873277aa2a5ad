"""The depths at which vehicles and objects begin in the ground, and their lifting out of it.

The ground is each fixed object with contacts, on its own. Bodies that begin deeper than a share of
their height are a mistake of the scene, of which `uwsim check` warns. Those whose origin is less
than their own height below the surface are lifted when the run begins
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

SUNK_SHARE = 0.1
"""The share of its height by which a body may begin in the ground; contacts push it out of less."""
MIN_RISE = 0.02
"""The least such depth [m]."""


@dataclass(frozen=True)
class StartDepth:
    """The depth at which a body begins in the ground."""

    ground: str
    """The name of the object that it is in."""
    rise: float
    """The height by which it must be lifted to rest on the ground [m]."""
    middle: float | None
    """The depth of the middle of its box below the surface [m]; None: it is above."""
    origin: float
    """The depth of its origin below the surface [m]; negative above it."""
    height: float
    """The height of the body [m]."""


class StartDepths:
    """The start poses of a scene's vehicles and objects.

    Raises:
        UwsimError: a mesh cannot be read.
    """

    def __init__(self, resolved_scene: ResolvedScene) -> None:
        self._scene = scene = resolved_scene.scene
        self.floor = Floor(resolved_scene)
        """The ground, and the shapes of bodies."""
        self._grounds = {
            scene.objects[index].name: Ground(faces) for index, faces in self.floor.faces.items()
        }

    def vehicle_depth(self, index: int) -> StartDepth | None:
        """Return the start depth of a vehicle; None if it is above the ground or has no shape."""
        pose = self._scene.world_from_localized @ self._scene.vehicles[index].localized_from_base
        return self.body_depth(self.floor.body_of_vehicle(index, pose), pose)

    def object_depth(self, index: int) -> StartDepth | None:
        """Return the start depth of an object; None if it is above the ground."""
        pose = self._scene.world_from_localized @ self._scene.objects[index].localized_from_object
        return self.body_depth(self.floor.body_of_object(index, pose), pose)

    def body_depth(self, body: Array, pose: Pose) -> StartDepth | None:
        """Return the start depth of a body, (n, 3, 3) in W [m]; None if it is above the ground."""
        if not len(body):
            return None
        low, high = body.min(axis=(0, 1)), body.max(axis=(0, 1))
        middle, height = 0.5 * (low + high), float(high[2] - low[2])
        for name, ground in self._grounds.items():
            rise = ground.rise(body)
            if rise is None:
                continue
            depth: float | None = None
            if ground.covers(middle):
                level = ground.level(middle)
                depth = 0.0 if level is None else level - float(middle[2])
            elif not max(MIN_RISE, SUNK_SHARE * height) < rise < height:
                continue
            at_origin = ground.level(pose.position)
            origin = -np.inf if at_origin is None else at_origin - float(pose.position[2])
            return StartDepth(name, rise, depth, origin, height)
        return None


def lift_from_ground(model: SceneModel, engine: Engine) -> None:
    """Begin to lift simulated vehicles and loose objects that begin in the ground."""
    for kind, index, rise in model.compute_once(_start_lifts):
        engine.begin_lift(kind, index, rise)


def _start_lifts(model: SceneModel) -> list[tuple[Kind, int, float]]:
    """Return the bodies that are lifted when the run begins, and the heights [m].

    Only bodies in contact with a fixed one at the start are examined.
    """
    lifts: list[tuple[Kind, int, float]] = []
    contact_bodies = Engine(model).find_deep_bodies(MIN_RISE)
    if not contact_bodies:
        return lifts
    scene = model.scene
    depths = StartDepths(model)
    for kind, index in contact_bodies:
        spec = scene.vehicles[index] if kind == "vehicle" else scene.objects[index]
        if "start" in spec.accepts:
            continue
        depth = depths.vehicle_depth(index) if kind == "vehicle" else depths.object_depth(index)
        if depth is not None and depth.rise > 0.0 and depth.origin < depth.height:
            lifts.append((kind, index, depth.rise))
    return lifts
