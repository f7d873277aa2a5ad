"""Collision shapes of the bodies of a scene.

Every link of a vehicle, as the box around its collision geometry, else around what is seen of it;
a finger, a link at the end of a chain that a joint moves, as its mesh where that is convex. And the
objects that `uwsim.scene.spec.SceneSpec.solid_objects` names. Where a vehicle is simulated,
or the scene asks for the original's physics, an object is loose if it has a mass and is not
``isKinematic``; elsewhere it is fixed. Solid scenery without ``<physics>`` is its faces, a large
mesh those of `uwsim.model.collision.fixed_mesh`. Not modelled: contacts of a vehicle with
itself, of objects that stand still with each other; limits of objects; hollows between the hulls of
a link.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from ...assets.mesh import Model
from ...base.geometry import Array, Pose
from ...base.numerics.linear import product, rotate, transform_points
from ...scene.object import ObjectSpec, PhysicsSpec
from ...scene.spec import SceneSpec
from ...scene.urdf.kinematics import link_poses
from ...scene.urdf.robot import RobotSpec, VisualSpec
from ...scene.vehicle import VehicleSpec
from ..body_names import object_body, vehicle_body
from ..parts import object_models, visual_model
from ..resolved_scene import ResolvedScene
from .fixed_mesh import FixedMesh
from .ground import triangles_of
from .shapes import (
    TRIMESHES,
    CollisionShape,
    convex_shapes,
    fixed_mesh_of,
    seen_from,
    shapes_of,
)


def simulated_shapes(
    resolved: ResolvedScene, dynamics: Collection[int]
) -> dict[str, tuple[CollisionShape, ...]]:
    """Make the collision shapes of the engine; none where nothing is simulated.

    Args:
        resolved: the scene.
        dynamics: numbers of the vehicles that are simulated.
    """
    scene = resolved.scene
    if scene.has_uwsim_physics:
        return collision_shapes(resolved, resolved.robots, scene.solid_objects)
    solid = simulated_solids(scene, dynamics)
    if not solid and len(dynamics) < 2:
        return {}
    return collision_shapes(resolved, dynamics, solid)


def simulated_solids(scene: SceneSpec, dynamics: Collection[int]) -> Mapping[int, PhysicsSpec]:
    """Solid objects of the engine, by number; none where nothing is simulated."""
    if scene.has_uwsim_physics:
        return scene.solid_objects
    return scene.simulated_solids if dynamics else {}


def collision_shapes(
    resolved: ResolvedScene, vehicles: Collection[int], objects: Mapping[int, PhysicsSpec]
) -> dict[str, tuple[CollisionShape, ...]]:
    """Make the shapes of a scene, by the name of their body in the model.

    Args:
        resolved: the scene.
        vehicles: numbers of those that can be touched.
        objects: what each object that can be touched is, by its number.
    """
    scene, data_path = resolved.scene, resolved.data_path
    shapes: dict[str, tuple[CollisionShape, ...]] = {}
    load = object_models(scene, data_path)
    for index, physics in objects.items():
        thing = scene.objects[index]
        shapes[object_body(index)] = shapes_of(
            _touched_model(thing, physics, load),
            _object_from_mesh(thing),
            physics.collision_shape_type,
            is_fixed=not physics.is_loose,
            up=_up(thing, scene) if thing.is_ground else None,
            error=thing.contact_error,
        )
    for index in vehicles:
        robot = resolved.robots[index]
        fingers = _fingers(robot)
        stretches = _stretches(robot, scene.vehicles[index])
        for link in robot.links:
            boxes = [
                box
                for solid in link.solids
                for box in _solid_shapes(
                    solid,
                    stretches.get(link.name),
                    robot,
                    data_path,
                    is_finger=link.name in fingers,
                )
            ]
            if boxes:
                shapes[vehicle_body(index, link.name)] = tuple(boxes)
    return shapes


def _stretches(robot: RobotSpec, vehicle: VehicleSpec) -> dict[str, Array]:
    """What a vehicle's scale is in the frame of each link, (3, 3); nothing without a scale.

    An uneven scale is that of the joints as they are at the start: a box stays what it is.
    """
    if vehicle.scale_factor == (1.0, 1.0, 1.0):
        return {}
    poses = link_poses(robot, vehicle.joint_values)
    turns = {name: pose.rotation for name, pose in poses.items()}  # base_from_link
    return {
        name: product(turn.T, product(np.diag(vehicle.scale_factor), turn))
        for name, turn in turns.items()
    }


def _fingers(robot: RobotSpec) -> set[str]:
    """Links that a joint moves and that carry no other."""
    parents = {joint.parent for joint in robot.joints}
    return {joint.child for joint in robot.joints if joint.moves} - parents


def _solid_shapes(
    solid: VisualSpec,
    stretch: Array | None,
    robot: RobotSpec,
    data_path: tuple[Path, ...],
    *,
    is_finger: bool,
) -> list[CollisionShape]:
    """The collision shape of one shape of a link, in the link's frame."""
    model, scale = visual_model(solid, Path(robot.path).parent, data_path)
    link_from_solid = Pose.from_rpy(solid.position, solid.rpy)
    solid_from_mesh = np.diag([*scale, 1.0])
    if stretch is not None:
        turn = link_from_solid.rotation
        solid_from_mesh[:3, :3] = product(turn.T, product(stretch, turn)) * scale
        link_from_solid = Pose(rotate(stretch, link_from_solid.position), turn)
    shapes = convex_shapes(model, solid_from_mesh) if is_finger else None
    if shapes is None:
        shapes = shapes_of(model, solid_from_mesh, "box", is_fixed=False)
    return [
        replace(shape, body_from_shape=link_from_solid @ shape.body_from_shape) for shape in shapes
    ]


