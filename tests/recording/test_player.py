"""Recordings put onto a bus: the same messages at the same steps."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from rosbags.rosbag2 import StoragePlugin, Writer

from tests.support.bags import sample_pixels, write_bag
from tests.support.opened import open_scene
from uwsim.messages import Float64, Odometry, Pose, header
from uwsim.middleware.encodings import to_cdr
from uwsim.middleware.recording import BagReader, Player, Recorder
from uwsim.middleware.types import ros2_store
from uwsim.scene.spec import SceneSpec

TIMES = (0.0, 0.1, 0.1, 0.3)


class Source:
    """Publishes numbers at `TIMES`, two of them at once."""

    def start(self, node: Any) -> None:
        self.publish = node.publisher("depth", Float64)
        self.odometry = node.publisher("/odom", Odometry)
        self.node, self.left = node, list(enumerate(TIMES))
        node.create_timer(0.002, self.tick)

    def tick(self) -> None:
        while self.left and self.left[0][1] <= self.node.now + 1e-9:
            number, time = self.left.pop(0)
            self.publish(Float64(data=float(number)))
            self.odometry(Odometry(header=header(time)))


def read(path: Path) -> list[tuple[float, str, Any]]:
    with BagReader(path) as reader:
        return list(reader.messages())


def recorded(path: Path) -> Path:
    with open_scene(SceneSpec()) as simulation, Recorder(simulation.bus, path) as recorder:
        recorder.start(lambda: simulation.time)
        simulation.attach(Source())
        simulation.advance(0.4)
    return path


@pytest.mark.parametrize("kind", [".bag", ".mcap"])
@pytest.mark.parametrize("again", [".bag", ".mcap"])
def test_what_is_played_and_recorded_again_is_the_same(
    tmp_path: Path, kind: str, again: str
) -> None:
    first = recorded(tmp_path / f"first{kind}")
    second = tmp_path / f"second{again}"
    with (
        BagReader(first) as reader,
        open_scene(SceneSpec()) as simulation,
        Recorder(simulation.bus, second) as recorder,
    ):
        assert reader.duration == pytest.approx(0.3)
        recorder.start(lambda: simulation.time)
        player = Player(reader, simulation.timestep)
        simulation.attach(player)
        simulation.advance(reader.duration)
        assert player.is_over
    direct = recorded(tmp_path / f"direct{again}")
    assert len(read(second)) == 8
    assert sorted(map(repr, read(second))) == sorted(map(repr, read(direct)))
    if kind == ".mcap":  # in a bag of ROS 1, messages of one time are sorted by topic
        assert second.read_bytes() == direct.read_bytes()


def test_a_topic_that_others_publish_is_played_beside_it(tmp_path: Path) -> None:
    path = recorded(tmp_path / "run.mcap")
    with BagReader(path) as reader, open_scene(SceneSpec()) as simulation:
        player = Player(reader, 0.002, bus_topics=["/depth"], left_out=["/odom"])
        simulation.attach(player)
        simulation.latest_message("/recorded/depth")
        simulation.advance(0.2)
        assert simulation.latest_message("/recorded/depth").data == 2.0
        assert player.topics == {"/depth": "/recorded/depth"}


def test_times_of_the_wall_clock_count_from_the_first_message(tmp_path: Path) -> None:
    writer = Writer(tmp_path / "bag", version=9, storage_plugin=StoragePlugin.MCAP)
    began = 1_700_000_000
    with writer:
        connection = writer.add_connection("odom", Odometry.__msgtype__, typestore=ros2_store())
        for i in range(3):
            message = Odometry(header=header(began + 0.5 * i))
            writer.write(connection, (began * 10**9) + i * 500_000_000, to_cdr(message))
    with BagReader(tmp_path / "bag") as reader:
        found = list(reader.messages())
        assert reader.duration == 1.0
    assert [time for time, _, _ in found] == [0.0, 0.5, 1.0]
    assert [m.header.stamp.sec + m.header.stamp.nanosec * 1e-9 for _, _, m in found] == [
        pytest.approx(0.0),
        pytest.approx(0.5),
        pytest.approx(1.0),
    ]


def test_a_bag_of_another_program_is_read_into_the_classes_of_the_bus(tmp_path: Path) -> None:
    path = write_bag(tmp_path, "ros1", [(0.0, sample_pixels(10)), (0.1, sample_pixels(20))])
    with BagReader(path) as reader:
        kinds = {type(message).__module__ for _, _, message in reader.messages()}
    assert kinds == {"uwsim.messages.sensor_msgs"}


def test_a_type_that_is_not_known_is_left_out(tmp_path: Path) -> None:
    from rosbags.typesys import get_types_from_msg

    store = ros2_store()
    store.register(get_types_from_msg("float64 x", "odd_msgs/msg/Odd"))
    odd = store.types["odd_msgs/msg/Odd"]
    data = store.serialize_cdr(odd(x=1.0), "odd_msgs/msg/Odd")
    pose = to_cdr(Pose())
    with Writer(tmp_path / "bag", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connections = [
            writer.add_connection(topic, name, typestore=store)
            for topic, name in (("odd", "odd_msgs/msg/Odd"), ("pose", Pose.__msgtype__))
        ]
        writer.write(connections[0], 0, data)
        writer.write(connections[1], 1, pose)
    del store.types["odd_msgs/msg/Odd"], store.fielddefs["odd_msgs/msg/Odd"]
    from uwsim.middleware.types import message_class

    message_class.cache_clear()
    with BagReader(tmp_path / "bag") as reader:
        assert reader.left_out == {"/odd": "odd_msgs/msg/Odd"}
        assert [topic for _, topic, _ in reader.messages()] == ["/pose"]
