"""A simulated Girona 500 in clear water: to make it, to steer it, to ask it."""

from collections.abc import Callable
from dataclasses import replace
from importlib import resources
from pathlib import Path

import numpy as np

from tests.support.opened import open_scene
from uwsim.currents import ConstantSpec, SceneContext
from uwsim.messages import Twist, TwistStamped, Vector3, header
from uwsim.scene.object import ObjectSpec
from uwsim.scene.reader import read_scene
from uwsim.scene.vehicle import VehicleSpec
from uwsim.simulation import Simulation
from uwsim.topics import InterfaceSpec
from uwsim.topics.ros_twist_to_pat import ROSTwistToPATSpec

SCENE = Path(str(resources.files("uwsim"))) / "data" / "scenes" / "currents-scene.xml"
TWIST = ROSTwistToPATSpec(topic="/twist", vehicle_name="girona500")


def make(
    interfaces: tuple[InterfaceSpec, ...] = (TWIST,),
    *,
    objects: tuple[ObjectSpec, ...] = (),
    change: Callable[[VehicleSpec], VehicleSpec] = lambda vehicle: vehicle,
    data_path: tuple[Path, ...] = (),
) -> Simulation:
    scene = read_scene(SCENE).nominal_scene
    vehicle = change(replace(scene.vehicles[0], parts=()))
    simulation = open_scene(
        replace(scene, vehicles=(vehicle,), objects=objects, ros_interfaces=interfaces),
        data_path=data_path,
    )
    simulation.advance(0.0)
    return simulation


def run(simulation: Simulation, seconds: float) -> None:
    for _ in range(round(seconds / simulation.timestep)):
        simulation.advance()


def position(simulation: Simulation, name: str = "girona500") -> np.ndarray:
    world = simulation.world.bodies.find(name).world_from_body
    return (simulation.world.model.scene.world_from_localized.inverse() @ world).position


def heading_deg(simulation: Simulation) -> float:
    world = simulation.world.bodies.find("girona500").world_from_body
    rotation = (simulation.world.model.scene.world_from_localized.inverse() @ world).rotation
    return float(np.degrees(np.arctan2(rotation[1, 0], rotation[0, 0])))


def set_current(simulation: Simulation, velocity: tuple[float, float, float]) -> None:
    simulation.world.water.set(
        ConstantSpec(velocity=velocity).bind(SceneContext(stream=simulation.world.stream))
    )


def vector(x: float, y: float, z: float) -> Vector3:
    return Vector3(x=x, y=y, z=z)


def command(simulation: Simulation, surge: float, sway: float) -> None:
    twist = Twist(linear=vector(surge, sway, 0.0), angular=vector(0.0, 0.0, 0.0))
    simulation.bus.publisher("/twist", TwistStamped)(TwistStamped(header=header(0.0), twist=twist))
