"""``uwsim run``: topics, rates, a recording, a program of one's own."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from rosbags.highlevel import AnyReader

from uwsim.cli import main
from uwsim.cli.simulated_time import read_duration
from uwsim.errors import BadSetting
from uwsim.simulation import Simulation

PAGE = (Path(__file__).parents[2] / "docs" / "running-a-scene.md").read_text()
SCENE = """<UWSimScene>
  <vehicle>
    <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>2</z> </position>
  </vehicle>
  <rosInterfaces>
    <PATToROSOdom>
      <topic>/odom</topic> <vehicleName>rov</vehicleName> <rate>20</rate>
    </PATToROSOdom>
    <ROSTwistToPAT> <topic>/twist</topic> <vehicleName>rov</vehicleName> </ROSTwistToPAT>
    <WorldToROSTF> <rootName>world</rootName> </WorldToROSTF>
  </rosInterfaces>
</UWSimScene>
"""
PROGRAM = """
from uwsim.messages import Odometry, TwistStamped

class Drive:
    PARAMETERS = {"speed": 0.2, "ends": 0.0}

    def start(self, node):
        self.node = node
        self.parameters = {**self.PARAMETERS, **node.parameters}
        self.publish = node.publisher("/twist", TwistStamped)
        node.create_timer(0.1, self.drive)

    def drive(self):
        if 0 < self.parameters["ends"] <= self.node.now:
            raise ValueError("too deep")
        message = TwistStamped()
        message.twist.linear.x = self.parameters["speed"]
        self.publish(message)
