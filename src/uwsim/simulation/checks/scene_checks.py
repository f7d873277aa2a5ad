"""Errors and warnings of the simulated parts of a scene."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from ...errors import Diagnostic, SceneError, UwsimError
from ...model.body_names import object_body
from ...model.collision.scene_shapes import collision_shapes, simulated_solids
from ...model.dynamics import Search
from ...model.placement import set_on_floor
from ...model.robots import find_robot
from ...physics.free_objects import object_errors
from ...scene.hydrodynamics.spec import VehicleHydrodynamics
from ...scene.spec import SceneSpec
from ...scene.urdf.reader import read_urdf
from ...scene.urdf.robot import RobotSpec
from ...schema import diagnostic_at
from .plausibility import plausibility_warnings


def check_simulated(scene: SceneSpec, data_path: tuple[Path, ...] = ()) -> list[Diagnostic]:
    """Check the simulated parts of a scene: names, numbers, thrusters and shapes.

    Args:
        scene: spec of the scene.
        data_path: folders in which files are looked for.
    """
    robots: dict[int, RobotSpec] = {}
    arguments = dict(scene.expansion.arguments)
    for index, vehicle in enumerate(scene.vehicles):
        with suppress(UwsimError):  # reported where robots are checked
            path = find_robot(vehicle.file, scene.path, data_path)
            robots[index] = read_urdf(path, data_path=data_path, arguments=arguments)
    search = Search(scene, robots, data_path, is_thorough=True)
    found = [*search.found, *_object_errors(scene, search.dynamics, data_path)]
    if not any(diagnostic.severity == "error" for diagnostic in found):
        found += plausibility_warnings(scene, robots, search.dynamics, data_path)
    try:
        set_on_floor(scene, robots, data_path)
    except SceneError as error:
        found += error.diagnostics
    except UwsimError:  # reported where robots and models are checked
        pass
    return found


def _object_errors(
    scene: SceneSpec, dynamics: Mapping[int, VehicleHydrodynamics], data_path: tuple[Path, ...]
) -> list[Diagnostic]:
    """Report objects of which the engine can make no collision shape, or that it cannot move."""
    density = next(iter(dynamics.values())).density if dynamics else None
    found = []
    for index, physics in simulated_solids(scene, dynamics).items():
        try:
            made = collision_shapes(scene, {}, (), {index: physics}, data_path)
            if physics.is_loose:
                parts = made[object_body(index)]
                found += object_errors(scene.objects[index], physics, parts, density)
        except UwsimError as error:
            message = str(error).removesuffix(".")
            thing = scene.objects[index]
            found.append(diagnostic_at(thing, message, "physics", file=scene.path))
    return found
