"""Places vehicles and objects with ``<u:onFloor>`` on the ground when a scene is opened.

The ground is every object that stands fixed and can be touched, and ``terrain`` in any case; what
is set on the ground carries nothing itself. A vehicle touches it with the boxes of its links, its
joints as in the file; an object with its collision shape, without ``<physics>`` with the hulls of
its mesh's materials.
"""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..base.geometry import Array, Pose, rotation_about, rpy_from_rotation, xyz_from_rotation
from ..base.numerics.linear import length, product
from ..errors import Diagnostic, SceneError
from ..scene.object import ObjectSpec, PhysicsSpec
from ..scene.on_floor import OnFloorSpec
from ..scene.spec import SceneSpec, stands_on_floor
from ..scene.urdf.kinematics import link_poses
from ..scene.vehicle import VehicleSpec
from ..schema import diagnostic_at
from .body_names import object_body
from .collision.ground import Ground, triangles_of
from .collision.scene_shapes import collision_shapes, standing_faces
from .resolved_scene import ResolvedScene

HULL = PhysicsSpec(collision_shape_type="trimesh")
"""Collision shapes of an object without ``<physics>``: the hulls of its materials."""


def set_on_floor(resolved: ResolvedScene) -> SceneSpec:
    """Return the scene with every ``u:onFloor`` resolved to a pose.

    Raises:
        SceneError: there is no ground under something; with every such place.
    """
    scene = resolved.scene
    if not stands_on_floor(scene):
        return scene
    floor = Floor(resolved)
    diagnostics: list[Diagnostic] = []
    vehicles, objects = list(scene.vehicles), list(scene.objects)
    for i, vehicle in enumerate(vehicles):
        if vehicle.on_floor is not None and i in resolved.robots:
            placed = floor.pose_of_vehicle(i, vehicle, vehicle.on_floor)
            if placed is None:
                diagnostics.append(floor.nothing_under("vehicle", vehicle))
            else:
                vehicles[i] = _moved_vehicle(vehicle, placed)
    for i, thing in enumerate(objects):
        if thing.on_floor is not None:
            placed = floor.pose_of_object(i, thing, thing.on_floor)
            if placed is None:
                diagnostics.append(floor.nothing_under("object", thing))
            else:
                objects[i] = _moved_object(thing, placed)
    if diagnostics:
        raise SceneError(diagnostics)
    return replace(scene, vehicles=tuple(vehicles), objects=tuple(objects))


def ground_faces(scene: SceneSpec, data_path: tuple[Path, ...]) -> dict[int, Array]:
    """Triangles of the ground in W, (n, 3, 3) [m], by the number of their object."""
    faces = {}
    for i, thing in enumerate(scene.objects):
        is_fixed = thing.is_touched(in_water=True) and not thing.solid.is_loose
        if thing.on_floor is None and (is_fixed or thing.is_ground):
            faces[i] = standing_faces(scene, i, thing.solid, data_path)
    return faces


