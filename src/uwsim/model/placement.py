"""Placement of vehicles and objects with ``<u:onFloor>`` on the ground when a scene is opened.

The ground consists of every fixed object that has contacts, and of ``terrain`` in any case, but not
of objects that are placed on the ground themselves. A vehicle touches the ground with the bounding
boxes of its links, at the joint values of the scene file. An object touches it with its collision
shape; without ``<physics>`` these are the convex hulls of the materials of its mesh.
"""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..base.geometry import Array, Pose, rotation_about, rpy_from_rotation, xyz_from_rotation
from ..base.numerics.linear import length, product
from ..base.numerics.polyline import Polyline
from ..errors import Diagnostic, SceneError
from ..scene.object import CourseSpec, ObjectSpec, PhysicsSpec
from ..scene.on_floor import OnFloorSpec
from ..scene.spec import SceneSpec, has_floor_placement
from ..scene.urdf.kinematics import link_poses
from ..scene.vehicle import VehicleSpec
from ..schema import diagnostic_at
from .body_names import object_body
from .collision.ground import Ground, triangles_of
from .collision.scene_shapes import collision_shapes, fixed_faces
from .resolved_scene import ResolvedScene
from .terrain import height_grids

GROUND_SPACING, SMOOTHING = 0.2, 2.0
"""The distance of points of a course on the ground [m], and the length over which its height is the
mean of the ground's height [m]."""
HULL_PHYSICS = PhysicsSpec(collision_shape_type="trimesh")
"""The physics with the shapes of an object without ``<physics>``: the hulls of its materials."""


def set_on_floor(resolved_scene: ResolvedScene) -> SceneSpec:
    """Return the scene with every ``u:onFloor`` resolved to a pose.

    Raises:
        SceneError: there is no ground under a body; the error lists all such bodies.
    """
    scene = resolved_scene.scene
    if not has_floor_placement(scene):
        return scene
    floor = Floor(resolved_scene)
    diagnostics: list[Diagnostic] = []
    vehicles, objects = list(scene.vehicles), list(scene.objects)
    for i, vehicle in enumerate(vehicles):
        if vehicle.on_floor is not None and i in resolved_scene.robots:
            pose = floor.pose_of_vehicle(i, vehicle, vehicle.on_floor)
            if pose is None:
                diagnostics.append(floor.no_ground_error("vehicle", vehicle))
            else:
                vehicles[i] = _moved_vehicle(vehicle, pose)
    for i, spec in enumerate(objects):
        if spec.on_floor is not None and spec.course is not None:
            course = floor.course_on_ground(spec, spec.course, spec.on_floor.clearance)
            if course is None:
                diagnostics.append(floor.no_ground_error("object", spec))
            else:
                objects[i] = replace(spec, course=course, on_floor=None)
        elif spec.on_floor is not None:
            pose = floor.pose_of_object(i, spec, spec.on_floor)
            if pose is None:
                diagnostics.append(floor.no_ground_error("object", spec))
            else:
                objects[i] = _moved_object(spec, pose)
    if diagnostics:
        raise SceneError(diagnostics)
    return replace(scene, vehicles=tuple(vehicles), objects=tuple(objects))


def ground_faces(scene: SceneSpec, data_path: tuple[Path, ...]) -> dict[int, Array]:
    """Return the triangles of the ground in W, (n, 3, 3) [m], by the index of their object.

    Charts of the sea floor are left out: see `uwsim.model.terrain.height_grids`.
    """
    faces = {}
    for i, spec in enumerate(scene.objects):
        is_fixed = spec.has_contacts(in_water=True) and not spec.solid.is_loose
        is_placed = spec.on_floor is None and spec.bathymetry is None
        if is_placed and (is_fixed or spec.is_ground):
            faces[i] = fixed_faces(scene, i, spec.solid, data_path)
    return faces


