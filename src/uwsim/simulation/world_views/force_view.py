"""The view of a running scene for its forces, and the frames at which forces act."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.linear import rotate
from ...errors import UnknownName
from ...physics.engine import Engine
from ...physics.kinematics.segments import SegmentBodies
from ...scene.attachable import attachable_bodies
from ...world import BodyMotion
from ..physical_scene import PhysicalScene


class SceneAttachment:
    """A frame that is fixed to a body of the scene (`uwsim.world.Attachment`).

    Args:
        name: the name of the body.
        vehicle: the name of the body's vehicle; empty for an object.
        pose: a function that returns the present pose of the frame in W.
        motion: a function that returns the present motion of the frame.
        engine_body: the MuJoCo ID of the body; None if forces do not move it.
        position_on_body: the origin of the frame in the frame of the engine's body, (3,) [m].
        engine: the engine.
    """

    def __init__(
        self,
        name: str,
        vehicle: str,
        pose: Callable[[], Pose],
        motion: Callable[[], BodyMotion],
        engine_body: int | None,
        position_on_body: Array,
        engine: Engine,
    ) -> None:
        self._engine = engine
        self.name, self.vehicle = name, vehicle
        self._pose, self.motion = pose, motion
        self.engine_body = engine_body
        """The MuJoCo ID of the body; None if forces do not move it."""
        self.position_on_body = position_on_body
        """The position of the frame's origin in the frame of the engine's body, (3,) [m]."""

    @property
    def world_from_body(self) -> Pose:
        """The present pose of the frame in W."""
        return self._pose()

    def mass(self) -> Array | None:
        """Return the mass that a force at the origin accelerates; see `uwsim.world.Attachment`."""
        if self.engine_body is None:
            return None
        return self._engine.link_motion.point_mass(self.engine_body, self._pose().position)


@dataclass(frozen=True)
class _Mount:
    """The spec of a frame on a link, which has the axes of the link."""

    relative_to: str  # the link
    position: tuple[float, float, float]  # in the frame of the link [m]
    orientation: tuple[float, float, float] = (0.0, 0.0, 0.0)


class ForceView:
    """The view of a running scene for its forces (`uwsim.world.ForceWorld`)."""

    def __init__(self, scene: PhysicalScene) -> None:
        spec = scene.model.scene
        self._scene = scene
        self._bodies = attachable_bodies(spec, scene.model.robots)
        self.timestep = scene.model.timestep
        """The length of a step [s]."""
        self.world_from_localized = spec.world_from_localized
        """The pose of L, the frame of the scene file, in W."""
        self.surface_height = spec.ocean_state.ocean_surface_height
        """The height of the water's surface in W [m]."""
        self.water_velocity = scene.water.velocity
        """The function that returns the velocity of the water at points; see `ForceWorld`."""
        self.rays = scene.rays
        """The ray casting against the scene."""
        self.stream = scene.stream
        """The function that returns the random generator of a stream's name."""
        depths, densities = np.array(scene.model.density_levels).T
        self._depths, self._densities = depths, densities  # (n,) [m], (n,) [kg/m3]

    def attach(self, name: str, position: Sequence[float] = (0.0, 0.0, 0.0)) -> SceneAttachment:
        """Return a frame that is fixed to a body, with the axes of the body.

        Args:
            name: the name of a vehicle (its base), of a link ``vehicle/link`` or of an object.
            position: the origin of the frame in the frame of the body, (3,) [m].

        Raises:
            UnknownName: there is no such body.
        """
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
            engine,
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

        return SceneAttachment(name, "", pose, motion, body, object_from_frame.position, engine)

    def segments(self, name: str) -> SegmentBodies:
        """Return the cylinders that show the force with a name.

        Raises:
            UnknownName: no force of this name is visible.
        """
        forces = self._scene.model.scene.forces
        for index, force in enumerate(forces):
            cylinders = force.drawn_segments
            if force.name == name and cylinders is not None:
                return self._scene.engine.poses.segments(index, cylinders.n, cylinders.length)
        raise UnknownName("visible force", name, [force.name for force in forces])

    def water_density(self, points: Array) -> Array:
        """Return the density of the water at points of W (n, 3) [m], (n,) [kg/m3]; 0 in the air."""
        depths = self.surface_height - points[:, 2]
        density: Array = np.interp(depths, self._depths, self._densities)
        return np.where(depths < 0.0, 0.0, density)
