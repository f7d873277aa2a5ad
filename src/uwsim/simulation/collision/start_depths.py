"""How deep vehicles and objects begin in the ground, and their lifting out of it.

Ground is what stands fixed and can be touched, each thing of it looked at alone. Bodies that begin
deeper than a share of their height are a mistake of the scene, of which `uwsim check` warns. Those
whose origin is less than their own height below the surface are lifted when the run begins
(`uwsim.physics.kinematics.lift`), unless the scene accepts their start. What is deeper stays where
it is.
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

SUNK = 0.1
"""Share of its height by which a body may begin in the ground; contacts push it out of less."""
MIN_RISE = 0.02
"""But no less than this [m]."""


@dataclass(frozen=True)
class StartDepth:
    """How deep a body begins in the ground."""

    ground: str
    """Name of the object that it is in."""
    rise: float
    """How far it must be lifted to rest on it [m]."""
    middle: float | None
    """How deep the middle of its box lies under the surface [m]; None: it lies above."""
    origin: float
    """How deep its origin lies under the surface [m]; below 0 above it."""
    height: float
    """Its own [m]."""


class StartDepths:
    """The start poses of a scene's vehicles and objects.

    Args:
        resolved: the scene.

    Raises:
        UwsimError: a mesh cannot be read.
    """

    def __init__(self, resolved: ResolvedScene) -> None:
        self._scene = scene = resolved.scene
        self.floor = Floor(resolved)
        """The ground, and the shapes of bodies."""
        self._grounds = {
            scene.objects[index].name: Ground(faces) for index, faces in self.floor.faces.items()
        }

    def of_vehicle(self, index: int) -> StartDepth | None:
        """Return how deep a vehicle begins; None if it is above the ground or has no shape."""
        pose = self._scene.world_from_localized @ self._scene.vehicles[index].localized_from_base
        return self.of_body(self.floor.body_of_vehicle(index, pose), pose)

    def of_object(self, index: int) -> StartDepth | None:
        """Return how deep an object begins; None if it is above the ground."""
        pose = self._scene.world_from_localized @ self._scene.objects[index].localized_from_object
        return self.of_body(self.floor.body_of_object(index, pose), pose)

    def of_body(self, body: Array, pose: Pose) -> StartDepth | None:
        """Return how deep a body, (n, 3, 3) in W [m], begins; None if it is above the ground."""
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
            elif not max(MIN_RISE, SUNK * height) < rise < height:
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
    """Return what is lifted when the run begins, and how far [m].

    Only those are looked at which touch something fixed at the start.
    """
    lifts: list[tuple[Kind, int, float]] = []
    touching = Engine(model).find_deep_bodies(MIN_RISE)
    if not touching:
        return lifts
    scene = model.scene
    depths = StartDepths(model)
    for kind, index in touching:
        spec = scene.vehicles[index] if kind == "vehicle" else scene.objects[index]
        if "start" in spec.accepts:
            continue
        found = depths.of_vehicle(index) if kind == "vehicle" else depths.of_object(index)
        if found is not None and found.rise > 0.0 and found.origin < found.height:
            lifts.append((kind, index, found.rise))
    return lifts
