"""The scene of an experiment: one vehicle of a scene, alone in still, deep water."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ..errors import BadSetting, UnknownName
from ..model.scene_model import SceneModel
from ..physics.compile_scene import compile_scene
from ..scene.hydrodynamics import VehicleHydrodynamics
from ..scene.sim_params import SimParamsSpec
from ..scene.spec import SceneSpec
from ..simulation import Simulation
from ..topics import InterfaceSpec
from ..topics.pat_to_ros_odom import PATToROSOdomSpec
from ..topics.thruster_commands import ROSFinsToPATSpec, ROSWrenchToPATSpec
from .steering import compute_added_mass, compute_mass, compute_steering

DEPTH = 100.0
"""The depth of an experiment, far from the surface [m]."""
ODOMETRY_RATE = 50.0
"""The rate of the odometry that steers the vehicle [1/s]."""
TOPICS = {"odometry": "/odometry", "wrench": "/wrench", "fins": "/fins"}
"""The topics of the vehicle in an experiment."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Experiment:
    """A vehicle for experiments: its compiled scene, its length and its steering."""

    model: SceneModel
    """The model of the scene."""
    length: float
    """The length L of the vehicle, by which distances are divided [m]."""
    parameters: dict[str, float | str]
    """The parameters of steering for manoeuvring algorithms."""

    @property
    def vehicle(self) -> str:
        """The name of the vehicle."""
        return self.model.scene.vehicles[0].name

    @property
    def hydrodynamics(self) -> VehicleHydrodynamics:
        """The hydrodynamics of the vehicle."""
        return self.model.dynamics[0]

    @property
    def is_steered_by_fins(self) -> bool:
        """True if fins turn the vehicle, not thrusters."""
        return self.parameters["yaw_moment"] == 0.0

    def open(self) -> Simulation:
        """Return a simulation at step 0."""
        return Simulation(self.model, is_blind=True)


def make_experiment(
    scene: SceneSpec,
    *,
    vehicle: str | None = None,
    length: float | None = None,
    data_path: Sequence[Path] = (),
) -> Experiment:
    """Prepare a vehicle of a scene for experiments.

    Sensors, devices, objects, currents and waves are left out; density and vehicle are kept.

    Args:
        scene: the scene.
        vehicle: the name of the vehicle; None: the first one with dynamics.
        length: the length of the vehicle [m]; None: that of the shape in its hydrodynamics file.
        data_path: more folders in which files are searched.

    Raises:
        BadSetting: no vehicle has dynamics, or neither fins nor thrusters can steer it.
        UnknownName: there is no such vehicle with dynamics.
    """
    candidates = [spec for spec in scene.vehicles if spec.dynamics is not None]
    if not candidates:
        raise BadSetting(
            "The scene has no vehicle with <u:dynamics>: only forces can move it in a manoeuvre."
        )
    names = [spec.name for spec in candidates]
    if vehicle is not None and vehicle not in names:
        raise UnknownName("vehicle with u:dynamics", vehicle, names)
    vehicle_spec = candidates[0 if vehicle is None else names.index(vehicle)]
    world_from_base = scene.world_from_localized @ vehicle_spec.localized_from_base
    roll = (
        0.0 if world_from_base.rotation[2, 2] < 0.0 else math.pi
    )  # z of the base points down or up in W
    placed_vehicle = replace(
        vehicle_spec,
        parts=(),
        on_floor=None,
        position=(0.0, 0.0, DEPTH),
        orientation=(roll, 0.0, 0.0),
    )
    state = scene.ocean_state
    experiment_scene = replace(
        scene,
        ocean_state=replace(state, ocean_surface_height=0.0, currents=(), waves=(), water=None),
        sim_params=replace(
            SimParamsSpec(), offsetp=(0.0, 0.0, 0.0), offsetr=(math.pi, 0.0, -0.5 * math.pi)
        ),
        camera=None,
        custom_comms_channels=(),
        acoustic_comms_channels=(),
        vehicles=(placed_vehicle,),
        objects=(),
        ros_interfaces=(),
        vary=(),
        forces=(),
    )
    has_fins = bool(compile_scene(experiment_scene, data_path=data_path).dynamics[0].fins)
    interfaces = _make_interfaces(vehicle_spec.name, has_fins=has_fins)
    model = compile_scene(replace(experiment_scene, ros_interfaces=interfaces), data_path=data_path)
    if length is None:
        length = find_length(model.dynamics[0])
    parameters = compute_steering(model, length)
    return Experiment(model=model, length=length, parameters=parameters)


def trim_vehicle(experiment: Experiment) -> Experiment:
    """Return the same vehicle with neutral buoyancy, as it is trimmed for a test of free decay.

    The displaced volume of its greatest body changes; everything else is the same.
    """
    dynamics, model = experiment.hydrodynamics, experiment.model
    body = max(dynamics.bodies, key=lambda body: body.volume)
    mass = float(compute_mass(model)[0] - compute_added_mass(dynamics)[0])
    other_volume = sum(other.volume for other in dynamics.bodies) - body.volume
    volume = mass / dynamics.density - other_volume
    if volume <= 0.0:
        return experiment
    scene = model.scene
    setting = (f"body[{body.link}].volume", repr(volume))
    vehicle = scene.vehicles[0]
    vehicle = replace(vehicle, hydrodynamics=(*vehicle.hydrodynamics, setting))
    trimmed_model = compile_scene(replace(scene, vehicles=(vehicle,)), data_path=model.data_path)
    return replace(experiment, model=trimmed_model)


def _make_interfaces(vehicle: str, *, has_fins: bool) -> tuple[InterfaceSpec, ...]:
    """Return the interfaces: odometry, and commands to thrusters and fins."""
    commands = (
        PATToROSOdomSpec(topic=TOPICS["odometry"], vehicle_name=vehicle, rate=ODOMETRY_RATE),
        ROSWrenchToPATSpec(topic=TOPICS["wrench"], vehicle_name=vehicle),
    )
    if not has_fins:
        return commands
    return (*commands, ROSFinsToPATSpec(topic=TOPICS["fins"], vehicle_name=vehicle))


def find_length(hydrodynamics: VehicleHydrodynamics) -> float:
    """Return the length of the greatest body's shape along x [m].

    Raises:
        BadSetting: the shape has no size.
    """
    body = max(hydrodynamics.bodies, key=lambda body: body.volume)
    if not body.size:
        raise BadSetting(
            f"The hydrodynamics file {hydrodynamics.name!r} has no <size> of its hull; give the "
            "length of the vehicle with --length."
        )
    return body.size[0] if body.shape == "box" else 2.0 * body.size[0]
