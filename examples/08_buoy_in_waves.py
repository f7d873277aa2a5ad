"""Let a spar buoy float in a wind sea, and compare its heave with the motion of the surface.

The program writes the scene, the robot and its hydrodynamics. A buoy of 1.8 m draught follows
long waves; those of its natural period, 2.8 s, make it heave more than the surface.
"""

import math
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import uwsim

RADIUS, LENGTH, DRAUGHT = 0.15, 2.4, 1.8  # [m]
SECONDS, STEP = 300.0, 0.1  # of simulation time [s]
MASS = 1025.0 * math.pi * RADIUS**2 * DRAUGHT  # [kg]

ROBOT = '<robot name="buoy"> <link name="base_link"/> </robot>'
HYDRODYNAMICS = f"""<hydrodynamics name="buoy">
  <source>strip theory: added mass of a cylinder, and of a disc at its end</source>
  <density>1025</density>
  <body link="base_link">
    <mass>{MASS:.3f}</mass> <inertia>60 60 2 0 0 0</inertia>
    <centreOfMass> <x>0</x> <y>0</y> <z>-0.7</z> </centreOfMass>
    <addedMass>{MASS:.3f} {MASS:.3f} {1025 * 8 / 3 * RADIUS**3 / 2:.3f} 40 40 0</addedMass>
    <linearDamping>20 20 25 20 20 1</linearDamping>
    <volume>{math.pi * RADIUS**2 * LENGTH:.5f}</volume>
    <shape>cylinder</shape> <size>{RADIUS} {LENGTH}</size>
  </body>
</hydrodynamics>"""
SCENE = f"""<UWSimScene xmlns:u="urn:uwsim:1">
  <oceanState> <depth>30</depth>
    <u:waves> <u:jonswap> <u:significantHeight>0.6</u:significantHeight>
      <u:peakPeriod>5</u:peakPeriod> <u:spreading>10</u:spreading> </u:jonswap> </u:waves>
  </oceanState>
  <vehicle> <name>buoy</name> <file>buoy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>{0.5 * LENGTH - DRAUGHT:g}</z> </position>
    <u:dynamics>buoy</u:dynamics> </vehicle>
</UWSimScene>"""


def main() -> None:
    with TemporaryDirectory() as folder:
        for name, text in (("buoy.urdf", ROBOT), ("buoy.xml", HYDRODYNAMICS), ("sea.xml", SCENE)):
            (Path(folder) / name).write_text(text)
        with uwsim.load(Path(folder) / "sea.xml", seed=1) as simulation:
            buoy, waves = simulation.world.bodies.find("buoy"), simulation.world.water.waves
            heaves, elevations = [], []
            for _ in range(round(SECONDS / STEP)):
                simulation.advance(STEP)
                position = buoy.world_from_body.position
                heaves.append(position[2])
                elevations.append(waves.elevation(position[None], simulation.time)[0])
    sea, heave = 4.0 * np.std(elevations), 4.0 * np.std(heaves)
    print(f"significant height of the waves at the buoy {sea:.2f} m, of its heave {heave:.2f} m")


if __name__ == "__main__":
    main()
