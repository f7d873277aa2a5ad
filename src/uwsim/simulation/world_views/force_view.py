"""A scene as its forces see it, and the frames at which they act."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.linear import rotate
from ...errors import UnknownName
from ...scene.attachable import attachable_bodies
from ...world import BodyMotion
from ..physical_scene import PhysicalScene


class SceneAttachment:
    """A frame fixed to a body of a scene (`uwsim.world.Attachment`).

    Args:
        name: of the body.
        vehicle: name of the vehicle that it is on; empty on an object.
        pose: where the frame is.
        motion: how it moves.
        engine_body: number of the engine's body; None where forces do not move it.
        position_on_body: where the frame's origin is in the frame of that body, (3,) [m].
    """

    def __init__(
        self,
        name: str,
        vehicle: str,
        pose: Callable[[], Pose],
        motion: Callable[[], BodyMotion],
        engine_body: int | None,
        position_on_body: Array,
    ) -> None:
        self.name, self.vehicle = name, vehicle
        self._pose, self.motion = pose, motion
        self.engine_body = engine_body
        """The number of the engine's body; None where forces do not move it."""
        self.position_on_body = position_on_body
        """The position of the frame's origin in the frame of that body, (3,) [m]."""

    @property
    def world_from_body(self) -> Pose:
        """The present pose of the frame."""
        return self._pose()


@dataclass(frozen=True)
class _Mount:
    """A frame on a link with the link's axes."""

    relative_to: str
    position: tuple[float, float, float]
    orientation: tuple[float, float, float] = (0.0, 0.0, 0.0)


class ForceView:
    """A scene as its forces see it (`uwsim.world.ForceWorld`)."""

    def __init__(self, scene: PhysicalScene) -> None:
        spec = scene.model.scene
        self._scene = scene
        self._bodies = attachable_bodies(spec, scene.model.robots)
        self.timestep = scene.model.timestep
        """The length of a step [s]."""
        self.world_from_localized = spec.world_from_localized
        """The transform of W from L: the scene's offset."""
        self.surface_height = spec.ocean_state.ocean_surface_height
        """The height of the water's surface in W [m]."""
        self.water_velocity = scene.water.velocity
        self.stream = scene.stream
        depths, densities = np.array(scene.model.density_levels).T
        self._depths, self._densities = depths, densities  # (n,) [m], (n,) [kg/m3]

    def attach(self, name: str, position: Sequence[float] = (0.0, 0.0, 0.0)) -> SceneAttachment:
        """Fix a frame to a vehicle's base, a link ``vehicle/link`` or an object."""
        if name not in self._bodies:
            raise UnknownName("vehicle, link or object", name, self._bodies)
        x, y, z = map(float, position)
        body = self._bodies[name]
        index, link = body.index, body.link
        if body.kind == "object":
            return self._attach_to_object(name, index, np.array([x, y, z]))
        engine, vehicle = self._scene.engine, self._scene.vehicles[index]
        mount = vehicle.moving_mount(_Mount(link, (x, y, z)))
        return SceneAttachment(
            name,
            vehicle.name,
            lambda: mount.world_from_body,
            mount.motion,
            engine.poses.link_body(index, link) if engine.has_dynamics(index) else None,
            np.array([x, y, z]),
        )

    def _attach_to_object(self, name: str, index: int, position: Array) -> SceneAttachment:
        engine, spec = self._scene.engine, self._scene.model.scene.objects[index]
        body, mesh = engine.poses.loose_body(index), spec.object_from_mesh
        origin = np.array(spec.scale_factor) * mesh.position  # (3,) [m]
        object_from_frame = Pose(origin + rotate(mesh.rotation, position), mesh.rotation)

        def pose() -> Pose:
            return engine.poses.object(index) @ object_from_frame

        def motion() -> BodyMotion:
            if body is None:
                return BodyMotion(np.zeros(3), np.zeros(3), np.zeros(3))
            return engine.link_motion.point_motion(body, pose().position)

        return SceneAttachment(name, "", pose, motion, body, object_from_frame.position)

    def water_density(self, points: Array) -> Array:
        """Return the density of the water at points of W (n, 3) [m], (n,) [kg/m3]; 0 above it."""
        depths = self.surface_height - points[:, 2]
        density: Array = np.interp(depths, self._depths, self._densities)
        return np.where(depths < 0.0, 0.0, density)