"""


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "scene.xml"
    path.write_text(SCENE)
    (tmp_path / "drive.py").write_text(PROGRAM)
    return path


def topics(out: str) -> dict[str, dict[str, object]]:
    return {each["topic"]: each for each in json.loads(out)["topics"]}


def test_hz_reports_how_often_messages_came(scene: Path, capsys: pytest.CaptureFixture) -> None:
    assert main(["run", str(scene), "--for", "500ms", "--hz", "--json"]) == 0
    found = topics(capsys.readouterr().out)
    assert found["/odom"]["message_type"] == "nav_msgs/msg/Odometry"
    assert (found["/odom"]["n_messages"], found["/odom"]["rate"]) == (11, pytest.approx(20))
    assert (found["/tf"]["n_messages"], found["/tf"]["rate"]) == (6, pytest.approx(10))
    assert found["/twist"]["is_published"] is False


def test_what_a_program_prints_is_no_part_of_the_json(
    tmp_path: Path, scene: Path, capsys: pytest.CaptureFixture
) -> None:
    program = tmp_path / "say.py"
    program.write_text(
        "class Say:\n"
        "    def start(self, node):\n"
        "        print('begins')\n"
        "        node.create_timer(0.1, lambda: print('goes on'))\n"
    )
    command = ["run", str(scene), "--for", "300ms", "--program", str(program), "--json"]
    assert main(command) == 0
    captured = capsys.readouterr()
    assert "/odom" in topics(captured.out)
    assert "begins" in captured.err
    assert "goes on" in captured.err


@pytest.mark.slow
def test_the_rates_on_the_page_are_those_of_its_command(capsys: pytest.CaptureFixture) -> None:
    shown = re.findall(r"^```console\n\$ uwsim (.*?--hz)\n(.*?)^```", PAGE, re.M | re.S)
    ((command, output),) = shown
    assert main(command.split()) == 0
    printed = {line.rstrip() for line in capsys.readouterr().out.splitlines()}
    assert {line for line in output.splitlines() if line != "..."} - printed == set()


def test_without_hz_topics_are_listed(scene: Path, capsys: pytest.CaptureFixture) -> None:
    assert main(["run", str(scene), "--for", "0.1s"]) == 0
    out = capsys.readouterr().out
    assert "/odom" in out
    assert "nav_msgs/msg/Odometry" in out
    assert "0.1 s of scene.xml, 50 steps" in out


def test_a_program_of_ones_own_drives_the_vehicle(
    scene: Path, capsys: pytest.CaptureFixture
) -> None:
    record = scene.with_name("run.mcap")
    call = ["run", str(scene), "--for", "1s", "--record", str(record)]
    program = ["--program", str(scene.with_name("drive.py")), "--set", "algorithm.speed=0.5"]
    assert main([*call, *program]) == 0
    with AnyReader([record]) as reader:
        odometry = [
            reader.deserialize(data, connection.msgtype).pose.pose.position.x
            for connection, _, data in reader.messages()
            if connection.topic == "/odom"
        ]
        of_scene = {"/tf_static", "/robot_description", "/scene"}
        assert {each.topic for each in reader.connections} == {"/odom", "/tf", "/twist"} | of_scene
    assert odometry[0] == 0.0
    assert odometry[-1] == pytest.approx(0.45, abs=0.06)
    assert "recorded:" in capsys.readouterr().out


def test_two_runs_have_the_same_bytes(scene: Path) -> None:
    for name in ("one.mcap", "other.mcap"):
        assert (
            main(["run", str(scene), "--for", "200ms", "--record", str(scene.parent / name)]) == 0
        )
    assert scene.with_name("one.mcap").read_bytes() == scene.with_name("other.mcap").read_bytes()


def test_a_recording_needs_its_folder(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = scene.parent / "nowhere"
    assert main(["run", str(scene), "--for", "1s", "--record", str(folder / "run.mcap")]) == 2
    assert f"there is no folder {folder}." in capsys.readouterr().err
    assert not folder.exists()


def test_a_run_says_what_is_left_out(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lost = "<imu> <name>lost</name> <relativeTo>nowhere</relativeTo> </imu></vehicle>"
    path = scene.with_name("lost.xml")
    path.write_text(scene.read_text().replace("</vehicle>", lost, 1))
    assert main(["run", str(path), "--for", "10ms"]) == 0
    assert "warning: <imu>: 'nowhere' is no link of" in capsys.readouterr().err


def test_a_program_that_raises_fails_the_run_and_the_recording_is_kept(
    scene: Path, capsys: pytest.CaptureFixture
) -> None:
    record = scene.with_name("run.mcap")
    call = ["run", str(scene), "--for", "1s", "--record", str(record)]
    program = ["--program", str(scene.with_name("drive.py")), "--set", "algorithm.ends=0.3"]
    assert main([*call, *program]) == 3
    assert "Drive raised: drive.py:15: ValueError: too deep" in capsys.readouterr().err
    with AnyReader([record]) as reader:
        assert reader.message_count > 20


def test_all_errors_of_the_options_are_reported_at_once(
    scene: Path, capsys: pytest.CaptureFixture
) -> None:
    (scene.parent / "there.mcap").write_text("x")
    (scene.parent / "two.py").write_text(PROGRAM + PROGRAM.replace("Drive", "Other"))
    options = ["--for", "4x", "--images", "jpg", "--record", str(scene.parent / "there.mcap")]
    program = ["--program", str(scene.parent / "two.py"), "--set", "vehicel.x=1"]
    assert main(["run", str(scene), *options, *program]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 5
    assert "expected one of the units ms, s, min, h" in lines[1]
    assert "Drive, Other" in lines[2]
    assert "expected one of raw, png, none" in lines[3]
    assert "--overwrite" in lines[4]


def test_a_parameter_needs_a_program(scene: Path, capsys: pytest.CaptureFixture) -> None:
    assert main(["run", str(scene), "--set", "algorithm.kp=1"]) == 2
    assert "sets a parameter of a program, but no --program is given" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "seconds"),
    [("10s", 10.0), ("500ms", 0.5), ("2min", 120.0), ("1.5", 1.5), ("1 h", 3600.0)],
)
def test_durations(text: str, seconds: float) -> None:
    assert read_duration(text) == seconds


@pytest.mark.parametrize("text", ["", "s", "-1s", "nan", "1e3s", "1e99", "999999999999h"])
def test_wrong_durations(text: str) -> None:
    with pytest.raises(BadSetting):
        read_duration(text)


@pytest.mark.slow
def test_ctrl_c_keeps_what_is_recorded(scene: Path) -> None:
    record = scene.with_name("run.mcap")
    process = subprocess.Popen(
        [sys.executable, "-m", "uwsim", "run", str(scene), "--for", "10h", "--record", str(record)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    folder = scene.parent / ".run.mcap.partial" / "recording"
    sizes: set[int] = set()  # the space is reserved in steps, the second one for messages
    while len(sizes) < 2:
        sizes |= {path.stat().st_size for path in folder.glob("*.mcap") if path.stat().st_size}
        time.sleep(0.05)
        assert process.poll() is None
    os.kill(process.pid, signal.SIGINT)
    out, said = process.communicate(timeout=30)
    assert process.returncode == 130
    assert said.splitlines()[-1].startswith("uwsim: interrupted")
    assert "/odom" in out
    with AnyReader([record]) as reader:
        assert reader.message_count > 0
    assert not list(scene.parent.glob(".run*"))


def test_a_run_that_is_stopped_before_its_first_step_says_so(
    scene: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def advance(self: Simulation, seconds: float | None = None) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Simulation, "advance", advance)
    assert main(["run", str(scene), "--hz"]) == 130
    said = capsys.readouterr().out
    assert said == "scene.xml: stopped before the first step; no topic has a message\n"


def test_a_run_of_no_time_still_lists_its_topics(
    scene: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", str(scene), "--for", "0s"]) == 0
    assert "/odom" in capsys.readouterr().out
