"""Collision shapes of the bodies of a scene.

The shape of a link is the bounding box of its collision geometry, or of its visible geometry if
there is none. The shape of a finger (a moving link at the end of a chain) is its mesh if that is
convex. The objects are those of `uwsim.scene.spec.SceneSpec.solid_objects`. If a vehicle has
dynamics, or the scene requests the physics of the original UWSim, an object is loose if it has a
mass and is not ``isKinematic``; all other objects are fixed. The shape of a solid object without
``<physics>`` is the faces of its mesh; for a large mesh see `uwsim.model.collision.fixed_mesh`. Not
modelled: contacts of a vehicle with itself, or between fixed objects; limits of objects; hollows
between the hulls of a link.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from ...assets.dock_shape import keep_inner_sides
from ...assets.mesh import Model
from ...base.geometry import Array, Pose
from ...base.numerics.linear import product, rotate, transform_points
from ...bathymetry.sediment import FRICTION
from ...scene.object import ObjectSpec, PhysicsSpec
from ...scene.spec import SceneSpec
from ...scene.urdf.kinematics import link_poses
from ...scene.urdf.robot import RobotSpec, VisualSpec
from ...scene.vehicle import VehicleSpec
from ..body_names import object_body, vehicle_body
from ..parts import object_models, placed_model, visual_model
from ..resolved_scene import ResolvedScene
from ..terrain import floor_materials, height_grid
from .fixed_mesh import FixedMesh
from .ground import triangles_of
from .shapes import (
    TRIMESHES,
    CollisionShape,
    convex_shapes,
    fixed_mesh_of,
    orient_upwards,
    shapes_of,
)
from .terrain_shapes import terrain_shapes


def engine_shapes(
    resolved_scene: ResolvedScene, dynamics: Collection[int]
) -> dict[str, tuple[CollisionShape, ...]]:
    """Return the collision shapes of the engine by body; none if forces move nothing.

    Args:
        resolved_scene: the scene with its robots.
        dynamics: the indices of the vehicles with dynamics.
    """
    scene = resolved_scene.scene
    if scene.has_original_physics:
        return collision_shapes(resolved_scene, resolved_scene.robots, scene.solid_objects)
    solid = solid_objects_in_water(scene, dynamics)
    if not solid and len(dynamics) < 2:
        return {}
    return collision_shapes(resolved_scene, dynamics, solid)


def solid_objects_in_water(
    scene: SceneSpec, dynamics: Collection[int]
) -> Mapping[int, PhysicsSpec]:
    """Return the solid objects of the engine, by index; none if forces move nothing."""
    if scene.has_original_physics:
        return scene.solid_objects
    return scene.solid_objects_in_water if dynamics else {}


def collision_shapes(
    resolved_scene: ResolvedScene, vehicles: Collection[int], objects: Mapping[int, PhysicsSpec]
) -> dict[str, tuple[CollisionShape, ...]]:
    """Return the collision shapes of a scene, by the name of their body in the engine.

    Args:
        resolved_scene: the scene with its robots.
        vehicles: the indices of the vehicles that have contacts.
        objects: the physics of each object that has contacts, by the object's index.
    """
    scene, data_path = resolved_scene.scene, resolved_scene.data_path
    shapes: dict[str, tuple[CollisionShape, ...]] = {}
    load = object_models(scene, data_path)
    for index, physics in objects.items():
        spec = scene.objects[index]
        if (grid := height_grid(scene, spec, data_path)) is not None:
            world_from_object = scene.world_from_localized @ spec.localized_from_object
            frictions = [FRICTION.get(name) for name in floor_materials(spec)]
            shapes[object_body(index)] = terrain_shapes(
                grid, world_from_object.inverse(), frictions
            )
            continue
        model, object_from_mesh = _contact_model(scene, spec, physics, load)
        shapes[object_body(index)] = shapes_of(
            model,
            object_from_mesh,
            physics.collision_shape_type,
            is_fixed=not physics.is_loose,
            up=_vertical_axis(spec, scene) if spec.is_ground else None,
            error=spec.contact_error,
        )
    for index in vehicles:
        robot = resolved_scene.robots[index]
        fingers = _moving_leaf_links(robot)
        link_scales = _link_scales(robot, scene.vehicles[index])
        for link in robot.links:
            boxes = [
                box
                for solid in link.solids
                for box in _shapes_of_solid(
                    solid,
                    link_scales.get(link.name),
                    robot,
                    data_path,
                    is_finger=link.name in fingers,
                )
            ]
            if boxes:
                shapes[vehicle_body(index, link.name)] = tuple(boxes)
    return shapes


def _link_scales(robot: RobotSpec, vehicle: VehicleSpec) -> dict[str, Array]:
    """Return the vehicle's scale as a matrix in the frame of each link, (3, 3); empty if it is 1.

    A scale that differs by axis is applied at the initial joint values: boxes remain boxes.
    """
    if vehicle.scale_factor == (1.0, 1.0, 1.0):
        return {}
    poses = link_poses(robot, vehicle.joint_values)
    rotations = {name: pose.rotation for name, pose in poses.items()}  # base_from_link
    return {
        name: product(rotation.T, product(np.diag(vehicle.scale_factor), rotation))
        for name, rotation in rotations.items()
    }


def _moving_leaf_links(robot: RobotSpec) -> set[str]:
    parents = {joint.parent for joint in robot.joints}
    return {joint.child for joint in robot.joints if joint.moves} - parents


def _shapes_of_solid(
    solid: VisualSpec,
    link_scale: Array | None,
    robot: RobotSpec,
    data_path: tuple[Path, ...],
    *,
    is_finger: bool,
) -> list[CollisionShape]:
    model, scale = visual_model(solid, Path(robot.path).parent, data_path)
    link_from_solid = Pose.from_rpy(solid.position, solid.rpy)
    solid_from_mesh = np.diag([*scale, 1.0])
    if link_scale is not None:
        rotation = link_from_solid.rotation
        solid_from_mesh[:3, :3] = product(rotation.T, product(link_scale, rotation)) * scale
        link_from_solid = Pose(rotate(link_scale, link_from_solid.position), rotation)
    shapes = convex_shapes(model, solid_from_mesh) if is_finger else None
    if shapes is None:
        shapes = shapes_of(model, solid_from_mesh, "box", is_fixed=False)
    return [
        replace(shape, body_from_shape=link_from_solid @ shape.body_from_shape) for shape in shapes
    ]


def fixed_faces(
    scene: SceneSpec, index: int, physics: PhysicsSpec, data_path: tuple[Path, ...]
) -> Array:
    """Return the collision triangles of a fixed object that is no chart in W, (n, 3, 3) [m].

    Args:
        scene: the spec of the scene.
        index: the index of the object.
        physics: the physics of the object.
        data_path: the folders that are searched for files.
    """
    spec = scene.objects[index]
    world_from_object = scene.world_from_localized @ spec.localized_from_object
    load = object_models(scene, data_path)
    model, object_from_mesh = _contact_model(scene, spec, physics, load)
    contacts = contact_mesh(scene, index, physics, data_path)
    if contacts is None:
        shapes = shapes_of(model, object_from_mesh, physics.collision_shape_type, is_fixed=True)
        return triangles_of(shapes, world_from_object)
    if not contacts.is_exact:
        corners = contacts.triangles().reshape(-1, 3)
        return world_from_object.transform(corners).reshape(-1, 3, 3)
    world_from_mesh = product(world_from_object.matrix, object_from_mesh)
    faces = np.concatenate([mesh.vertices[mesh.triangles] for mesh in model.meshes])
    corners = faces.astype(np.float64).reshape(-1, 3)
    triangles = transform_points(corners, world_from_mesh[:3, :3], world_from_mesh[:3, 3]).reshape(
        -1, 3, 3
    )
    return orient_upwards(np.array([0.0, 0.0, 1.0]), triangles) if spec.is_ground else triangles


def fixed_box(
    scene: SceneSpec, index: int, physics: PhysicsSpec, data_path: tuple[Path, ...]
) -> Array:
    """Return the lower and upper corner of a fixed object's bounding box in W, (2, 3) [m]."""
    spec = scene.objects[index]
    if (grid := height_grid(scene, spec, data_path)) is not None:
        return grid.corners()
    load = object_models(scene, data_path)
    model, object_from_mesh = _contact_model(scene, spec, physics, load)
    world_from_object = scene.world_from_localized @ spec.localized_from_object
    world_from_mesh = product(world_from_object.matrix, object_from_mesh)
    corners = transform_points(model.box.corners(), world_from_mesh[:3, :3], world_from_mesh[:3, 3])
    return np.stack([corners.min(axis=0), corners.max(axis=0)])


