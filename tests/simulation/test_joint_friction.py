"""``<dynamics>`` of a URDF: damping and dry friction of the joints of a vehicle with dynamics."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.girona500 import SCENE, run
from tests.support.opened import open_scene
from uwsim.messages import JointState, header
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation
from uwsim.topics.ros_joint_state_to_arm import ROSJointStateToArmSpec

EFFORT = 60.0  # N m
SLEW = '<limit lower="-1.570796327" upper="0.5488" effort="100" velocity="1"/>'


def slewing(folder: Path, dynamics: str) -> Simulation:
    """A vehicle on which a constant effort turns the arm about the vertical; no weight acts."""
    text = (SCENE.parent / "g500ARM5.urdf").read_text()
    assert text.count(SLEW) == 1
    (folder / "own.urdf").write_text(text.replace(SLEW, SLEW + dynamics))
    scene = read_scene(SCENE).nominal_scene
    vehicle = replace(scene.vehicles[0], parts=(), file="own.urdf")
    arm = ROSJointStateToArmSpec(topic="/arm", vehicle_name="girona500")
    simulation = open_scene(
        replace(scene, vehicles=(vehicle,), objects=(), ros_interfaces=(arm,)), data_path=(folder,)
    )
    simulation.advance(0.0)
    nothing = np.zeros(0)
    message = JointState(
        header=header(0.0),
        name=["Slew"],
        position=nothing,
        velocity=nothing,
        effort=np.array([EFFORT]),
    )
    simulation.bus.publisher("/arm", JointState)(message)
    return simulation


def speed(simulation: Simulation) -> float:
    before = float(simulation.world.engine.joints(0)[0])
    run(simulation, 0.1)
    return (float(simulation.world.engine.joints(0)[0]) - before) / 0.1


def test_a_damped_joint_turns_at_effort_over_damping(tmp_path: Path) -> None:
    """Drag in the water takes some of the effort: less than 2 %."""
    simulation = slewing(tmp_path, '<dynamics damping="600"/>')
    run(simulation, 1.0)
    assert speed(simulation) == pytest.approx(EFFORT / 600.0, rel=0.02)


def test_dry_friction_holds_a_joint_up_to_its_size(tmp_path: Path) -> None:
    simulation = slewing(tmp_path, '<dynamics friction="70"/>')
    run(simulation, 1.0)
    assert abs(speed(simulation)) < 1e-4


def test_dry_friction_takes_its_share_of_the_effort(tmp_path: Path) -> None:
    simulation = slewing(tmp_path, '<dynamics damping="300" friction="30"/>')
    run(simulation, 1.0)
    assert speed(simulation) == pytest.approx((EFFORT - 30.0) / 300.0, rel=0.03)


def test_without_either_the_arm_is_fast(tmp_path: Path) -> None:
    simulation = slewing(tmp_path, "")
    run(simulation, 0.1)
    assert speed(simulation) > 0.5
