"""What rays meet in a scene: objects and vehicles where they are, of their materials, no ghosts."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.acoustics import MATERIALS
from uwsim.base.geometry import Pose
from uwsim.messages import Point
from uwsim.messages import Pose as PoseMessage
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation

SCENE = """
<UWSimScene xmlns:u="urn:uwsim:1">
  <oceanState> <u:temperature>8</u:temperature> </oceanState>
  <vehicle> <name>rov</name> <file>bluerov2_heavy.urdf</file> {} </vehicle>
  <object>
    <name>terrain</name> <file>terrain/seafloor/terrain_noship.osg</file>
  </object>
  <object>
    <name>box</name> <file>objects/blackbox_uib_trimesh.osg</file>
    <position> <x>5</x> <y>0</y> <z>-3</z> </position>
    <u:acousticMaterial>concrete</u:acousticMaterial>
  </object>
  <rosInterfaces>
    <ROSPoseToPAT> <topic>/pose</topic> <vehicleName>rov</vehicleName> </ROSPoseToPAT>
  </rosInterfaces>
</UWSimScene>
"""
DOWN = np.array([[0.0, 0.0, -1.0]])


def make(folder: Path, inside: str = "") -> Simulation:
    file = folder / "scene.xml"
    file.write_text(SCENE.format(inside))
    return open_scene(read_scene(file), is_blind=True)


def below(simulation: Simulation, x: float, y: float) -> tuple[float, str]:
    """Distance and name of what is straight below a point at the surface."""
    rays = simulation.world.rays
    hits = rays.cast(Pose(np.array([x, y, 0.0]), np.eye(3)), DOWN, 100.0)
    return float(hits.distance[0]), simulation.world.scenery.part_names[int(hits.surface[0])]


def test_a_vehicle_is_met_where_it_is_now(tmp_path: Path) -> None:
    with make(tmp_path) as simulation:
        assert below(simulation, 9.0, 3.0)[1] == "terrain"
        simulation.publish("/pose", PoseMessage(position=Point(x=9.0, y=3.0, z=-2.0)))
        simulation.advance(0.01)
        distance, name = below(simulation, 9.0, 3.0)
        assert name == "rov/base_link"
        assert distance == pytest.approx(2.0, abs=0.4)
        assert below(simulation, 0.0, 0.0)[1] == "terrain"


def test_materials_are_those_of_the_file(tmp_path: Path) -> None:
    with make(tmp_path) as simulation:
        names = simulation.world.scenery.part_names
        materials = {name: simulation.world.rays.materials[i] for i, name in names.items()}
        assert materials == {
            "rov/base_link": MATERIALS["steel"],
            "terrain": MATERIALS["sand"],
            "box": MATERIALS["concrete"],
        }
        assert below(simulation, 5.0, 0.0)[1] == "box"


def test_ghosts_are_not_met(tmp_path: Path) -> None:
    with make(tmp_path, "<vr>1</vr>") as simulation:
        assert below(simulation, 0.0, 0.0)[1] == "terrain"


def test_the_water_is_that_of_the_scene(tmp_path: Path) -> None:
    """Fresh where only a temperature is given, the sea where nothing is."""
    with make(tmp_path) as simulation:
        water = simulation.world.model.scene.ocean_state.sea_water
        assert (water.temperature, water.salinity) == (8.0, 0.0)
    file = tmp_path / "empty.xml"
    file.write_text("<UWSimScene/>")
    with open_scene(read_scene(file), is_blind=True) as simulation:
        water = simulation.world.model.scene.ocean_state.sea_water
        assert (water.temperature, water.salinity) == (15.0, 35.0)
