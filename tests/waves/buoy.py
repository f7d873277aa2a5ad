"""A scene with an upright cylinder that floats in waves."""

from __future__ import annotations

from pathlib import Path

from tests.support.opened import open_scene
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation

RADIUS, LENGTH = 0.25, 2.0  # [m]
DENSITY = 1000.0  # [kg/m3]
ADDED_MASS, DAMPING = 45.0, 60.0  # in heave [kg], [N s/m]

ROBOT = f"""<robot name="buoy"> <link name="base_link"> <collision>
  <geometry> <cylinder radius="{RADIUS}" length="{LENGTH}"/> </geometry>
</collision> </link> </robot>"""
WATER = """<hydrodynamics name="buoy">
  <source>an upright cylinder of the tests</source>
  <body link="base_link">
    <mass>{mass}</mass> <inertia>60 60 6 0 0 0</inertia>
    <addedMass>150 150 {added} 50 50 0</addedMass>
    <linearDamping>100 100 {damping} 100 100 1</linearDamping>
    <volume>{volume}</volume>
    <centreOfMass> <x>0</x> <y>0</y> <z>-0.4</z> </centreOfMass>
    <shape>cylinder</shape> <size>{radius} {length}</size>
  </body>
</hydrodynamics>"""
SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <oceanState> <depth>{depth}</depth> <u:density>1000</u:density> {waves} </oceanState>
  <vehicle> <name>buoy</name> <file>buoy.urdf</file>
    <position> <x>{x}</x> <y>0</y> <z>{z}</z> </position>
    <u:dynamics>buoy</u:dynamics>
  </vehicle>
</UWSimScene>"""


def open_buoy(
    folder: Path, waves: str, *, draught: float = 1.2, depth: float = 100.0, x: float = 0.0
) -> Simulation:
    """Open a scene with a buoy at rest at its draught [m]."""
    area = 3.141592653589793 * RADIUS**2
    (folder / "buoy.urdf").write_text(ROBOT)
    (folder / "buoy.xml").write_text(
        WATER.format(
            mass=DENSITY * area * draught, added=ADDED_MASS, damping=DAMPING,
            volume=area * LENGTH, radius=RADIUS, length=LENGTH,
        )
    )  # fmt: skip
    file = folder / "scene.xml"
    file.write_text(
        SCENE.format(depth=depth, waves=f"<u:waves>{waves}</u:waves>" if waves else "", x=x,
                     z=0.5 * LENGTH - draught)
    )  # fmt: skip
    simulation = open_scene(read_scene(file))
    simulation.advance(0.0)
    return simulation