def contact_mesh(
    scene: SceneSpec, index: int, physics: PhysicsSpec, data_path: tuple[Path, ...]
) -> FixedMesh | None:
    """Return the collision surface of an object in its frame; None if it is no fixed trimesh.

    A chart of the sea floor is none.

    Args:
        scene: the spec of the scene.
        index: the index of the object.
        physics: the physics of the object.
        data_path: the folders that are searched for files.
    """
    spec = scene.objects[index]
    if physics.is_loose or physics.collision_shape_type not in TRIMESHES or spec.bathymetry:
        return None
    load = object_models(scene, data_path)
    model, object_from_mesh = _contact_model(scene, spec, physics, load)
    up = _vertical_axis(spec, scene) if spec.is_ground else None
    return fixed_mesh_of(model, object_from_mesh, up=up, error=spec.contact_error)


def _contact_model(
    scene: SceneSpec, spec: ObjectSpec, physics: PhysicsSpec, load: Callable[[str], Model]
) -> tuple[Model, Array]:
    """Return the model of an object's contacts, and ``object_from_mesh``, (4, 4) [m].

    Of a dock, these are its inner sides, behind which plates make its walls.
    """
    model, matrix = placed_model(scene, spec, load(physics.collision_shape or spec.file))
    return (model if spec.dock is None else keep_inner_sides(model)), matrix


def _vertical_axis(spec: ObjectSpec, scene: SceneSpec) -> Array:
    """Return the z axis of W in the axes of an object, (3,)."""
    world_from_object = scene.world_from_localized @ spec.localized_from_object
    up: Array = world_from_object.rotation[2]
    return up
