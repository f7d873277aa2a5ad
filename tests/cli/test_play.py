"""``uwsim play``: recordings alone, with ghosts, and with recorded commands."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from uwsim.cli import main
from uwsim.messages import Odometry
from uwsim.middleware.recording import BagReader

DRIVE = '''
from uwsim.messages import Odometry, JointState, TwistStamped, Twist, Vector3


class Drive:
    """Drives and moves the arm."""

    def start(self, node):
        self.twist = node.publisher("/g500/twist", TwistStamped)
        self.joints = node.publisher("/uwsim/joint_state_command", JointState)
        self.node = node
        node.create_timer(0.1, self.tick)

    def tick(self):
        self.twist(TwistStamped(twist=Twist(linear=Vector3(x=0.3), angular=Vector3(z=0.2))))
        self.joints(JointState(name=["Slew"], position=[0.1 * self.node.now]))
'''


@pytest.fixture(scope="module")
def dive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A recording of the scene cirs in which the vehicle is driven."""
    folder = tmp_path_factory.mktemp("dive")
    (folder / "drive.py").write_text(DRIVE)
    command = ["run", "cirs", "--program", str(folder / "drive.py"), "--for", "1s"]
    assert main([*command, "--images", "none", "--record", str(folder / "dive.bag")]) == 0
    return folder / "dive.bag"


def poses(path: Path, topic: str) -> np.ndarray:
    with BagReader(path) as reader:
        found = [message for _, name, message in reader.messages() if name == topic]
    assert all(isinstance(message, Odometry) for message in found)
    positions = [message.pose.pose.position for message in found]
    return np.array([[p.x, p.y, p.z] for p in positions])


@pytest.mark.slow
def test_a_recording_is_turned_into_the_other_kind(dive: Path, tmp_path: Path) -> None:
    assert main(["play", str(dive), "--record", str(tmp_path / "dive.mcap")]) == 0
    with BagReader(dive) as one, BagReader(tmp_path / "dive.mcap") as other:
        assert [repr(each) for each in one.messages()] == [repr(each) for each in other.messages()]


@pytest.mark.slow
def test_a_ghost_is_where_the_recorded_vehicle_was(
    dive: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "ghost.mcap"
    command = ["play", str(dive), "cirs", "--images", "none", "--record", str(out), "--json"]
    assert main(command) == 0
    topics = {each["topic"] for each in json.loads(capfd.readouterr().out)["topics"]}
    assert "/recorded/uwsim/girona500/odom" in topics
    before = poses(dive, "/uwsim/girona500/odom")
    ghost = poses(out, "/uwsim/girona500/odom")
    assert np.ptp(before[:, 0]) > 0.1
    assert len(before) == len(ghost)
    # the ghost is placed at the end of the step in which its odometry came: one message later
    assert ghost[1:] == pytest.approx(before[:-1], abs=1e-9)


@pytest.mark.slow
def test_recorded_commands_drive_the_vehicle_as_they_did(dive: Path, tmp_path: Path) -> None:
    out = tmp_path / "again.mcap"
    command = ["play", str(dive), "cirs", "--commands", "--images", "none", "--record", str(out)]
    assert main(command) == 0
    topic = "/uwsim/girona500/odom"
    assert np.array_equal(poses(dive, topic), poses(out, topic))


@pytest.mark.slow
def test_the_scene_of_a_recording_is_that_of_its_seed(tmp_path: Path) -> None:
    topic, dive, out = "/truth/odometry", tmp_path / "dive.mcap", tmp_path / "out.mcap"
    common = ["--images", "none", "--record"]
    assert main(["run", "grasp-scene", "--seed", "5", "--for", "0.5s", *common, str(dive)]) == 0
    command = ["play", str(dive), "grasp-scene", "--commands", *common, str(out)]
    assert main([*command, "--seed", "5"]) == 0
    assert np.array_equal(poses(dive, topic), poses(out, topic))
    out.unlink()
    assert main(command) == 0
    assert not np.array_equal(poses(dive, topic), poses(out, topic)), "it begins elsewhere"


def test_a_recording_that_is_not_there_is_one_clean_line(
    capfd: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert main(["play", str(tmp_path / "no.bag")]) == 2
    assert "no.bag does not exist" in capfd.readouterr().err