class Floor:
    """The ground of a scene, for computing the poses of bodies that rest on it.

    Args:
        resolved_scene: the scene with its robots.
    """

    def __init__(self, resolved_scene: ResolvedScene) -> None:
        self._resolved_scene, self._scene = resolved_scene, resolved_scene.scene
        self.faces = ground_faces(resolved_scene.scene, resolved_scene.data_path)
        """The triangles of each object that is ground, in W, (n, 3, 3) [m], by object index."""
        self.grids = height_grids(resolved_scene.scene, resolved_scene.data_path)
        """The charts of the sea floor in W, by object index."""
        self.ground = Ground(
            np.concatenate([np.zeros((0, 3, 3)), *self.faces.values()]),
            tuple(self.grids.values()),
        )
        """The surface of all these objects together."""

    def body_of_vehicle(self, index: int, world_from_base: Pose) -> Array:
        """Return the triangles of a vehicle's link boxes in W, (n, 3, 3) [m]; n may be 0."""
        robot, vehicle = self._resolved_scene.robots[index], self._scene.vehicles[index]
        shapes = collision_shapes(self._resolved_scene, [index], {})
        poses = link_poses(robot, vehicle.joint_values)
        triangles = [np.zeros((0, 3, 3))]
        for name, parts in shapes.items():
            pose = poses[name.split("/", 2)[2]]
            base_from_link = Pose(np.array(vehicle.scale_factor) * pose.position, pose.rotation)
            triangles.append(triangles_of(parts, world_from_base @ base_from_link))
        return np.concatenate(triangles)

    def body_of_object(self, index: int, world_from_object: Pose) -> Array:
        """Return the triangles of an object's collision shapes in W, (n, 3, 3) [m]."""
        default = PhysicsSpec() if self._scene.requests_original_physics else HULL_PHYSICS
        file_physics = self._scene.objects[index].physics or default
        physics = PhysicsSpec(
            collision_shape_type=file_physics.collision_shape_type,
            collision_shape=file_physics.collision_shape,
        )  # a loose object, whose trimesh is its convex hull
        shapes = collision_shapes(self._resolved_scene, [], {index: physics})
        return triangles_of(shapes[object_body(index)], world_from_object)

    def pose_of_vehicle(self, index: int, vehicle: VehicleSpec, spec: OnFloorSpec) -> Pose | None:
        """Compute ``localized_from_base`` on the ground; None if there is no ground."""
        world_from_base = self._scene.world_from_localized @ vehicle.localized_from_base
        body = self.body_of_vehicle(index, world_from_base)
        return self._pose_on_ground(world_from_base, body, spec)

    def pose_of_object(self, index: int, object_spec: ObjectSpec, spec: OnFloorSpec) -> Pose | None:
        """Compute ``localized_from_object`` on the ground; None if there is no ground."""
        world_from_object = self._scene.world_from_localized @ object_spec.localized_from_object
        body = self.body_of_object(index, world_from_object)
        return self._pose_on_ground(world_from_object, body, spec)

    def course_on_ground(
        self, spec: ObjectSpec, course: CourseSpec, clearance: float
    ) -> CourseSpec | None:
        """Return a course whose line follows the ground; None if there is none below a part of it.

        The height of the line is the mean height of the ground over `SMOOTHING` of its length, and
        the clearance.

        Args:
            spec: the object.
            course: the course in the scene file.
            clearance: the height of the line above the ground [m].
        """
        world_from_object = self._scene.world_from_localized @ spec.localized_from_object
        line = Polyline(world_from_object.transform(course.line))
        n = max(1, math.ceil(line.length / GROUND_SPACING))
        points = np.array([line.position(line.length * i / n) for i in range(n + 1)])
        heights = [self.ground.height_at(point) for point in points]
        known_heights = [height for height in heights if height is not None]
        if len(known_heights) < len(heights):
            return None
        points[:, 2] = _moving_mean(np.array(known_heights)) + clearance
        places = world_from_object.inverse().transform(points)
        return replace(course, points=tuple(places.ravel().tolist()), bend_radius=0.0)

    def _pose_on_ground(self, world_from_body: Pose, body: Array, spec: OnFloorSpec) -> Pose | None:
        """Compute the pose on the ground, in L; None if there is no ground.

        Args:
            world_from_body: the pose in the scene file, in W.
            body: the triangles of the body at that pose, in W, (n, 3, 3) [m]; if there are none,
                the origin of the body is placed on the ground.
            spec: the ``<u:onFloor>`` of the body.
        """
        origin = world_from_body.position
        if not len(body):
            body = np.broadcast_to(origin, (1, 3, 3))
        if spec.align_to_slope:
            rotation = _rotation_to(self.ground.normal(body))
            body = product(body - origin, rotation.T) + origin
            world_from_body = Pose(origin, product(rotation, world_from_body.rotation))
        rise = self.ground.rise(body)
        if rise is None:
            return None
        position = origin + np.array([0.0, 0.0, rise + spec.clearance])
        pose = Pose(position, world_from_body.rotation)
        return self._scene.world_from_localized.inverse() @ pose

    def no_ground_error(self, kind: str, spec: VehicleSpec | ObjectSpec) -> Diagnostic:
        """Return the error that there is no ground below a body."""
        x, y, _ = spec.position
        location_text = "at this point" if len(self.ground) else "in this scene"
        return diagnostic_at(
            spec.on_floor,
            f"<u:onFloor>: no ground under the {kind} {spec.name!r} at x {x:g}, y {y:g} of the "
            f"file's frame. Expected an object 'terrain' or with <u:solid> 1 {location_text}",
            file=self._scene.path,
        )


def _moving_mean(heights: Array) -> Array:
    """Return the mean of heights at equal distances over `SMOOTHING`, less at the ends, (n,)."""
    half = round(SMOOTHING / GROUND_SPACING / 2.0)
    sums = np.concatenate([[0.0], np.cumsum(heights)])
    indices = np.arange(len(heights))
    half_widths = np.minimum(half, np.minimum(indices, indices[::-1]))
    low, high = indices - half_widths, indices + half_widths + 1
    means: Array = (sums[high] - sums[low]) / (high - low)
    return means


def _rotation_to(normal: Array) -> Array:
    """Return the smallest rotation that turns the z axis to an upward normal, (3, 3)."""
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


def _moved_object(spec: ObjectSpec, localized_from_object: Pose) -> ObjectSpec:
    x, y, z = localized_from_object.position.tolist()
    if spec.on_floor is not None and spec.on_floor.align_to_slope:
        spec = replace(spec, orientation=rpy_from_rotation(localized_from_object.rotation))
    return replace(spec, position=(x, y, z), on_floor=None)
