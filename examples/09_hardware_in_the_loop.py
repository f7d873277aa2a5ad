"""Hold a depth over serial lines: a controller reads NMEA sentences and commands the thrusters.

The lines are pseudo-terminals. Controller and simulation take turns here, so the result does not
depend on the computer; ``uwsim run scene.xml --strict`` runs in real time.
"""

import os
from pathlib import Path
from tempfile import TemporaryDirectory

import uwsim
from uwsim.autopilots.instruments.commands import ThrusterCommands
from uwsim.autopilots.instruments.depth import read_depth

TARGET, GAIN, DAMPING, PERIOD = 2.0, 0.6, 1.0, 0.1  # [m], [1/m], [s/m], [s]
SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <simParams> <offsetr> <x>M_PI</x> <y>0</y> <z>-M_PI_2</z> </offsetr> </simParams>
  <vehicle> <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>0.5</z> </position>
    <pressureSensor> <name>pressure</name> <relativeTo>base_link</relativeTo> </pressureSensor>
    <u:instrumentStream> <name>line</name> <topic>/rov/depth</topic> <format>ISDPT</format>
      <address>pty:FOLDER/depth</address> <bitRate>9600</bitRate> </u:instrumentStream>
    <u:actuatorStream> <name>thrusters</name> <address>pty:FOLDER/thrusters</address>
      <rate>10</rate> <timeout>0.5</timeout> </u:actuatorStream>
    <u:dynamics>bluerov2_heavy</u:dynamics> </vehicle>
  <rosInterfaces> <PressureSensorToROS> <name>pressure</name> <topic>/rov/depth</topic>
    <rate>10</rate> </PressureSensorToROS> </rosInterfaces>
</UWSimScene>"""


class DepthHold:
    """A controller that is connected to two serial lines."""

    def __init__(self, folder: Path) -> None:
        self.depth_line, self.thruster_line = (
            os.open(folder / name, os.O_RDWR | os.O_NOCTTY) for name in ("depth", "thrusters")
        )
        self.depth = 0.5

    def step(self) -> bytes:
        """Read a sentence, and send a command that is a spring and a damper on the depth."""
        sentence = os.read(self.depth_line, 100)
        last_depth, self.depth = self.depth, read_depth(sentence).depth
        rate = (self.depth - last_depth) / PERIOD
        command = min(max(GAIN * (TARGET - self.depth) - DAMPING * rate, -1.0), 1.0)
        commands = ThrusterCommands(values=(0.0,) * 4 + (command,) * 4)
        os.write(self.thruster_line, commands.to_sentence().to_bytes())
        return sentence


with TemporaryDirectory() as folder:
    scene = Path(folder, "scene.xml")
    scene.write_text(SCENE.replace("FOLDER", folder))
    with uwsim.load(scene, udp_address="127.0.0.1") as simulation:
        controller = DepthHold(Path(folder))
        for i in range(201):
            simulation.advance(0.06 if i == 0 else PERIOD)
            sentence = controller.step().decode().strip()
            if i % 25 == 0:
                print(f"{simulation.time:5.2f} s  {sentence}")
