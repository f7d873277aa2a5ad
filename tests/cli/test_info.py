"""``uwsim info``: what a scene holds, in words and for programs."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from tests.support.opened import open_scene
from uwsim.assets.bundled import bundled_files
from uwsim.cli import main
from uwsim.scene.reader import read_scene
from uwsim.scene.unsupported import UNSIMULATED_ELEMENTS


def said(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert main(["info", *arguments]) == 0
    return capsys.readouterr().out


def test_a_scene_is_reported_before_anything_is_written_for_it(
    capsys: pytest.CaptureFixture[str],
) -> None:
    text = said(capsys, "currents-scene")
    for part in (
        "up is -z in the file's frame",
        "simulated in water (g500_physical)",
        "below it: blackbox 3.145 m down",
        "terrain 3.295 m down, at (3, 1.5, 4.81) m",
        "thrusters: surge_port, surge_starboard, heave_bow, heave_stern, sway",
        "joint Elbow: continuous, 0 to 2.15294 rad",
        "joint JawRotate: revolute, -3.14159 to 3.14159 rad",
        "640x480 px, 50° high, noise 0.02",
        "publishes at 10 Hz  sensor_msgs/msg/Image",
        "listens             geometry_msgs/msg/TwistStamped",
        "object[blackbox].orientation.y: uniform -0.1 to 0.1 rad",
        "waves (lines 10,",
    ):
        assert part in text


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in bundled_files("scenes") if name != "cirs"])
def test_every_bundled_scene_can_be_shown_and_json_says_the_same(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    text, found = said(capsys, name), json.loads(said(capsys, name, "--json"))
    assert list(found) == [
        "file", "frame", "water", "vehicles", "cameras", "sensors", "objects", "tethers", "topics",
        "services", "varies", "not_simulated", "warnings",
    ]  # fmt: skip
    assert found["vehicles"]
    assert found["objects"]
    assert bool(found["cameras"]) == ("<virtualCamera>" in Path(found["file"]).read_text())
    for kind in ("vehicles", "cameras", "objects", "tethers"):
        assert all(each["name"] in text for each in found[kind])
    assert all(topic["topic"] in text for topic in found["topics"])
    assert found["vehicles"][0]["below"][-1]["name"] == "terrain"


@pytest.mark.slow
def test_fins_and_the_drag_law_of_each_link_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    text = said(capsys, "remus-scene")
    assert "fins: upper_rudder (-0.237 to 0.237 rad), lower_rudder" in text
    assert "quadratic drag by a full matrix: base_link" in text
    assert "quadratic drag by each component's own speed: " in said(capsys, "currents-scene")


def test_topics_have_type_direction_and_rate_and_those_that_do_nothing_say_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(UNSIMULATED_ELEMENTS, ("rosInterfaces", "DVLSensorToROS"), "DVLSensorToROS")
    text = bundled_files("scenes")["currents-scene"].read_text()
    dvl = "<name>dvl</name> <relativeTo>base_link</relativeTo>"
    text = text.replace("<virtualCamera>", f"<dvlSensor>{dvl}</dvlSensor><virtualCamera>", 1)
    extra = "<DVLSensorToROS> <name>dvl</name> <topic>/dvl</topic> </DVLSensorToROS>"
    file = tmp_path / "a.xml"
    file.write_text(text.replace("</rosInterfaces>", f"{extra}</rosInterfaces>"))
    topics = {t["interface"]: t for t in json.loads(said(capsys, str(file), "--json"))["topics"]}
    assert topics["DVLSensorToROS"]["limit"] == "read, not simulated yet"
    assert topics["VirtualCameraToROSImage"]["limit"] == ""
    assert topics["VirtualCameraToROSImage"]["rate_hz"] == 10
    assert topics["ROSTwistToPAT"]["direction"] == "listens"
    assert topics["ROSTwistToPAT"]["rate_hz"] is None
    (line,) = [each for each in said(capsys, str(file)).splitlines() if "/dvl" in each]
    assert "read, not simulated yet" in line
    monkeypatch.undo()
    topics = {t["interface"]: t for t in json.loads(said(capsys, str(file), "--json"))["topics"]}
    assert {topic["limit"] for topic in topics.values()} == {""}
    assert topics["DVLSensorToROS"]["rate_hz"] == 10


def test_a_setting_is_applied_before_it_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    text = said(capsys, "visibility-scene", "--set", "oceanState.fog.density=0.4")
    assert "fog 0.4 1/m" in text


@pytest.mark.parametrize(
    ("scene", "parts"),
    [
        (
            "pier-waves-scene",
            (
                "m, jonswap of significant height 0.5 m, period 4.5 s\n",
                "physical water jerlov-1C: absorption (red, green, blue) (0.3646, 0.08623, ",
                "sun 0.65 rad high, irradiance 1; ripples of a wind of 4 m/s\n",
            ),
        ),
        (
            "wreck-physical-scene",
            (
                "m, level\n",
                "physical water jerlov-IB: ",
                "particles: marine snow 5000 1/m3, sediment that thrusters stir up\n",
            ),
        ),
    ],
)
def test_waves_water_light_and_particles_are_named(
    scene: str, parts: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    text = said(capsys, scene)
    unwrapped_text = re.sub(r"(?<=\S)\n  (?=scattering)", " ", text)
    assert all(part in unwrapped_text for part in parts)


def test_water_without_light_and_waves_without_a_period_are_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "a.xml"
    file.write_text(
        """<UWSimScene xmlns:u="urn:uwsim:1"> <oceanState> <windSpeed>0</windSpeed>
