"""The time of simulating a tethered vehicle.

Run ``python benchmarks/tethers.py``. A Girona 500 at 50 m depth moves ahead on a tether of 200 m
and 100 segments in a current, above a sandy ground, with a step of 2 ms. The figure is simulated
time by CPU time, also without the tether. The target is 5.
"""

from __future__ import annotations

import time
from pathlib import Path
from tempfile import TemporaryDirectory

from measure import main

import uwsim
from uwsim.messages import TwistStamped

SCENE = """
<UWSimScene xmlns:u="urn:uwsim:1">
  <oceanState>
    <u:current>
      <u:constant> <u:velocity> <x>0.1</x> <y>0.2</y> <z>0</z> </u:velocity> </u:constant>
    </u:current>
  </oceanState>
  <vehicle>
    <name>girona500</name> <file>g500ARM5.urdf</file>
    <position> <x>0</x> <y>0</y> <z>-50</z> </position>
    <orientation> <r>M_PI</r> <p>0</p> <y>0</y> </orientation>
    <u:dynamics>g500_physical</u:dynamics>
  </vehicle>
  <object>
    <name>terrain</name> <file>terrain/seabed/sand.glb</file>
    <position> <x>0</x> <y>0</y> <z>-60</z> </position>
  </object>
  <rosInterfaces>
    <ROSTwistToPAT> <topic>/twist</topic> <vehicleName>girona500</vehicleName> </ROSTwistToPAT>
  </rosInterfaces>
  {forces}
</UWSimScene>
"""
"""The scene, with a place for the tether."""
TETHER = """<u:forces>
    <u:tether>
      <name>tether</name>
      <from> <body>girona500</body> <position> <x>-0.5</x> <y>0</y> <z>-0.5</z> </position> </from>
      <to> <position> <x>-100</x> <y>0</y> <z>0</z> </position> </to>
      <length>200</length> <segments>100</segments> <diameter>0.012</diameter>
      <bendingStiffness>{bending}</bendingStiffness>
    </u:tether>
  </u:forces>"""
DURATION = 20.0
"""The simulated time of a measurement [s]."""
TARGET = 5.0
"""The target of simulated time by CPU time [1]."""


def measure_factor(forces: str, folder: Path) -> float:
    """Return the simulated time by CPU time, in Python and compiled code."""
    file = folder / "scene.xml"
    file.write_text(SCENE.format(forces=forces))
    with uwsim.load(file, is_blind=True) as simulation:
        message = TwistStamped()
        message.twist.linear.x = 0.3
        simulation.publish("/twist", message)
        simulation.advance(1.0)  # loads compiled code
        start_time = time.process_time()
        simulation.advance(DURATION)
        return DURATION / (time.process_time() - start_time)


def measure() -> dict[str, object]:
    """Return the factors with and without the tether."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        factor = measure_factor(TETHER.format(bending=0.0), folder)
        return {
            "tether of 100 segments": round(factor, 2),
            "with bending": round(measure_factor(TETHER.format(bending=1.0), folder), 2),
            "without tether": round(measure_factor("", folder), 2),
            "target": TARGET,
            "meets_target": factor >= TARGET,
        }


if __name__ == "__main__":
    main(measure)
