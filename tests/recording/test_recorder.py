"""Recordings open in other tools, hold what the bus delivered, and repeat byte for byte."""

from __future__ import annotations

import errno
import hashlib
import textwrap
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_typestore

from uwsim import messages
from uwsim.bus import Bus
from uwsim.errors import RunFailed
from uwsim.messages import Float64, Image, PingInfo, ProjectedSonarImage, String, image
from uwsim.middleware.recording import ImageStorage, Recorder, TopicRates
from uwsim.middleware.recording.recorder import FILES
from uwsim.middleware.types import wire_type

PIXELS = (np.arange(4 * 5 * 3) * 13 % 256).astype(np.uint8).reshape(4, 5, 3)


def record(path: Path, images: ImageStorage = "raw") -> Recorder:
    """Record three topics, one of which comes later."""
    bus, now = Bus(), [0.0]
    numbers = bus.publisher("/depth", Float64)
    with Recorder(bus, path, images=images) as recorder:
        recorder.start(lambda: now[0])
        for step in range(4):
            now[0] = 0.1 * step
            numbers(Float64(data=float(step)))
            if step == 2:
                bus.publisher("camera", Image)(image(PIXELS, time=now[0], frame_id="bow"))
                bus.publisher("/sonar", ProjectedSonarImage)(
                    ProjectedSonarImage(ping_info=PingInfo(frequency=9e5))
                )
            bus.deliver()
    return recorder


def read(path: Path) -> list[tuple[str, int, object]]:
    with AnyReader([path], default_typestore=get_typestore(Stores.EMPTY)) as reader:
        return [
            (connection.topic, time, reader.deserialize(data, connection.msgtype))
            for connection, time, data in reader.messages()
        ]


def test_rosbags_reads_every_message_from_the_definitions_in_the_file(tmp_path: Path) -> None:
    recorder = record(tmp_path / "run.mcap")
    found = read(tmp_path / "run.mcap")
    assert recorder.n_messages == len(found) == 6
    depths = [(time, m.data) for topic, time, m in found if topic == "/depth"]  # type: ignore[attr-defined]
    assert depths == [(0, 0.0), (10**8, 1.0), (2 * 10**8, 2.0), (3 * 10**8, 3.0)]
    by_topic = {topic: message for topic, _, message in found}
    assert by_topic["/sonar"].ping_info.frequency == 9e5  # type: ignore[attr-defined]
    assert np.array_equal(by_topic["/camera"].data, PIXELS.reshape(-1))  # type: ignore[attr-defined]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["run.mcap"]


def test_mcap_ros2_support_reads_it(tmp_path: Path) -> None:
    decoder = pytest.importorskip("mcap_ros2.decoder")
    reader = pytest.importorskip("mcap.reader")
    record(tmp_path / "run.mcap")
    with (tmp_path / "run.mcap").open("rb") as stream:
        decoded = reader.make_reader(
            stream, decoder_factories=[decoder.DecoderFactory()]
        ).iter_decoded_messages()
        found = {channel.topic: message for _, channel, _, message in decoded}
    assert found["/depth"].data == 3.0
    assert found["/sonar"].ping_info.frequency == 9e5


def test_the_file_alone_is_a_rosbag2_to_rosbags(tmp_path: Path) -> None:
    record(tmp_path / "run.mcap")
    with Reader(tmp_path / "run.mcap") as reader:
        assert reader.message_count == 6
        assert reader.topics["/depth"].msgtype == "std_msgs/msg/Float64"
        assert reader.topics["/depth"].msgcount == 4


def test_the_metadata_in_the_file_is_the_metadata_yaml_of_its_folder(tmp_path: Path) -> None:
    mcap = pytest.importorskip("mcap.reader")
    record(tmp_path / "run.mcap")
    with (tmp_path / "run.mcap").open("rb") as stream:
        records = {each.name: each.metadata for each in mcap.make_reader(stream).iter_metadata()}
    text = records["rosbag2"]["serialized_metadata"]
    folder = tmp_path / "bag"
    folder.mkdir()
    (folder / "metadata.yaml").write_text(
        "rosbag2_bagfile_information:\n" + textwrap.indent(text, "  ")
    )
    (tmp_path / "run.mcap").rename(folder / "recording.mcap")
    with Reader(folder) as reader:
        assert reader.message_count == 6
        assert reader.duration == 3 * 10**8 + 1
        hashes = {each.topic: each.digest for each in reader.connections}
        depths = [time for connection, time, _ in reader.messages() if connection.topic == "/depth"]
    assert depths == [0, 10**8, 2 * 10**8, 3 * 10**8]
    number = wire_type(Float64)
    assert number is not None
    assert hashes["/depth"] == number.type_hash


def latched_and_not(path: Path) -> dict[str, Any]:
    """Record a latched topic and one that is not; returns topic -> its connection."""
    bus = Bus()
    texts = {name: bus.publisher(name, String) for name in ("/robot_description", "/text")}
    with Recorder(bus, path) as recorder:
        recorder.start(lambda: 0.0)
        for say in texts.values():
            say(String(data="here"))
        bus.deliver()
    with AnyReader([path]) as reader:
        return {each.topic: each for each in reader.connections}


