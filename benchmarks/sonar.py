"""Sonars over a rough sea floor: a ping of a multibeam, a frame of an imaging sonar.

A ping is all that a sample of the sensor does: where links are, rays, echoes, speckle, message. One
JSON on stdout.
"""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

from measure import main, milliseconds

import uwsim

SCENE = """
<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle>
    <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>-9</x> <y>5</y> <z>-11.5</z> </position>
    <multibeamSensor>
      <name>multibeam</name> <relativeTo>base_link</relativeTo>
      <position> <x>0</x> <y>0</y> <z>-0.4</z> </position>
      <initAngle>-60</initAngle> <finalAngle>60</finalAngle> <angleIncr>0.2345</angleIncr>
      <range>50</range>
    </multibeamSensor>
    {sonars}
  </vehicle>
  <object> <name>terrain</name> <file>terrain/shipwreck/terrain.osg</file> </object>
</UWSimScene>
"""
SONAR = """
    <u:imagingSonar>
      <name>rows{rows}</name> <relativeTo>base_link</relativeTo>
      <position> <x>0.4</x> <y>0</y> <z>0.1</z> </position>
      <orientation> <r>0</r> <p>0.3</p> <y>0</y> </orientation>
      <beams>512</beams> <bins>500</bins> <rows>{rows}</rows> <range>20</range>
    </u:imagingSonar>
"""
ROWS = (16, 32)


def measure() -> dict[str, object]:
    """Measure everything; the keys name the unit."""
    sonars = "".join(SONAR.format(rows=rows) for rows in ROWS)
    with TemporaryDirectory() as folder:
        scene = Path(folder) / "scene.xml"
        scene.write_text(SCENE.format(sonars=sonars))
        with uwsim.load(scene, is_blind=True) as simulation:
            world = simulation.world
            multibeam = world.sensors.sensor("multibeam", ("multibeamSensor",))
            n_beams = len(multibeam.sample(0.0).ranges)  # type: ignore[attr-defined]
            figures: dict[str, object] = {
                f"multibeam, {n_beams} beams": milliseconds(
                    lambda: multibeam.sample(0.0), target=0.1
                )
            }
            for rows in ROWS:
                sonar = world.sensors.sensor(f"rows{rows}", ("u:imagingSonar",))
                figures[f"imaging sonar, 512 x 500, {rows} rows"] = milliseconds(
                    lambda sonar=sonar: sonar.sample(0.0),  # type: ignore[misc]
                    target=3.0,
                    calls=10,
                )
                figures[f"its image, {rows} rows"] = milliseconds(
                    lambda sonar=sonar: sonar.image(0.0),  # type: ignore[misc]
                    calls=10,
                )
    return figures


if __name__ == "__main__":
    main(measure)