def standing_faces(
    scene: SceneSpec, index: int, physics: PhysicsSpec, data_path: tuple[Path, ...]
) -> Array:
    """Collision triangles of a fixed object in W, (n, 3, 3) [m].

    Args:
        scene: spec of the scene.
        index: number of the object.
        physics: what it is.
        data_path: folders in which files are looked for.
    """
    thing = scene.objects[index]
    world_from_object = scene.world_from_localized @ thing.localized_from_object
    model = _touched_model(thing, physics, object_models(scene, data_path))
    object_from_mesh = _object_from_mesh(thing)
    object_from_mesh = _object_from_mesh(thing)
    touched = touched_mesh(scene, index, physics, data_path)
    if touched is None:
        shapes = shapes_of(model, object_from_mesh, physics.collision_shape_type, is_fixed=True)
        return triangles_of(shapes, world_from_object)
    if not touched.is_exact:
        corners = touched.triangles().reshape(-1, 3)
        return world_from_object.transform(corners).reshape(-1, 3, 3)
    world_from_mesh = product(world_from_object.matrix, object_from_mesh)
    faces = np.concatenate([mesh.vertices[mesh.triangles] for mesh in model.meshes])
    corners = faces.astype(np.float64).reshape(-1, 3)
    triangles = transform_points(corners, world_from_mesh[:3, :3], world_from_mesh[:3, 3]).reshape(
        -1, 3, 3
    )
    return seen_from(np.array([0.0, 0.0, 1.0]), triangles) if thing.is_ground else triangles


def standing_box(
    scene: SceneSpec, index: int, physics: PhysicsSpec, data_path: tuple[Path, ...]
) -> Array:
    """Least and greatest coordinates in W of a fixed object's mesh, (2, 3) [m]."""
    thing = scene.objects[index]
    model = _touched_model(thing, physics, object_models(scene, data_path))
    world_from_object = scene.world_from_localized @ thing.localized_from_object
    world_from_mesh = product(world_from_object.matrix, _object_from_mesh(thing))
    corners = transform_points(model.box.corners(), world_from_mesh[:3, :3], world_from_mesh[:3, 3])
    return np.stack([corners.min(axis=0), corners.max(axis=0)])


def touched_mesh(
    scene: SceneSpec, index: int, physics: PhysicsSpec, data_path: tuple[Path, ...]
) -> FixedMesh | None:
    """Find what is touched of a fixed mesh, in the object's frame; None of what is another shape.

    Args:
        scene: spec of the scene.
        index: number of the object.
        physics: what it is.
        data_path: folders in which files are looked for.
    """
    if physics.is_loose or physics.collision_shape_type not in TRIMESHES:
        return None
    thing = scene.objects[index]
    model = _touched_model(thing, physics, object_models(scene, data_path))
    up = _up(thing, scene) if thing.is_ground else None
    return fixed_mesh_of(model, _object_from_mesh(thing), up=up, error=thing.contact_error)


def _touched_model(thing: ObjectSpec, physics: PhysicsSpec, load: Callable[[str], Model]) -> Model:
    """The model whose mesh is touched of an object."""
    return load(physics.collision_shape or thing.file)


def _object_from_mesh(thing: ObjectSpec) -> Array:
    """Where its mesh is on an object, with its scale, (4, 4) [m]."""
    return product(np.diag([*thing.scale_factor, 1.0]), thing.object_from_mesh.matrix)


def _up(thing: ObjectSpec, scene: SceneSpec) -> Array:
    """W's z in the axes of an object, (3,)."""
    world_from_object = scene.world_from_localized @ thing.localized_from_object
    up: Array = world_from_object.rotation[2]
    return up
