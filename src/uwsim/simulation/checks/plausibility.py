"""Likely mistakes of a scene, each with its line and how a file accepts it.

`uwsim check` says it, and `uwsim bench` and `uwsim render` before anything moves. All are warnings:
no run is refused for them. `uwsim.scene.checks.plausibility` has their names.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Literal

from ...errors import Diagnostic, UwsimError
from ...model.collision.hull import hull_of
from ...model.collision.scene_shapes import simulated_solids
from ...model.dynamics import DYNAMICS, read_dynamics
from ...model.robots import read_robots
from ...model.scene_model import SceneModel
from ...scene.checks.plausibility import VehicleWarning, unless_meant
from ...scene.hydrodynamics.spec import VehicleHydrodynamics
from ...scene.object import PhysicsSpec
from ...scene.reader import scene_warnings
from ...scene.spec import SceneSpec
from ...scene.urdf.robot import RobotSpec
from ...schema import diagnostic_at
from ...sensors.dvl_sensor import DvlSensorSpec
from ...world import TIMESTEP
from .bottom import Bottom
from .mesh_warnings import mesh_warnings
from .object_plausibility import of_objects
from .place_warnings import place_warnings
from .start_plausibility import Starts
from .step_plausibility import step_warnings
from .thrust_warnings import thrust_said
from .vehicle_plausibility import OF_SIMULATED, candidate_of, size_said

MAX_VEHICLES = 50
"""Number of vehicles of a scene that are checked."""
MAX_LOOSE = 200
"""Number of free objects that are checked."""


def plausibility_warnings(
    scene: SceneSpec,
    robots: Mapping[int, RobotSpec],
    dynamics: Mapping[int, VehicleHydrodynamics],
    data_path: tuple[Path, ...] = (),
    timestep: float = TIMESTEP,
) -> list[Diagnostic]:
    """Report every likely mistake of a scene.

    Args:
        scene: spec of the scene.
        robots: the robot of each vehicle, by its number.
        dynamics: the hydrodynamics of each vehicle that is simulated, by its number.
        data_path: folders in which files are looked for.
        timestep: length of a step [s].
    """
    vehicles = sorted(robots)[:MAX_VEHICLES]
    found = []
    for index in vehicles:
        vehicle = scene.vehicles[index]
        for warning, child, text in _of_vehicle(scene, index, robots, dynamics, data_path):
            if text and warning not in vehicle.accepts:
                message = f"the vehicle {vehicle.name!r}: {text}. {unless_meant(warning)}"
                found.append(
                    diagnostic_at(vehicle, message, child, file=scene.path, severity="warning")
                )
    found += _of_velocity_logs(scene, vehicles, robots, data_path)
    for kind, index, text in _of_starts(scene, vehicles, robots, data_path):
        spec = (scene.vehicles if kind == "vehicle" else scene.objects)[index]
        if text:
            message = f"the {kind} {spec.name!r}: {text}. {unless_meant('start')}"
            found.append(
                diagnostic_at(spec, message, "position", file=scene.path, severity="warning")
            )
    loose = dict(list(loose_objects(scene, dynamics).items())[:MAX_LOOSE])
    for index, of_object, text in of_objects(scene, loose, data_path):
        thing = scene.objects[index]
        if text and of_object not in thing.accepts:
            message = f"the object {thing.name!r}: {text}. {unless_meant(of_object)}"
            found.append(
                diagnostic_at(thing, message, "physics", file=scene.path, severity="warning")
            )
    if dynamics:
        density = next(iter(dynamics.values())).density
        found += step_warnings(scene, loose, density, timestep, data_path)
    found += mesh_warnings(scene, dynamics, data_path)
    return found


def loose_objects(
    scene: SceneSpec, dynamics: Mapping[int, VehicleHydrodynamics]
) -> dict[int, PhysicsSpec]:
    """The objects that forces move, by number."""
    solids = simulated_solids(scene, dynamics)
    return {index: physics for index, physics in solids.items() if physics.is_loose}


def warnings_of(
    scene: SceneSpec, data_path: tuple[Path, ...], timestep: float = TIMESTEP
) -> list[Diagnostic]:
    """Report every likely mistake of a scene that is not open, and what is left out of it."""
    robots = read_robots(scene, data_path)
    dynamics = read_dynamics(scene, robots, data_path)
    return _all_warnings(scene, robots, dynamics, data_path, timestep)


def model_warnings(model: SceneModel) -> tuple[Diagnostic, ...]:
    """Report the same of a scene that is compiled, with the lines of its file."""
    found = _all_warnings(
        model.varied, model.robots, model.dynamics, model.data_path, model.timestep
    )
    return tuple(found)


def _all_warnings(
    scene: SceneSpec,
    robots: Mapping[int, RobotSpec],
    dynamics: Mapping[int, VehicleHydrodynamics],
    data_path: tuple[Path, ...],
    timestep: float,
) -> list[Diagnostic]:
    implausible = plausibility_warnings(scene, robots, dynamics, data_path, timestep)
    places = place_warnings(scene, robots, data_path)
    return [*places, *scene_warnings(scene, robots), *implausible]


def _of_vehicle(
    scene: SceneSpec,
    index: int,
    robots: Mapping[int, RobotSpec],
    dynamics: Mapping[int, VehicleHydrodynamics],
    data_path: tuple[Path, ...],
) -> Iterator[tuple[VehicleWarning, str, str]]:
    """Each check of a vehicle: its name, the element concerned, and a message or nothing."""
    hull = None
    with suppress(UwsimError):  # reported where models are checked
        hull = hull_of(scene, robots, index, data_path)
    if hull is not None:
        yield "size", "file", size_said(hull, robots[index])
    if index in dynamics:
        one = candidate_of(scene, index, robots[index], dynamics[index], hull)
        for warning, say in OF_SIMULATED.items():
            yield warning, DYNAMICS, say(one)
        yield "thrust", DYNAMICS, thrust_said(scene, index, robots[index], dynamics[index])


def _of_velocity_logs(
    scene: SceneSpec,
    vehicles: Sequence[int],
    robots: Mapping[int, RobotSpec],
    data_path: tuple[Path, ...],
) -> Iterator[Diagnostic]:
    """Report DVLs that find no bottom at the start."""
    logs = [
        (index, spec)
        for index in vehicles
        for spec in scene.vehicles[index].parts_of(DvlSensorSpec)
        if "bottom" not in scene.vehicles[index].accepts
        and robots[index].link(spec.relative_to) is not None
    ]
    with suppress(UwsimError):  # reported where models are checked
        bottom = Bottom(scene, data_path) if logs else None
        for index, spec in logs:
            if text := bottom and bottom.missed_by(spec, index, robots[index]):
                message = f"{spec.name!r}: {text}. {unless_meant('bottom')}"
                yield diagnostic_at(spec, message, file=scene.path, severity="warning")


def _of_starts(
    scene: SceneSpec,
    vehicles: Sequence[int],
    robots: Mapping[int, RobotSpec],
    data_path: tuple[Path, ...],
) -> Iterator[tuple[Literal["vehicle", "object"], int, str]]:
    """Each check of a start pose: kind, number, and a message or nothing."""
    loose = [index for index, solid in scene.solid_objects.items() if solid.is_loose]
    with suppress(UwsimError):  # reported where models are checked
        starts = Starts(scene, robots, data_path)
        for index in vehicles:
            if "start" not in scene.vehicles[index].accepts:
                yield "vehicle", index, starts.of_vehicle(index)
        for index in loose[:MAX_LOOSE]:
            if "start" not in scene.objects[index].accepts:
                yield "object", index, starts.of_object(index)
