"""Scenes with the original's physics: ``enablePhysics`` 1, and no vehicle in simulated water."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.simulation.girona500 import SCENE, TWIST, command, position, run
from tests.support.opened import open_scene
from uwsim.base.geometry import Pose
from uwsim.benchmark.measures.collision import CollisionSpec
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.reader import read_scene
from uwsim.scene.sim_params import SimParamsSpec
from uwsim.simulation import Simulation

TANK, BLACKBOX = read_scene(SCENE).objects
BLACKBOX = replace(BLACKBOX, is_solid=None)  # in that scene a ghost, to be looked at
FLOOR = replace(TANK, physics=PhysicsSpec(mass=0.0, collision_shape_type="trimesh"))
FLOOR_DEPTH = 4.81  # of the image on the floor [m]
HEIGHT = 0.15  # of the black box [m]
OFFSET = (math.pi, 0.0, -math.pi / 2.0)


def box(x: float, y: float, depth: float, **physics: object) -> ObjectSpec:
    given = PhysicsSpec(**physics) if physics else None  # type: ignore[arg-type]
    return replace(
        BLACKBOX, position=(x, y, depth), orientation=(0.0, 0.0, 0.0), physics=given
    )  # fmt: skip


def play(*objects: ObjectSpec, vehicle: bool = True, **params: object) -> Simulation:
    """The Girona 500 stands at L (3, 1.5, 1.515), looks along y and is not simulated."""
    scene = read_scene(SCENE).nominal_scene
    plain = replace(scene.vehicles[0], parts=(), dynamics=None)
    simulation = open_scene(
        replace(
            scene,
            sim_params=SimParamsSpec(offsetr=OFFSET, enable_physics=True, **params),  # type: ignore[arg-type]
            vehicles=(plain,) if vehicle else (),
            objects=objects,
            ros_interfaces=(TWIST,) if vehicle else (),
        )
    )
    simulation.advance(0.0)
    return simulation


@pytest.mark.parametrize("vehicle", [True, False])
def test_a_thing_falls_with_one_metre_a_second_squared_whatever_it_weighs(vehicle: bool) -> None:
    light = replace(box(7.0, 1.5, 1.0), name="light")  # no <physics>: 1 kg, in the original too
    simulation = play(light, box(6.0, 1.5, 1.0, mass=50.0), vehicle=vehicle)
    run(simulation, 1.5)
    for name in ("light", "blackbox"):
        assert position(simulation, name)[2] == pytest.approx(1.0 + 0.5 * 1.5**2, abs=0.002)


def test_gravity_is_what_the_file_says_in_the_world() -> None:
    simulation = play(box(7.0, 1.5, 3.0, mass=2.0), gravity=(0.2, 0.0, 0.6))
    run(simulation, 1.0)
    # the world's x is y of L, its z is up
    assert position(simulation, "blackbox") == pytest.approx([7.0, 1.6, 2.7], abs=0.001)


def test_damping_takes_its_share_of_the_velocity_every_second() -> None:
    simulation = play(box(7.0, 1.5, 1.0, mass=3.0, linear_damping=0.5))
    run(simulation, 2.0)
    rate = math.log(2.0)
    fallen = 2.0 / rate - (1.0 - math.exp(-2.0 * rate)) / rate**2
    assert position(simulation, "blackbox")[2] == pytest.approx(1.0 + fallen, abs=0.003)


def test_a_thing_lands_on_the_floor_and_lies_there() -> None:
    simulation = play(FLOOR, box(3.0, 1.0, 4.5, mass=15.0))
    measure = CollisionSpec(name="hits", target="blackbox").bind(simulation.world.measure_view)
    measure.start()
    for _ in range(1500):
        simulation.advance()
        measure.update()
    assert position(simulation, "blackbox")[2] == pytest.approx(FLOOR_DEPTH - HEIGHT / 2, abs=0.003)
    assert {contact.other for contact in simulation.world.contacts.find("blackbox")} == {"terrain"}
    speed = math.sqrt(2.0 * (FLOOR_DEPTH - HEIGHT / 2 - 4.5))  # v^2 = 2 g h, g = 1
    assert measure.details["max_speed"] == pytest.approx(speed, rel=0.05)


@pytest.mark.parametrize(
    "physics",
    [
        {"mass": 0.0},
        {"is_kinematic": True},
        {
            "min_linear_limit": (0.0, 0.0, 0.0), "max_linear_limit": (0.0, 0.0, 0.0),
            "min_angular_limit": (0.0, 0.0, 0.0), "max_angular_limit": (0.0, 0.0, 0.0),
        },
    ],
)  # fmt: skip
def test_what_is_fixed_stays(physics: dict[str, object]) -> None:
    simulation = play(box(7.0, 1.5, 1.0, **physics))
    run(simulation, 1.0)
    assert position(simulation, "blackbox") == pytest.approx([7.0, 1.5, 1.0], abs=1e-9)


def test_the_ground_is_not_dropped_where_nobody_gave_it_physics() -> None:
    simulation = play(TANK, box(3.0, 1.0, 4.5, mass=15.0))
    before = simulation.world.bodies.find("terrain").world_from_body.position
    run(simulation, 3.0)
    assert np.array_equal(simulation.world.bodies.find("terrain").world_from_body.position, before)
    assert position(simulation, "blackbox")[2] == pytest.approx(FLOOR_DEPTH - HEIGHT / 2, abs=0.003)


def test_a_vehicle_moves_as_commanded_and_pushes_what_is_in_its_way() -> None:
    simulation = play(box(3.0, 3.5, 1.9, mass=15.0), gravity=(0.0, 0.0, 1e-9))
    measure = CollisionSpec(name="hits", target="girona500").bind(simulation.world.measure_view)
    measure.start()
    for step in range(2000):
        if step % 50 == 0:
            command(simulation, 0.4, 0.0)
        simulation.advance()
        measure.update()
    assert position(simulation) == pytest.approx([3.0, 1.5 + 0.4 * 3.9, 1.515], abs=0.01)
    assert position(simulation, "blackbox")[1] > 3.7
    assert measure.details["max_speed"] == pytest.approx(0.4, rel=0.1)


def test_where_nothing_is_loose_a_vehicle_touches_all_the_same() -> None:
    wall = replace(box(3.0, 4.0, 1.9, mass=0.0), scale_factor=(20.0, 2.0, 20.0))
    simulation = play(wall)
    for step in range(1500):
        if step % 50 == 0:
            command(simulation, 1.0, 0.0)
        simulation.advance()
    assert {contact.other for contact in simulation.world.contacts.find("girona500")} == {
        "blackbox"
    }


def test_an_arm_that_is_commanded_to_jump_pushes_and_stays_where_it_was_commanded() -> None:
    simulation = play(box(3.0, 3.5, 1.9, mass=15.0))
    before = [
        simulation.world.bodies.find(f"girona500/{link}").world_from_body
        for link in ("part2", "part3")
    ]
    run(simulation, 1.0)
    after = [
        simulation.world.bodies.find(f"girona500/{link}").world_from_body
        for link in ("part2", "part3")
    ]
    for one, other in zip(before, after, strict=True):
        assert isinstance(one, Pose)
        assert np.array_equal(one.matrix, other.matrix)


def test_the_same_scene_falls_to_the_same_bits() -> None:
    places = []
    for _ in range(2):
        simulation = play(FLOOR, box(3.0, 1.0, 4.5, mass=15.0), box(3.05, 1.1, 4.2, mass=2.0))
        run(simulation, 2.0)
        places.append(simulation.world.bodies.find("blackbox").world_from_body.matrix.tobytes())
    assert places[0] == places[1]


def test_without_enable_physics_everything_stands_still() -> None:
    scene = read_scene(SCENE).nominal_scene
    plain = replace(scene.vehicles[0], parts=(), dynamics=None)
    simulation = open_scene(
        replace(scene, vehicles=(plain,), objects=(box(7.0, 1.5, 1.0, mass=2.0),))
    )
    simulation.advance(0.0)
    before = simulation.world.bodies.find("blackbox").world_from_body.position
    run(simulation, 0.5)
    assert np.array_equal(simulation.world.bodies.find("blackbox").world_from_body.position, before)
