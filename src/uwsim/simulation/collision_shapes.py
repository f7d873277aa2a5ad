"""Which bodies of a scene can be touched, and with what shapes.

Every link of a vehicle, as the box around its collision geometry, else around what is seen of it,
and the objects that `uwsim.scene.spec.SceneSpec.solid_objects` names. Where a vehicle is simulated,
or the scene asks for the original's physics, an object is loose if it has a mass and is not
``isKinematic``; elsewhere it stands still. Not modelled: contacts of a vehicle with itself, of
objects that stand still with each other; limits of objects; hollows between the hulls of a link.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..geometry import Pose
from ..physics.compile import object_body, vehicle_body
from ..physics.shapes import Shape, shapes_of
from ..scene.spec import PhysicsSpec, SceneSpec
from ..scene.urdf import RobotSpec
from .scenery import object_model, visual_model


def simulated_shapes(
    scene: SceneSpec,
    robots: Mapping[int, RobotSpec],
    dynamics: Collection[int],
    data_path: tuple[Path, ...],
) -> dict[str, tuple[Shape, ...]]:
    """Make the shapes that the engine knows: none where it has nothing to simulate.

    Args:
        scene: what the file says.
        robots: the robot of each vehicle, by its number.
        dynamics: numbers of the vehicles that are simulated.
        data_path: folders in which files are looked for.
    """
    if scene.things_fall:
        return collision_shapes(scene, robots, robots, scene.solid_objects, data_path)
    given = {i: thing.solid for i, thing in enumerate(scene.objects) if thing.physics is not None}
    if not dynamics or not given:
        return {}
    return collision_shapes(scene, robots, dynamics, given, data_path)


def collision_shapes(
    scene: SceneSpec,
    robots: Mapping[int, RobotSpec],
    vehicles: Collection[int],
    objects: Mapping[int, PhysicsSpec],
    data_path: tuple[Path, ...],
) -> dict[str, tuple[Shape, ...]]:
    """Make the shapes of a scene, by the name of their body in the model.

    Args:
        scene: what the file says.
        robots: the robot of each vehicle, by its number.
        vehicles: numbers of those that can be touched.
        objects: what each object that can be touched is, by its number.
        data_path: folders in which files are looked for.
    """
    shapes: dict[str, tuple[Shape, ...]] = {}
    beside = Path(scene.path).parent if scene.path else None
    for index, physics in objects.items():
        thing = scene.objects[index]
        placed = np.diag([*thing.scale_factor, 1.0]) @ thing.object_from_mesh.matrix
        shapes[object_body(index)] = shapes_of(
            object_model(physics.collision_shape or thing.file, scene, beside, data_path),
            placed,
            physics.collision_shape_type,
            is_fixed=not physics.is_loose,
        )
    for index in vehicles:
        robot = robots[index]
        for link in robot.links:
            solid = link.collision or link.visual
            if solid is None:
                continue
            model = visual_model(solid, Path(robot.path).parent, data_path)
            link_from_mesh = np.diag([*solid.scale, 1.0])
            shapes[vehicle_body(index, link.name)] = tuple(
                replace(
                    shape,
                    body_from_shape=Pose.from_rpy(solid.position, solid.rpy)
                    @ shape.body_from_shape,
                )
                for shape in shapes_of(model, link_from_mesh, "box", is_fixed=False)
            )
    return shapes
