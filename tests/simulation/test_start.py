"""Where everything stands when a scene begins: what the file says, within the limits."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.messages import JointState
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.scene.urdf.kinematics import link_poses
from uwsim.simulation import Simulation
from uwsim.topics.arm_to_ros_joint_state import ArmToROSJointStateSpec

DATA = Path(str(resources.files("uwsim"))) / "data" / "scenes"
ORIGINALS = os.environ.get("UWSIM_ORIGINALS")
SCENES = sorted(DATA.glob("*.xml")) + sorted(
    Path(ORIGINALS).glob("scenes/*.xml") if ORIGINALS else ()
)
QUICK = ("cirs", "currents-scene", "dredging-scene", "grasp-scene", "visibility-scene")
STATES = "/states/{}"


@contextmanager
def begun(scene: SceneSpec) -> Iterator[Simulation]:
    """The scene at its first step, blind, with the joints of every vehicle published."""
    tell = tuple(
        ArmToROSJointStateSpec(topic=STATES.format(i), vehicle_name=vehicle.name)
        for i, vehicle in enumerate(scene.vehicles)
    )
    simulation = open_scene(replace(scene, ros_interfaces=tell), is_blind=True)
    try:
        yield simulation
    finally:
        simulation.close()


def check_joints(scene: SceneSpec, n_steps: int = 0) -> None:
    """Links, joint vector and JointState all show the values of the file."""
    with begun(scene) as simulation:
        inboxes = [
            simulation.bus.inbox(STATES.format(i), JointState) for i in range(len(scene.vehicles))
        ]
        simulation.advance(0.0)
        for _ in range(n_steps):
            simulation.advance()
        for index, vehicle in enumerate(scene.vehicles):
            robot = simulation.world.model.robots[index]
            expected = [
                min(max(value, joint.lower), joint.upper)
                for joint, value in zip(
                    robot.movable_joints, [*vehicle.joint_values, *[0.0] * 99], strict=False
                )
            ]
            assert simulation.world.vehicles.find(vehicle.name).joints == pytest.approx(
                expected, abs=1e-12
            )
            (message, *_) = inboxes[index].take()
            assert message.position == pytest.approx(expected, abs=1e-12)
            base = simulation.world.bodies.find(vehicle.name).world_from_body
            for link, base_from_link in link_poses(robot, expected).items():
                there = simulation.world.bodies.find(f"{vehicle.name}/{link}").world_from_body
                found = base.inverse() @ there
                assert np.allclose(found.position, base_from_link.position, atol=1e-9), link
                assert np.allclose(found.rotation, base_from_link.rotation, atol=1e-9), link


@pytest.mark.parametrize(
    "path",
    [path if path.stem in QUICK else pytest.param(path, marks=pytest.mark.slow) for path in SCENES],
    ids=lambda path: f"{path.parents[1].name}-{path.stem}",
)
def test_every_joint_begins_where_the_file_says(path: Path) -> None:
    check_joints(read_scene(path))


@pytest.mark.parametrize("name", ["cirs", "visibility-scene"])
def test_nobody_moves_the_joints_of_a_kinematic_vehicle(name: str) -> None:
    check_joints(read_scene(DATA / f"{name}.xml"), n_steps=100)


def test_beside_a_simulated_vehicle_the_joints_of_a_kinematic_one_stay() -> None:
    scene = read_scene(DATA / "currents-scene.xml").nominal_scene
    simulated = scene.vehicles[0]
    plain = replace(simulated, name="other", position=(6.0, 1.5, 2.0), dynamics=None)
    with begun(replace(scene, vehicles=(simulated, plain))) as simulation:
        simulation.advance(0.0)
        before = simulation.world.bodies.find("other/part4_jaw1").world_from_body
        for _ in range(500):
            simulation.advance()
        after = simulation.world.bodies.find("other/part4_jaw1").world_from_body
        assert np.array_equal(before.position, after.position)
        assert np.array_equal(before.rotation, after.rotation)
