"""Joints of simulated vehicles that mimic joints which cannot move, or none."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

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
    base = simulation.world.body("r/base").world_from_body
    jaw = base.inverse() @ simulation.world.body("r/b").world_from_body
    assert jaw.rotation[0, 0] == pytest.approx(math.cos(held_at), abs=0.01)
