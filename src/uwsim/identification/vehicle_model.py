"""The vehicle whose coefficients are identified, as its files describe it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..base.geometry import Pose, rotation_from_quaternion
from ..base.numerics.linear import product
from ..devices.ardupilot import ArduPilotSpec, thrusters_of
from ..errors import BadSetting, UnknownName
from ..model.body_names import vehicle_body, vehicle_fin, vehicle_thruster
from ..physics.compile_scene import compile_scene
from ..physics.hydrodynamics import columns as c
from ..physics.hydrodynamics.free_vehicle import (
    actuators_in_water,
    free_vehicle,
    links_in_water,
)
from ..physics.hydrodynamics.kernel.free_step import FreeVehicle
from ..scene.hydrodynamics.spec import VehicleHydrodynamics
from ..scene.hydrodynamics.vehicle_sets import find_vehicle
from ..scene.sim_params import SimParamsSpec
from ..scene.spec import SceneSpec
from ..scene.vehicle import VehicleSpec

START = (0.0, 0.0, 50.0)
"""The position of the vehicle in the scene that is made for it, in L [m]."""
SURFACE_DISTANCE = 1e6
"""The height by which the surface is moved away from vehicles [m]."""
ROBOTS = {
    "g500_physical": "girona500_arm5e.urdf",
    "uwsim_compat": "girona500_arm5e.urdf",
}
"""The robots of bundled hydrodynamics files that have another name than the file."""
NORTH_EAST_DOWN = (math.pi, 0.0, -0.5 * math.pi)
"""The ``offsetr`` of scenes whose frame L is north, east, down [rad]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class VehicleModel:
    """A vehicle with its first guess of all coefficients."""

    name: str
    """The name of the vehicle in its scene."""
    hydrodynamics: VehicleHydrodynamics
    """The hydrodynamics file."""
    numbers: FreeVehicle
    """The numbers of the simulation."""
    link: str
    """The link whose coefficients are identified: that of the greatest displacement."""
    part: int
    """The index of this link among the links of `numbers`."""
    link_mass: float
    """The mass of this link [kg]."""
    link_centre: tuple[float, ...]
    """The centre of mass of this link, (3,) [m]."""
    link_inertia: tuple[float, ...]
    """The moments of inertia about the centre of mass: xx yy zz xy xz yz [kg m2]."""
    actuators: tuple[str, ...]
    """The names of thrusters and fins, in the order of `numbers`."""
    world_from_localized: Pose
    """The pose of L in W."""
    motors: Mapping[int, tuple[str, float]]
    """The thruster and the sign of each motor of an ArduPilot, of the vehicle's channels."""
    is_planar: bool = False
    """The mode in which heave, roll and pitch are held (`planar`)."""

    @property
    def thrusters(self) -> tuple[str, ...]:
        """The names of the thrusters."""
        return self._actuators(c.PROPELLER)

    @property
    def fins(self) -> tuple[str, ...]:
        """The names of the fins."""
        return self._actuators(c.FIN)

    def _actuators(self, role: float) -> tuple[str, ...]:
        rows = self.numbers.actuators
        return tuple(
            name for name, row in zip(self.actuators, rows, strict=True) if row[c.ROLE] == role
        )


def make_scene(
    vehicle: str, robot: str | None = None, *, position: tuple[float, float, float] = START
) -> SceneSpec:
    """Return a scene with one vehicle in deep water, in a frame north, east, down.

    Args:
        vehicle: a hydrodynamics file, or the name of a bundled one.
        robot: the URDF file; None: the file of the same name beside it, or the bundled one.
        position: the position of the vehicle in L [m].

    Raises:
        UnknownName: there is no such hydrodynamics file.
    """
    path = Path(vehicle)
    if path.suffix.lower() == ".xml" or path.is_file():
        if not path.is_file():
            raise BadSetting(f"{vehicle}: no such hydrodynamics file.")
        name, folder = path.stem, path.parent
    else:
        name, folder = find_vehicle(vehicle).stem, Path()
    file = robot or ROBOTS.get(name, f"{name}.urdf")
    return SceneSpec(
        sim_params=SimParamsSpec(offsetr=NORTH_EAST_DOWN),
        vehicles=(VehicleSpec(name=name, file=file, dynamics=name, position=position),),
        path=str(folder / "identification.xml"),
    )


def remove_surface(numbers: FreeVehicle) -> FreeVehicle:
    """Return a vehicle in deep water, whose height does not matter: a log may have any origin.

    Stratified water keeps its surface, below which its layers count.
    """
    world = numbers.world.copy()
    if world[c.N_LEVELS] == 0.0:
        world[c.SURFACE] += SURFACE_DISTANCE
    return numbers._replace(world=world)


def open_vehicle(scene: SceneSpec, name: str | None = None) -> VehicleModel:
    """Return a vehicle of a scene.

    Args:
        scene: the scene.
        name: the name of the vehicle, or of its hydrodynamics file; None: the only one with
            dynamics.

    Raises:
        UnknownName: the scene has no such vehicle with dynamics.
        UwsimError: a file of the scene is invalid.
    """
    model = compile_scene(scene.nominal_scene)
    choices = {model.scene.vehicles[i].name: i for i in model.dynamics}
    if name is None and len(choices) == 1:
        name = next(iter(choices))
    names = {**{model.dynamics[i].name: i for i in choices.values()}, **choices}
    if name not in names:
        raise UnknownName("vehicle with u:dynamics", name or "", tuple(choices))
    index = names[name]
    hydrodynamics, engine_model = model.dynamics[index], model.engine_model
    root = engine_model.body(vehicle_body(index, model.robots[index].root)).id
    numbers = remove_surface(free_vehicle(engine_model, root))
    link_ids = links_in_water(engine_model, root)
    links = [engine_model.body(i).name for i in link_ids]
    if not links:
        raise BadSetting(f"The vehicle {name!r} has no link with hydrodynamics.")
    part = int(np.argmax(numbers.bodies[:, c.DISPLACED_MASS]))
    body = link_ids[part]
    axes = rotation_from_quaternion(engine_model.body_iquat[body])
    inertia = product(axes * engine_model.body_inertia[body], axes.T)
    by_body = {vehicle_body(index, body.link): body.link for body in hydrodynamics.bodies}
    by_actuator = {
        **{vehicle_thruster(index, t.name): t.name for t in hydrodynamics.thrusters},
        **{vehicle_fin(index, fin.name): fin.name for fin in hydrodynamics.fins},
    }
    return VehicleModel(
        name=model.scene.vehicles[index].name,
        hydrodynamics=hydrodynamics,
        numbers=numbers,
        link=by_body[links[part]],
        part=part,
        link_mass=float(engine_model.body_mass[body]),
        link_centre=tuple(engine_model.body_ipos[body].tolist()),
        link_inertia=tuple(inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]].tolist()),
        actuators=tuple(
            by_actuator[engine_model.actuator(i).name]
            for i in actuators_in_water(engine_model, root)
        ),
        world_from_localized=scene.world_from_localized,
        motors=thrusters_of(model.scene.vehicles[index].parts_of(ArduPilotSpec)),
    )
