"""Logs as recordings: topics by type, by vehicle and by mapping."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import uwsim
from uwsim.errors import BadSetting
from uwsim.logs import LogMapping, read_log
from uwsim.messages import Float64MultiArray
from uwsim.middleware.recording import Recorder

SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <simParams> <offsetr> <x>M_PI</x> <y>0</y> <z>-M_PI_2</z> </offsetr> </simParams>
  {vehicles}
  <rosInterfaces> {interfaces} </rosInterfaces>
</UWSimScene>"""
VEHICLE = """<vehicle> <name>{name}</name> <file>bluerov2_heavy.urdf</file>
  <position> <x>{x}</x> <y>0</y> <z>5</z> </position>
  <imu> <name>{name}_imu</name> <relativeTo>base_link</relativeTo> <std>0</std> </imu>
  <u:dynamics>bluerov2_heavy</u:dynamics> </vehicle>"""
INTERFACES = """
  <PATToROSOdom> <topic>/{name}/odom</topic> <vehicleName>{name}</vehicleName> <rate>50</rate>
  </PATToROSOdom>
  <u:ROSThrustersToPAT> <u:topic>/{name}/thrusters</u:topic> <u:vehicleName>{name}</u:vehicleName>
  </u:ROSThrustersToPAT>
  <ImuToROSImu> <name>{name}_imu</name> <topic>/{name}/imu</topic> <rate>20</rate> </ImuToROSImu>"""


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("recording")
    names = ("left", "right")
    scene = folder / "two.xml"
    scene.write_text(
        SCENE.format(
            vehicles="".join(VEHICLE.format(name=name, x=4 * i) for i, name in enumerate(names)),
            interfaces="".join(INTERFACES.format(name=name) for name in names),
        )
    )
    path = folder / "two.mcap"
    with uwsim.load(scene) as simulation, Recorder(simulation.bus, path) as recorder:
        recorder.start(lambda: simulation.time)
        for k in range(10):
            data = np.full(8, 0.05 * k)
            simulation.publish("left/thrusters", Float64MultiArray(data=data))
            simulation.advance(0.1)
    return path


def test_a_recording_of_two_vehicles_needs_a_name(recording: Path) -> None:
    with pytest.raises(BadSetting, match=r"/left/odom, /right/odom\. Choose by --vehicle"):
        read_log(recording)


def test_the_topics_of_a_vehicle_are_read(recording: Path) -> None:
    log = read_log(recording, vehicle="left")
    assert (log.format, log.vehicle) == ("mcap", "left")
    assert log.motion is not None
    np.testing.assert_allclose(log.motion.times, 0.02 * np.arange(51), atol=1e-9)
    np.testing.assert_allclose(log.motion.positions[0], [0.0, 0.0, 5.0], atol=1e-9)
    [commands] = log.commands
    assert commands.kind == "thrusters"
    np.testing.assert_allclose(commands.values[:, 0], 0.05 * np.arange(10))
    assert log.sensors["imu"].names == ("ax", "ay", "az", "p", "q", "r")
    assert len(log.sensors["imu"].times) == 21


def test_a_vehicle_without_commands_has_a_motion(recording: Path) -> None:
    log = read_log(recording, vehicle="right")
    assert log.commands == ()
    assert log.motion is not None


def test_a_mapping_chooses_topics(recording: Path) -> None:
    mapping = LogMapping(
        topics={"odometry": "/right/odom", "thrusters": "/left/thrusters", "imu": "/left/imu"}
    )
    log = read_log(recording, mapping=mapping)
    assert log.motion is not None
    assert log.motion.positions[0, 0] == pytest.approx(4.0)
    assert len(log.sensors) == 1


def test_a_topic_that_does_not_exist_has_a_suggestion(recording: Path) -> None:
    mapping = LogMapping(path="map.toml", topics={"odometry": "/left/odm"})
    with pytest.raises(BadSetting, match=r"no topic '/left/odm'. Did you mean '/left/odom'"):
        read_log(recording, mapping=mapping)


def test_a_recording_with_no_vehicle_is_an_error(tmp_path: Path) -> None:
    path = tmp_path / "bad.mcap"
    path.write_bytes(b"nothing")
    with pytest.raises(uwsim.UwsimError, match="cannot be read"):
        read_log(path)


@pytest.mark.parametrize(
    ("topics", "n_commands"),
    [
        (("left/autopilot/sticks",), 0),
        (("left/autopilot/sticks", "left/autopilot/thrusters"), 8),
        (("left/thrusters", "left/autopilot/thrusters"), 8),
        (("left/joy",), 0),
        (("left/u",), 6),  # the only topic, of no known name
    ],
)
def test_the_commands_that_an_autopilot_applied_are_read_and_never_its_sticks(
    topics: tuple[str, ...], n_commands: int, tmp_path: Path
) -> None:
    scene = tmp_path / "one.xml"
    interface = INTERFACES.format(name="left").split("<u:ROSThrustersToPAT>")[0]
    vehicle = VEHICLE.format(name="left", x=0)
    scene.write_text(SCENE.format(vehicles=vehicle, interfaces=interface))
    path = tmp_path / "one.mcap"
    with uwsim.load(scene) as simulation, Recorder(simulation.bus, path) as recorder:
        publishers = [simulation.bus.publisher(topic, Float64MultiArray) for topic in topics]
        recorder.start(lambda: simulation.time)
        for _ in range(4):
            for topic, publish in zip(topics, publishers, strict=True):
                size = 8 if "thrusters" in topic else 6
                publish(Float64MultiArray(data=np.zeros(size)))
            simulation.advance(0.1)
    log = read_log(path)
    widths = [part.values.shape[1] for part in log.commands]
    assert widths == ([n_commands] if n_commands else [])
    if "left/autopilot/thrusters" in topics:
        assert log.commands[0].source == "/left/autopilot/thrusters"
