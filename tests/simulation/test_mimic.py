"""Joints of vehicles with dynamics that mimic joints which cannot move, or none."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.small_robots import begin, joint, scene_of, write_robot
from uwsim.scene.vehicle import VehicleSpec

HEAVY = (
    '<inertial><mass value="5"/>'
    '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
)
SET = """<hydrodynamics name="mine"><body link="base">
<mass>5</mass><volume>0.015</volume><shape>box</shape><size>0.25 0.25 0.24</size>
</body></hydrodynamics>"""


@pytest.mark.parametrize(("leader", "held_at"), [("stiff", 0.25), ("nobody", 0.0)])
def test_a_vehicle_whose_joint_mimics_what_cannot_move_is_simulated(
    leader: str, held_at: float, tmp_path: Path
) -> None:
    (tmp_path / "mine.xml").write_text(SET)
    follower = joint("jaw", "base b", kind="continuous").replace(
        "</joint>", f'<mimic joint="{leader}" multiplier="2" offset="0.25"/></joint>'
    )
    links = "".join(f'<link name="{name}">{HEAVY}</link>' for name in ("base", "a", "b"))
    file = write_robot(tmp_path, links + joint("stiff", "base a") + follower)
    vehicle = VehicleSpec(name="r", file=str(file), dynamics="mine", position=(0.0, 0.0, -5.0))
    scene = replace(scene_of(vehicle), path=str(tmp_path / "scene.xml"))
    simulation = begin(scene, is_blind=True)
    for _ in range(200):
        simulation.advance()
    base = simulation.world.bodies.find("r/base").world_from_body
    jaw = base.inverse() @ simulation.world.bodies.find("r/b").world_from_body
    assert jaw.rotation[0, 0] == pytest.approx(math.cos(held_at), abs=0.01)


@pytest.mark.parametrize("leader", ["a", "z"], ids=["before it", "after it"])
@pytest.mark.parametrize(
    ("multiplier", "offset"), [(0.5, 0.0), (2.0, 0.0), (-0.676, 0.149), (1.0, 0.2), (-1.0, 0.0)]
)
def test_a_geared_joint_follows_its_leader_while_it_moves(
    multiplier: float, offset: float, leader: str, tmp_path: Path
) -> None:
    """Not only at rest: its target moves as fast as the gear turns it."""
    (tmp_path / "mine.xml").write_text(SET)
    turns = '<axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="100" velocity="1"/></joint>'
    leads = joint(leader, "base a", kind="revolute").replace("</joint>", turns)
    follows = joint("m", "base b", kind="revolute").replace(
        "</joint>",
        f'<mimic joint="{leader}" multiplier="{multiplier}" offset="{offset}"/>{turns}',
    )
    links = "".join(f'<link name="{name}">{HEAVY}</link>' for name in ("base", "a", "b"))
    file = write_robot(tmp_path, links + leads + follows)
    vehicle = VehicleSpec(name="r", file=str(file), dynamics="mine", position=(0.0, 0.0, -5.0))
    simulation = begin(replace(scene_of(vehicle), path=str(tmp_path / "scene.xml")), is_blind=True)
    servos = simulation.world.vehicles.find("r").servos
    assert servos is not None
    servos.set_position_targets(np.array([0]), np.array([0.8]))
    for _ in range(15):
        simulation.advance(0.1)
        world_from_base = simulation.pose("r/base", frame="W").rotation
        angle_a, angle_b = (
            math.atan2(turn[1, 0], turn[0, 0])
            for turn in (
                world_from_base.T @ simulation.pose(f"r/{link}", frame="W").rotation
                for link in ("a", "b")
            )
        )
        assert angle_b == pytest.approx(multiplier * angle_a + offset, abs=2e-3)
    assert angle_a == pytest.approx(0.8, abs=0.01)
