"""The servos of a simulated arm: they hold, go and carry as far as they are strong."""

from dataclasses import replace

import numpy as np
import pytest

from tests.simulation.girona500 import SCENE, TWIST, run
from tests.support.opened import open_scene
from uwsim.messages import JointState, header
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation
from uwsim.topics.ros_joint_state_to_arm import ROSJointStateToArmSpec

ARM = ROSJointStateToArmSpec(topic="/arm", vehicle_name="girona500")
SLEW, SHOULDER, ELBOW, ROTATE, OPENING = range(5)
STEPS = [0.002, 0.005, 0.01]


def make(timestep: float = 0.002) -> Simulation:
    scene = read_scene(SCENE).nominal_scene
    vehicle = replace(scene.vehicles[0], parts=())
    simulation = open_scene(
        replace(scene, vehicles=(vehicle,), objects=(), ros_interfaces=(TWIST, ARM)),
        timestep=timestep,
    )
    simulation.advance(0.0)
    return simulation


def command(simulation: Simulation, **given: list[float]) -> None:
    arrays = {name: np.array(given.get(name, [])) for name in ("position", "velocity", "effort")}
    message = JointState(header=header(0.0), name=[], **arrays)
    simulation.bus.publisher("/arm", JointState)(message)


def joints(simulation: Simulation) -> np.ndarray:
    return simulation.world.vehicles.find("girona500").joints


def pull(simulation: Simulation, link: str, force: float) -> None:
    """Let something pull a link down [N]."""
    state = simulation.world.engine
    state._data.xfrc_applied[state._model.body(f"vehicle/0/{link}").id, 2] = -force


@pytest.mark.parametrize("timestep", STEPS)
def test_an_arm_at_rest_stays_within_a_milliradian(timestep: float) -> None:
    simulation = make(timestep)
    wanted = joints(simulation)
    run(simulation, 1.0)
    farthest = 0.0
    for _ in range(round(2.0 / timestep)):
        simulation.advance()
        farthest = max(farthest, float(np.abs(joints(simulation) - wanted).max()))
    assert farthest < 1e-3


@pytest.mark.parametrize("timestep", STEPS)
def test_an_arm_goes_where_it_is_commanded_and_settles_within_a_milliradian(
    timestep: float,
) -> None:
    simulation = make(timestep)
    wanted = [-0.5, 1.2, 0.5, 2.0, 0.3]
    command(simulation, position=wanted)
    past = 0.0
    for _ in range(round(7.0 / timestep)):
        simulation.advance()
        past = max(past, joints(simulation)[SHOULDER] - wanted[SHOULDER])
    assert joints(simulation) == pytest.approx(wanted, abs=1e-3)
    assert past < 0.06


def test_a_joint_goes_no_faster_than_its_robot_file_says() -> None:
    simulation = make()
    command(simulation, position=[0.0, 1.5, 2.15, 0.0, 0.8])
    run(simulation, 0.8)
    assert joints(simulation)[SHOULDER] == pytest.approx(0.8, abs=0.03)


def test_a_velocity_is_followed_without_falling_behind() -> None:
    simulation = make()
    before = joints(simulation)
    command(simulation, velocity=[0.0, 0.2, 0.0, 0.0, 0.0])
    run(simulation, 4.0)
    command(simulation, velocity=[0.0] * 5)
    run(simulation, 4.0)
    assert joints(simulation) - before == pytest.approx([0.0, 0.8, 0.0, 0.0, 0.0], abs=3e-3)


def test_a_load_is_carried_without_sagging() -> None:
    simulation = make()
    wanted = joints(simulation)
    run(simulation, 1.0)
    pull(simulation, "part4_base", 50.0)
    run(simulation, 0.5)
    assert np.abs(joints(simulation) - wanted).max() > 0.01  # nobody told the servos
    run(simulation, 7.0)
    assert joints(simulation) == pytest.approx(wanted, abs=1e-3)


def test_a_load_beyond_its_strength_bends_the_arm() -> None:
    simulation = make()
    efforts = []
    pull(simulation, "part3", 600.0)
    for _ in range(round(1.0 / simulation.timestep)):
        simulation.advance()
        efforts.append(simulation.world.engine.actuation[0].servos.efforts)
    assert np.abs(efforts).max(axis=0)[[SHOULDER, ELBOW]].max() == pytest.approx(100.0)
    assert np.abs(np.array(efforts)[:, OPENING]).max() <= 10.0


def test_a_joint_that_was_let_go_is_held_where_it_is_found() -> None:
    simulation = make()
    command(simulation, effort=[0.0, 10.0, 0.0, 0.0, 0.0])
    run(simulation, 1.0)
    command(simulation, velocity=[0.0] * 5)
    run(simulation, 0.1)
    there = joints(simulation)
    run(simulation, 6.0)
    assert joints(simulation) == pytest.approx(there, abs=0.05)
    assert np.abs(simulation.world.engine.actuation[0].servos.velocities).max() < 1e-3


def test_an_effort_ends_at_that_of_the_urdf() -> None:
    simulation = make()
    command(simulation, effort=[0.0, -1e9, 0.0, 0.0, 0.0])
    simulation.advance()
    simulation.advance()
    assert simulation.world.engine.actuation[0].servos.efforts[SHOULDER] == pytest.approx(-100.0)
