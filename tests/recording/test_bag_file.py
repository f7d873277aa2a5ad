"""Bags of ROS 1: other tools open them, and they hold what an MCAP file holds."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

from tests.recording.test_recorder import PIXELS, record
from tests.support.ros1_peers import needs_ros1
from uwsim.bus import Bus
from uwsim.errors import AssetError, BadSetting
from uwsim.messages import MeshFile, Odometry, header
from uwsim.middleware.recording import BagReader, Recorder, check_path


def read(path: Path) -> list[tuple[float, str, object]]:
    with BagReader(path) as reader:
        return list(reader.messages())


def test_rosbags_reads_it_from_the_definitions_inside(tmp_path: Path) -> None:
    recorder = record(tmp_path / "run.bag")
    empty = get_typestore(Stores.EMPTY)
    with AnyReader([tmp_path / "run.bag"], default_typestore=empty) as reader:
        found = [
            (connection.topic, reader.deserialize(data, connection.msgtype))
            for connection, _, data in reader.messages()
        ]
    assert len(found) == recorder.n_messages == 6
    by_topic = dict(found)
    assert np.array_equal(by_topic["/camera"].data, PIXELS.reshape(-1))  # type: ignore[attr-defined]
    assert by_topic["/sonar"].ping_info.frequency == 9e5  # type: ignore[attr-defined]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["run.bag"]


@needs_ros1
def test_rosbag_opens_it(tmp_path: Path) -> None:
    record(tmp_path / "run.bag")
    program = shutil.which("rosbag")
    assert program is not None
    shown = subprocess.run(
        [program, "info", str(tmp_path / "run.bag")],
        env={"PATH": "/usr/bin:/bin"},
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert shown.returncode == 0, shown.stderr
    assert "/depth    4 msgs    : std_msgs/Float64" in shown.stdout.replace("topics:", "")
    assert "marine_acoustic_msgs/ProjectedSonarImage" in shown.stdout


def test_both_kinds_of_file_hold_the_same_messages(tmp_path: Path) -> None:
    for name in ("run.bag", "run.mcap"):
        record(tmp_path / name)
    bag, mcap = read(tmp_path / "run.bag"), read(tmp_path / "run.mcap")
    assert [(time, topic) for time, topic, _ in bag] == [(time, topic) for time, topic, _ in mcap]
    assert [repr(m) for _, _, m in bag] == [repr(m) for _, _, m in mcap]


def test_two_bags_of_the_same_messages_have_the_same_bytes(tmp_path: Path) -> None:
    record(tmp_path / "one.bag")
    record(tmp_path / "other.bag")
    assert (tmp_path / "one.bag").read_bytes() == (tmp_path / "other.bag").read_bytes()


def test_a_type_that_ros_1_lacks_is_left_out(tmp_path: Path) -> None:
    bus = Bus()
    with Recorder(bus, tmp_path / "run.bag") as recorder:
        recorder.start(lambda: 0.0)
        bus.publisher("mesh", MeshFile)
        publish = bus.publisher("odom", Odometry)
        publish(Odometry(header=header(2.5)))
        bus.deliver()
    assert recorder.left_out == {"mesh": "MeshFile"}
    assert recorder.n_messages == 1


@pytest.mark.parametrize("name", ["run.txt", "run", "run.bag2"])
def test_another_kind_of_file_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(BadSetting, match=r"only \.mcap and \.bag files"):
        check_path(tmp_path / name, overwrite=False)


@pytest.mark.parametrize("kind", [".bag", ".mcap"])
@pytest.mark.parametrize("content", [b"", b"#ROSBAG V2.0\n", b"\x89MCAP0\r\n", b"\xff" * 1000])
def test_what_is_no_recording_is_one_clean_error(tmp_path: Path, kind: str, content: bytes) -> None:
    (tmp_path / f"odd{kind}").write_bytes(content)
    with pytest.raises(AssetError, match=f"odd{kind}"):
        read(tmp_path / f"odd{kind}")


@pytest.mark.parametrize("kind", [".bag", ".mcap"])
def test_a_recording_that_was_cut_off_is_one_clean_error(tmp_path: Path, kind: str) -> None:
    record(tmp_path / f"run{kind}")
    whole = (tmp_path / f"run{kind}").read_bytes()
    (tmp_path / f"cut{kind}").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(AssetError, match=f"cut{kind}"):
        read(tmp_path / f"cut{kind}")


def test_a_file_that_is_not_there_is_one_clean_error(tmp_path: Path) -> None:
    with pytest.raises(AssetError, match="does not exist"):
        BagReader(tmp_path / "no.bag")