class Floor:
    """The ground of a scene, and the poses of bodies at rest on it.

    Args:
        resolved: the scene.
    """

    def __init__(self, resolved: ResolvedScene) -> None:
        self._resolved, self._scene = resolved, resolved.scene
        self.faces = ground_faces(resolved.scene, resolved.data_path)
        self.ground = Ground(np.concatenate([np.zeros((0, 3, 3)), *self.faces.values()]))

    def body_of_vehicle(self, index: int, world_from_base: Pose) -> Array:
        """The boxes of a vehicle's links, (n, 3, 3) [m]; n is 0 where it has no shape."""
        robot, vehicle = self._resolved.robots[index], self._scene.vehicles[index]
        shapes = collision_shapes(self._resolved, [index], {})
        poses = link_poses(robot, vehicle.joint_values)
        found = [np.zeros((0, 3, 3))]
        for name, parts in shapes.items():
            pose = poses[name.split("/", 2)[2]]
            scaled = Pose(np.array(vehicle.scale_factor) * pose.position, pose.rotation)
            found.append(triangles_of(parts, world_from_base @ scaled))
        return np.concatenate(found)

    def body_of_object(self, index: int, world_from_object: Pose) -> Array:
        """The collision triangles of an object, (n, 3, 3) [m]."""
        usual = PhysicsSpec() if self._scene.is_original_physics else HULL
        given = self._scene.objects[index].physics or usual
        physics = PhysicsSpec(
            collision_shape_type=given.collision_shape_type, collision_shape=given.collision_shape
        )  # loose, so that a trimesh is its hull
        shapes = collision_shapes(self._resolved, [], {index: physics})
        return triangles_of(shapes[object_body(index)], world_from_object)

    def pose_of_vehicle(self, index: int, vehicle: VehicleSpec, spec: OnFloorSpec) -> Pose | None:
        """``localized_from_base`` on the ground; None where there is none."""
        world_from_base = self._scene.world_from_localized @ vehicle.localized_from_base
        body = self.body_of_vehicle(index, world_from_base)
        return self._set_down(world_from_base, body, spec)

    def pose_of_object(self, index: int, thing: ObjectSpec, spec: OnFloorSpec) -> Pose | None:
        """``localized_from_object`` on the ground; None where there is none."""
        world_from_object = self._scene.world_from_localized @ thing.localized_from_object
        body = self.body_of_object(index, world_from_object)
        return self._set_down(world_from_object, body, spec)

    def _set_down(self, world_from_body: Pose, body: Array, spec: OnFloorSpec) -> Pose | None:
        """The pose on the ground, in L.

        Args:
            world_from_body: where the file puts it.
            body: its triangles there, (n, 3, 3) [m]; none: its origin alone.
            spec: its ``<u:onFloor>``.
        """
        origin = world_from_body.position
        if not len(body):
            body = np.broadcast_to(origin, (1, 3, 3))
        if spec.align_to_slope:
            turn = _upright_to(self.ground.normal(body))
            body = product(body - origin, turn.T) + origin
            world_from_body = Pose(origin, product(turn, world_from_body.rotation))
        rise = self.ground.rise(body)
        if rise is None:
            return None
        lifted = origin + np.array([0.0, 0.0, rise + spec.clearance])
        placed = Pose(lifted, world_from_body.rotation)
        return self._scene.world_from_localized.inverse() @ placed

    def nothing_under(self, kind: str, spec: VehicleSpec | ObjectSpec) -> Diagnostic:
        """Report that there is no ground below a body."""
        x, y, _ = spec.position
        have = "no ground in this scene" if not len(self.ground) else "none there"
        return diagnostic_at(
            spec.on_floor,
            f"<u:onFloor>: no ground under the {kind} {spec.name!r} at x {x:g}, y {y:g} of the "
            f"file's frame; there is {have}: an object called 'terrain', or one with <u:solid> 1",
            file=self._scene.path,
        )


def _upright_to(normal: Array) -> Array:
    """The smallest turn that takes z to a normal that points up, (3, 3)."""
    axis = np.cross([0.0, 0.0, 1.0], normal)
    sine = length(axis)
    if sine < 1e-12:
        return np.eye(3)
    return rotation_about(axis, math.atan2(sine, normal[2]))


def _moved_vehicle(vehicle: VehicleSpec, localized_from_base: Pose) -> VehicleSpec:
    x, y, z = localized_from_base.position.tolist()
    if vehicle.on_floor is not None and vehicle.on_floor.align_to_slope:
        angles = xyz_from_rotation(localized_from_base.rotation)
        vehicle = replace(vehicle, orientation=angles)
    return replace(vehicle, position=(x, y, z), on_floor=None)


def _moved_object(thing: ObjectSpec, localized_from_object: Pose) -> ObjectSpec:
    x, y, z = localized_from_object.position.tolist()
    if thing.on_floor is not None and thing.on_floor.align_to_slope:
        thing = replace(thing, orientation=rpy_from_rotation(localized_from_object.rotation))
    return replace(thing, position=(x, y, z), on_floor=None)