<u:waves> <u:uwsimOcean/>
<u:regularWave> <u:height>0.3</u:height> <u:period>2.5</u:period> </u:regularWave> </u:waves>
<u:water law="physical">
<u:absorption> <r>0.4</r> <g>0.1</g> <b>0.1</b> </u:absorption>
<u:scattering> <r>0.2</r> <g>0.2</g> <b>0.3</b> </u:scattering>
<u:sun> <u:irradiance>0</u:irradiance> </u:sun>
<u:ripples> <u:windSpeed>0</u:windSpeed> </u:ripples>
<u:particles> <u:bubbles> <u:source> <x>3</x> <y>0</y> <z>-9</z> </u:source> </u:bubbles>
</u:particles> </u:water> </oceanState> </UWSimScene>"""
    )
    text = said(capsys, str(file))
    for part in (
        "uwsimOcean of significant height 0 m, regularWave of height 0.3 m, period 2.5 s",
        "physical water of its coefficients: absorption (red, green, blue) (0.4, 0.1, 0.1) 1/m",
        "no sun; ripples of a wind of 0 m/s",
        "particles: bubbles 40 1/s from (3, 0, -9) m",
    ):
        assert part in text
    water = json.loads(said(capsys, str(file), "--json"))["water"]
    assert water["physical"]["scattering"] == [0.2, 0.2, 0.3]
    assert [wave["height"] for wave in water["waves"]] == [0.0, 0.3]


def test_a_scene_with_errors_is_refused_with_its_lines(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "a.xml"
    file.write_text("<UWSimScene>\n<vehicle><name>x</name></vehicle></UWSimScene>")
    assert main(["info", str(file)]) == 2
    assert f"{file}:2: " in capsys.readouterr().err


def test_topics_of_devices_are_listed_with_their_direction(
    capsys: pytest.CaptureFixture[str],
) -> None:
    found = json.loads(said(capsys, "two-vehicles-scene", "--json"))["topics"]
    mine = {each["topic"]: each for each in found if each["interface"] == "AcousticCommsDevice"}
    directions = {topic: (each["direction"], each["rate_hz"]) for topic, each in mine.items()}
    assert directions == {
        "/modem1/tx": ("listens", None),
        "/modem1/rx": ("publishes", None),
        "/modem1/energy": ("publishes", 1.0),
        "/modem2/tx": ("listens", None),
        "/modem2/rx": ("publishes", None),
    }


def test_every_topic_that_a_run_has_is_listed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "a.xml"
    file.write_text(ALL_KINDS_OF_TOPICS)
    found = json.loads(said(capsys, str(file), "--json"))["topics"]
    assert all(each["type"] for each in found)
    with open_scene(read_scene(file), is_blind=True) as simulation:
        assert {each["topic"] for each in found} == {f"/{name}" for name in simulation.bus.topics}


def test_a_vehicle_that_follows_a_frame_or_packets_does_not_stand_still(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "a.xml"
    file.write_text(ALL_KINDS_OF_TOPICS)
    moves = {
        v["name"]: v["moves"] for v in json.loads(said(capsys, str(file), "--json"))["vehicles"]
    }
    assert moves == {
        "girona500": "stands still",
        "ghost": "kinematic: follows the frame 'boat' of /tf",
        "sitl": "kinematic: goes where UDP datagrams at port 9002 put it",
    }


ALL_KINDS_OF_TOPICS = """<UWSimScene>
  <netTracingScript/>
  <CustomCommsChannel> <id>0</id> </CustomCommsChannel>
  <vehicle>
    <name>girona500</name> <file>data/scenes/g500ARM5.urdf</file>
    <objectPicker> <name>picker</name> <relativeTo>part4_base</relativeTo> <range>0.2</range>
    </objectPicker>
    <simulatedDevices> <echo> <name>echo1</name> <info>here</info> </echo> </simulatedDevices>
    <LedArray> <name>leds</name> <relativeTo>base_link</relativeTo> </LedArray>
    <CustomCommsDevice> <dccommsId>modem</dccommsId> <relativeTo>base_link</relativeTo>
      <txChannelId>0</txChannelId> <rxChannelId>0</rxChannelId> <mac>1</mac>
      <bitrate>1000</bitrate> </CustomCommsDevice>
  </vehicle>
  <vehicle> <name>ghost</name> <file>data/scenes/g500ARM5.urdf</file> <tf> <tfId>boat</tfId> </tf>
  </vehicle>
  <vehicle> <name>sitl</name> <file>data/scenes/g500ARM5.urdf</file> <fdm>9002</fdm> </vehicle>
  <rosInterfaces>
    <ROSImageToHUD> <width>4</width> <height>4</height>
      <imageTopic>/hud</imageTopic> <infoTopic>/hud_info</infoTopic> </ROSImageToHUD>
    <SimulatedDeviceROS>
      <echoROS> <name>echo1</name> <topic>/g500/echo1</topic> </echoROS>
    </SimulatedDeviceROS>
    <CustomCommsDeviceROS> <name>modem</name> <topic>/modem</topic> </CustomCommsDeviceROS>
  </rosInterfaces>
