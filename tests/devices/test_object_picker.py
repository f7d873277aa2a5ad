"""A picker takes what its ray meets, carries it and releases it, in every kind of physics."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.girona500 import make
from tests.simulation.small_robots import scene_of, shape, write_robot
from tests.support.opened import open_scene
from uwsim.devices.object_picker import ObjectPickerSpec
from uwsim.messages import Bool
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.spec import SceneSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.simulation import Simulation
from uwsim.topics.sensor_topic import RangeSensorToROSRangeSpec

PICKER = ObjectPickerSpec(name="hand", relative_to="base_link", range=0.5)
TOPIC = RangeSensorToROSRangeSpec(name="hand", topic="/range", rate=100)
RELEASE = Bool(data=True)


def thing(name: str, x: float, physics: PhysicsSpec | None = None) -> ObjectSpec:
    """A box of 0.15 m along x, its middle at x."""
    return ObjectSpec(
        name=name, file="objects/blackbox_uib_trimesh.osg", position=(x, 0.0, 0.0), physics=physics
    )


def scene(folder: Path, *objects: ObjectSpec, **given: object) -> SceneSpec:
    """A vehicle of 0.2 m in the origin whose picker looks ahead, and objects."""
    robot = write_robot(folder, f'<link name="base_link">{shape()}</link>')
    vehicle = VehicleSpec(name="rov", file=str(robot), parts=(PICKER,))
    return scene_of(vehicle, objects=objects, ros_interfaces=(TOPIC,), **given)


def move(simulation: Simulation, *to: float) -> None:
    vehicle = simulation.world.vehicles.find("rov")
    here = vehicle.world_from_base
    vehicle.place(replace(here, position=np.array(to)))


def test_a_picker_takes_what_comes_within_its_range_and_carries_it(tmp_path: Path) -> None:
    with open_scene(scene(tmp_path, thing("box", 1.0)), is_blind=True) as simulation:
        simulation.latest_message("/range")
        simulation.advance(0.1)
        assert simulation.latest_message("/range").range == 0.5  # the box is farther
        move(simulation, 0.5, 0.0, 0.0)
        simulation.advance(0.1)
        distance = simulation.latest_message("/range").range
        assert 0.3 < distance < 0.5
        move(simulation, 0.5, 2.0, 1.0)
        simulation.advance(0.1)
        assert simulation.pose("box").position == pytest.approx([1.0, 2.0, 1.0])
        assert simulation.latest_message("/range").range == distance


def test_what_is_released_stays_and_is_not_taken_again_before_the_next_command(
    tmp_path: Path,
) -> None:
    with open_scene(scene(tmp_path, thing("box", 0.4)), is_blind=True) as simulation:
        simulation.advance(0.1)
        simulation.publish("hand/release", RELEASE)
        simulation.advance(0.1)
        move(simulation, 0.0, 0.0, 1.0)
        simulation.advance(0.1)
        assert simulation.pose("box").position == pytest.approx([0.4, 0.0, 0.0])
        move(simulation, 0.0, 0.0, 0.0)
        simulation.publish("hand/release", Bool(data=False))
        simulation.advance(0.1)
        move(simulation, 0.0, 0.0, 1.0)
        simulation.advance(0.1)
        assert simulation.pose("box").position == pytest.approx([0.4, 0.0, 1.0])


def test_terrain_is_not_picked_up_nor_what_is_behind_something_else(tmp_path: Path) -> None:
    ground, box = thing("terrain", 0.3), thing("box", 0.5)
    with open_scene(scene(tmp_path, ground, box), is_blind=True) as simulation:
        simulation.advance(0.1)
        move(simulation, 0.0, 1.0, 0.0)
        simulation.advance(0.1)
        for name, x in (("terrain", 0.3), ("box", 0.5)):
            assert simulation.pose(name).position == pytest.approx([x, 0.0, 0.0])


def test_what_is_held_is_seen_by_rays_where_it_is_carried(tmp_path: Path) -> None:
    with open_scene(scene(tmp_path, thing("box", 0.4)), is_blind=True) as simulation:
        simulation.advance(0.1)
        move(simulation, 0.0, 0.0, 1.0)
        simulation.advance(0.1)
        ahead = np.array([[1.0, 0.0, 0.0]])
        rays, here = simulation.world.rays, simulation.pose("rov", frame="W")
        assert rays.cast(here, ahead, 10.0).distance[0] < 0.5
        below = replace(here, position=np.zeros(3))
        assert rays.cast(below, ahead, 10.0).distance[0] == np.inf


def test_what_is_held_is_saved(tmp_path: Path) -> None:
    spec = scene(tmp_path, thing("box", 0.4))
    with open_scene(spec, is_blind=True) as first, open_scene(spec, is_blind=True) as second:
        first.advance(0.1)
        second.restore(first.save())
        for each in (first, second):
            move(each, 0.0, 3.0, 0.0)
            each.advance(0.1)
        assert second.pose("box").position == pytest.approx([0.4, 3.0, 0.0])
        second.publish("hand/release", RELEASE)
        second.advance(0.1)
        move(second, 0.0, 0.0, 0.0)
        second.restore(second.save())
        assert second.pose("box").position == pytest.approx([0.4, 3.0, 0.0])


def test_in_uwsims_physics_it_hangs_on_the_vehicle_and_falls_when_released(tmp_path: Path) -> None:
    loose = thing("box", 0.4, PhysicsSpec(mass=2.0))
    spec = scene(tmp_path, loose)
    spec = replace(spec, sim_params=replace(spec.sim_params, enable_physics=True))
    with open_scene(spec, is_blind=True) as simulation:
        simulation.advance(1.0)
        assert simulation.pose("box").position == pytest.approx([0.4, 0.0, 0.0], abs=1e-3)
        simulation.publish("hand/release", RELEASE)
        simulation.advance(1.0)
        assert simulation.pose("box").position[2] == pytest.approx(-0.5, abs=0.02)  # 1 m/s2


def loaded(mass: float, *, held: bool) -> tuple[Simulation, float]:
    """A Girona 500 with a box below it, in its picker or not; and how high it is after 1.5 s."""
    picker = replace(PICKER, look_at="down", range=2.0 if held else 0.01)
    physics = PhysicsSpec(mass=mass, volume=0.001)
    boxes: list[ObjectSpec] = []

    def change(vehicle: VehicleSpec) -> VehicleSpec:
        x, y, z = vehicle.position
        boxes.append(replace(thing("box", 0.0, physics), position=(x, y, z + 1.4)))
        return replace(vehicle, parts=(picker,))

    make((), change=change)  # the objects are made with the vehicle
    simulation = make((), objects=tuple(boxes), change=change)
    simulation.advance(1.5)
    return simulation, simulation.pose("girona500", frame="W").position[2]


def test_a_simulated_vehicle_bears_the_weight_of_what_it_holds() -> None:
    free, height = loaded(6.0, held=False)
    holding, lower = loaded(6.0, held=True)
    with free, holding:
        assert lower < height - 0.002
        before = holding.pose("box", frame="girona500")
        holding.advance(0.5)
        after = holding.pose("box", frame="girona500")
        assert after.position == pytest.approx(before.position, abs=2e-3)
        assert free.pose("box", frame="W").position[2] < lower - 1.9  # it sank
        holding.publish("hand/release", RELEASE)
        holding.advance(1.5)
        assert holding.pose("box", frame="girona500").position[2] > before.position[2] + 0.3