def test_a_latched_topic_has_the_quality_with_which_ros2_bag_plays_it_latched(
    tmp_path: Path,
) -> None:
    found = latched_and_not(tmp_path / "run.mcap")
    offered = {topic: each.ext.offered_qos_profiles for topic, each in found.items()}
    ((latched,), (other,)) = offered["/robot_description"], offered["/text"]
    assert latched.durability.name == "TRANSIENT_LOCAL"
    assert other.durability.name == "VOLATILE"
    for each in (latched, other):
        assert each.reliability.name == "RELIABLE"
        assert each.history.name == "KEEP_LAST"
        assert (each.deadline.sec, each.deadline.nsec) == (9223372036, 854775807)
    bags = latched_and_not(tmp_path / "run.bag")
    assert bags["/robot_description"].ext.latching == 1
    assert not bags["/text"].ext.latching


def test_what_ros2_publishes_has_the_recorded_quality() -> None:
    pytest.importorskip("cyclonedds", reason="cyclonedds is not installed: pip install uwsim[ros2]")
    from uwsim.middleware.recording.mcap_file import quality_of as recorded
    from uwsim.middleware.ros2.quality import quality_of as offered

    for topic in ("tf_static", "robot_description", "scene", "odom"):
        mine, theirs = offered(topic), recorded(f"/{topic}")
        assert mine.depth == theirs.depth
        assert mine.is_reliable == (theirs.reliability.name == "RELIABLE")
        assert mine.is_latched == (theirs.durability.name == "TRANSIENT_LOCAL")


def test_two_recordings_of_the_same_messages_have_the_same_bytes(tmp_path: Path) -> None:
    record(tmp_path / "one.mcap")
    record(tmp_path / "other.mcap")
    digests = {hashlib.sha256(path.read_bytes()).digest() for path in tmp_path.iterdir()}
    assert len(digests) == 1


def test_images_are_kept_as_png_without_loss_or_not_at_all(tmp_path: Path) -> None:
    record(tmp_path / "png.mcap", "png")
    by_topic = {topic: message for topic, _, message in read(tmp_path / "png.mcap")}
    packed = by_topic["/camera/compressed"]
    back = cv2.imdecode(packed.data, cv2.IMREAD_COLOR)[..., ::-1]  # type: ignore[attr-defined]
    assert np.array_equal(back, PIXELS)
    assert packed.header.frame_id == "bow"  # type: ignore[attr-defined]
    record(tmp_path / "none.mcap", "none")
    assert {topic for topic, _, _ in read(tmp_path / "none.mcap")} == {"/depth", "/sonar"}


def test_without_images_nothing_subscribes_to_them(tmp_path: Path) -> None:
    bus = Bus()
    bus.publisher("camera", Image)
    with Recorder(bus, tmp_path / "run.mcap", images="none") as recorder:
        recorder.start(lambda: 0.0)
        assert not bus.has_subscribers("camera")


def test_a_type_without_a_definition_is_left_out_and_named(tmp_path: Path) -> None:
    class Own:
        """A message class that ROS does not know."""

    bus = Bus()
    bus.publisher("own", Own)
    bus.publisher("text", String)
    with Recorder(bus, tmp_path / "run.mcap") as recorder:
        recorder.start(lambda: 0.0)
    assert recorder.left_out == {"own": "Own"}


def test_every_message_class_of_uwsim_has_a_definition() -> None:
    kinds = [getattr(messages, name) for name in messages.__all__]
    types = [kind for kind in kinds if "/msg/" in getattr(kind, "__msgtype__", "")]
    assert len(types) > 30
    assert [kind for kind in types if wire_type(kind) is None] == []


def test_rates_count_the_messages_of_every_topic() -> None:
    bus, now = Bus(), [0.0]
    rates = TopicRates(bus, lambda: now[0])
    publish = bus.publisher("/depth", Float64)
    bus.subscribe("/thrust", Float64, lambda message: None)
    for now[0] in (0.0, 0.1, 0.3):
        publish(Float64())
        bus.deliver()
    depth, thrust = rates.rates()
    assert (depth.topic, depth.n_messages, depth.is_published) == ("/depth", 3, True)
    assert depth.rate == pytest.approx(2 / 0.3)
    assert (depth.min_gap, depth.max_gap) == (pytest.approx(0.1), pytest.approx(0.2))
    assert depth.std_gap == pytest.approx(0.05)
    assert (thrust.n_messages, thrust.rate, thrust.is_published) == (0, None, False)


@pytest.mark.parametrize("ending", [".mcap", ".bag"])
@pytest.mark.parametrize("method", ["write", "close"])
def test_a_full_disk_is_one_line_with_the_file_and_leaves_nothing_behind(
    ending: str, method: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(self: object, *arguments: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(FILES[ending], method, full)
    path = tmp_path / f"dive{ending}"
    with pytest.raises(RunFailed, match=f"^No space left on device: {path}"):
        record(path)
    assert list(tmp_path.iterdir()) == []


def test_a_full_disk_is_no_error_of_the_program_that_publishes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(self: object, *arguments: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(FILES[".bag"], "write", full)
    bus = Bus()
    recorder = Recorder(bus, tmp_path / "dive.bag")
    recorder.start(lambda: 0.0)
    bus.publisher("/depth", Float64)(Float64(data=1.0))
    bus.deliver()
    with pytest.raises(RunFailed, match="the recording is discarded"):
        recorder.check()