</UWSimScene>
"""


def test_an_object_on_the_floor_is_shown_where_it_is(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Not at the z of the file, which the floor replaces; so is a vehicle."""
    text = bundled_files("scenes")["currents-scene"].read_text()
    (place,) = re.findall(r"<object>\s*<name>blackbox</name>.*?(<z>.*?</z>)", text, re.S)
    found = {}
    for z, floor in (("<z>-7</z>", "<u:onFloor/>"), (place, "")):
        file = tmp_path / "a.xml"
        moved = re.sub(
            r"(<object>\s*<name>blackbox</name>.*?)<z>.*?</z>(\s*</position>)",
            rf"\1{z}\2 {floor}",
            text,
            count=1,
            flags=re.S,
        )
        file.write_text(moved.replace(place, place))
        objects = json.loads(said(capsys, str(file), "--json"))["objects"]
        found[floor] = next(each["position"] for each in objects if each["name"] == "blackbox")
    assert found["<u:onFloor/>"] == pytest.approx(found[""], abs=0.03)


def test_where_sensors_and_lamps_point_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    text, found = (
        said(capsys, "shipwreck-scene"),
        json.loads(said(capsys, "shipwreck-scene", "--json")),
    )
    points = {each["name"]: (each["kind"], each["points"]) for each in found["sensors"]}
    assert points["altimeter"] == ("rangeSensor", "looks down")
    assert points["scanner"] == ("u:scanningSonar", "looks forward; its top is up")
    assert points["headlight"][1].startswith("shines forward")
    assert all(words in text for _, words in points.values())
    assert not any("'altimeter'" in each for each in found["warnings"])


def test_a_benchmark_has_its_scene_levels_measures_and_outcome(
    capsys: pytest.CaptureFixture[str],
) -> None:
    text = said(capsys, "station-keeping")
    content = json.loads(said(capsys, "station-keeping", "--json"))
    assert content["scene"] == "open-water-scene"
    assert "uwsim info open-water-scene" in text
    assert f"levels ({content['n_levels']})" in text
    assert content["n_levels"] == len(content["levels"]["current"]) > 2
    assert content["measures"]["offset"] == "positionError"
    assert set(content["failures"]) == {"left"}
    assert f"ok: {content['success']}" in text
    assert "positionError" in content["observations"]["bluerov2"]


@pytest.mark.parametrize(
    "name", [n for n in bundled_files("benchmarks") if n in {"valve", "relay"}]
)
def test_a_benchmark_of_several_parameters_lists_each(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    content = json.loads(said(capsys, name, "--json"))
    numbers = [len(values) for values in content["levels"].values()]
    assert len(numbers) == 2
    assert content["units"]["current"] == "m/s"
    assert set(content["units"]) == set(content["levels"])
    assert content["n_levels"] == numbers[0] * numbers[1]
