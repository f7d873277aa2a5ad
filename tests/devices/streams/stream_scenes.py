"""A scene with a vehicle whose sensors and thrusters have streams of bytes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from tests.support.opened import open_scene
from uwsim.messages import UInt8MultiArray
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation

SCENE = """
<UWSimScene xmlns:u="urn:uwsim:1">
  <simParams> <offsetr> <x>M_PI</x> <y>0</y> <z>-M_PI_2</z> </offsetr> </simParams>
  <nedOrigin> <lat>41.9616</lat> <lon>2.8353</lon> </nedOrigin>
  <vehicle> <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>{x}</x> <y>-1</y> <z>{depth}</z> </position>
    <orientation> <r>0</r> <p>0</p> <y>0.5</y> </orientation>
    <imu> <name>imu</name> <relativeTo>base_link</relativeTo> <std>0.01</std> </imu>
    <gpsSensor> <name>gps</name> <relativeTo>base_link</relativeTo> <std>0</std> </gpsSensor>
    <pressureSensor> <name>pressure</name> <relativeTo>base_link</relativeTo> </pressureSensor>
    <rangeSensor> <name>altimeter</name> <relativeTo>base_link</relativeTo> <range>50</range>
      <position> <x>0</x> <y>0</y> <z>0.3</z> </position> <u:lookAt>down</u:lookAt>
    </rangeSensor>
    <dvlSensor> <name>dvl</name> <relativeTo>base_link</relativeTo> <u:lookAt>down</u:lookAt>
      <u:beamStd>0.005</u:beamStd>
    </dvlSensor>
    {streams}
    <u:dynamics>bluerov2_heavy</u:dynamics>
  </vehicle>
  <object> <name>floor</name> <file>terrain/pool/pool.glb</file>
    <position> <x>0</x> <y>0</y> <z>0</z> </position>
    <orientation> <r>M_PI</r> <p>0</p> <y>0</y> </orientation>
  </object>
  <rosInterfaces>
    <GPSSensorToROS> <name>gps</name> <topic>/gps</topic> <rate>4</rate> </GPSSensorToROS>
    <DVLSensorToROS> <name>dvl</name> <topic>/dvl</topic> <rate>10</rate> </DVLSensorToROS>
    <ImuToROSImu> <name>imu</name> <topic>/imu</topic> <rate>20</rate> </ImuToROSImu>
    <PressureSensorToROS> <name>pressure</name> <topic>/depth</topic> <rate>4</rate>
    </PressureSensorToROS>
    <RangeSensorToROSRange> <name>altimeter</name> <topic>/altitude</topic> <rate>4</rate>
    </RangeSensorToROSRange>
  </rosInterfaces>
</UWSimScene>
"""


def instrument(
    format: str, topic: str = "", *, name: str = "line", bytes_topic: str = "bytes", more: str = ""
) -> str:
    topics = f"<topic>{topic}</topic>" if topic else ""
    if bytes_topic:
        topics += f"<bytesTopic>{bytes_topic}</bytesTopic>"
    return (
        f"<u:instrumentStream> <name>{name}</name> <format>{format}</format> {topics} {more}"
        "</u:instrumentStream>"
    )


def open_streams(
    folder: Path, streams: str, *, depth: float = 1.5, x: float = 2.0, **options: Any
) -> Simulation:
    path = folder / "scene.xml"
    path.write_text(SCENE.format(streams=streams, depth=depth, x=x))
    return open_scene(read_scene(path), **options)


def record_bytes(simulation: Simulation, topic: str = "bytes") -> list[tuple[float, bytes]]:
    """Return a list to which each message of bytes will be added, with its time [s]."""
    messages: list[tuple[float, bytes]] = []
    simulation.bus.subscribe(
        topic,
        UInt8MultiArray,
        lambda message: messages.append((simulation.time, message.data.tobytes())),
    )
    return messages
