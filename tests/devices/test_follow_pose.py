"""A vehicle that follows poses from outside: axes, prediction, silences and hostile poses."""

from __future__ import annotations

import math
import re
import socket
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.small_robots import scene_of, shape, write_robot
from tests.support.opened import open_scene
from uwsim.autopilots.mavlink import Codec, Identity, Message
from uwsim.autopilots.mavlink.vehicle_pose import PoseReader
from uwsim.base.geometry import Pose
from uwsim.devices.motion.follow_pose import FollowPoseSpec, PoseFollower
from uwsim.devices.motion.pose_filter import (
    N_CONSISTENT_JUMPS,
    FilterSettings,
    MeasuredPose,
    PoseFilter,
    format_report,
    summarize_delays,
)
from uwsim.errors import BadSetting
from uwsim.messages import (
    Imu,
    Odometry,
    Point,
    PoseStamped,
    Quaternion,
)
from uwsim.messages import Pose as PoseMessage
from uwsim.scene.spec import SceneSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.sensors.imu import ImuSpec
from uwsim.simulation import Simulation
from uwsim.topics import ImuToROSImuSpec


def follower_scene(folder: Path, **settings: object) -> SceneSpec:
    robot = write_robot(folder, f'<link name="base_link">{shape()}</link>')
    spec = FollowPoseSpec(**({"topic": "/odom"} | settings))  # type: ignore[arg-type]
    imu = ImuSpec(name="imu", relative_to="base_link")
    vehicle = VehicleSpec(name="rov", file=str(robot), position=(1.0, 2.0, 3.0), parts=(imu, spec))
    interface = ImuToROSImuSpec(name="imu", topic="imu", rate=100.0)
    return replace(scene_of(vehicle), ros_interfaces=(interface,))


def odometry(x: float, y: float = 0.0, z: float = 0.0, *, speed: float = 0.0) -> Odometry:
    message = Odometry()
    message.pose.pose = PoseMessage(Point(x, y, z), Quaternion(0.0, 0.0, 0.0, 1.0))
    message.twist.twist.linear.x = speed
    return message


def find_follower(simulation: Simulation) -> PoseFollower:
    return next(d for d in simulation.world.devices if isinstance(d, PoseFollower))


def test_a_stamp_that_is_no_time_is_counted_and_gives_no_delay() -> None:
    filter = PoseFilter(FilterSettings())
    for i, stamp in enumerate((1000.0, 0.0, -1.0, 2.0**64 * 1e-6, math.nan, 1000.04)):
        pose = Pose(np.array([0.01 * i, 0.0, 0.0]), np.eye(3))
        assert filter.accept(MeasuredPose(pose, 0.01 * i, stamp))
    delays = summarize_delays(filter.state)
    assert delays is not None
    assert (delays.n, delays.is_bounded) == (2, True)
    assert (filter.state.n_received, filter.state.n_invalid_stamps) == (6, 4)
    lines = format_report("rov", filter.state)
    assert "4 poses with an invalid stamp" in lines[2]
    assert "delay above the smallest (-1000.000 s" in lines[3]


def test_a_report_says_that_delays_exceed_its_bins() -> None:
    filter = PoseFilter(FilterSettings())
    for i, stamp in enumerate((1000.0, 5.0, 1e9)):
        filter.accept(MeasuredPose(Pose.identity(), 0.01 * i, stamp))
    line = format_report("rov", filter.state)[-1]
    assert line.endswith("or more: stamps differ by more than 1 s")


def test_bytes_that_are_no_mavlink_are_counted_and_reported(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    scene = follower_scene(tmp_path, topic="", mavlink_port=port)
    with open_scene(scene, udp_address="127.0.0.1") as simulation:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as attacker:
            for _ in range(2000):
                attacker.sendto(b"x" * 500, ("127.0.0.1", port))
        simulation.advance(0.5)
        report = find_follower(simulation).report
        state = find_follower(simulation).state.mavlink
        assert state is not None
    assert report[-1].startswith("rov: 0 MAVLink messages; ")
    lines = capsys.readouterr().err
    assert "are no MAVLink; they are skipped" in lines
    if sys.platform == "linux":
        match = re.search(r"(\d+) datagrams dropped", lines)
        n_dropped = int(match[1]) if match else 0
        assert state.stream.n_invalid_bytes + 500 * n_dropped == 1_000_000


def test_the_vehicle_is_where_the_pose_says_at_the_next_step(tmp_path: Path) -> None:
    with open_scene(follower_scene(tmp_path)) as simulation:
        simulation.advance(0.1)
        assert simulation.pose("rov").position == pytest.approx([1.0, 2.0, 3.0])
        simulation.publish("/odom", odometry(1.5, 2.0, 3.25))
        simulation.advance()
        simulation.advance()
        assert simulation.pose("rov").position == pytest.approx([1.5, 2.0, 3.25])


def test_a_pose_is_predicted_over_delay_and_age_but_not_beyond_the_horizon(tmp_path: Path) -> None:
    scene = follower_scene(tmp_path, delay=0.1, horizon=0.3)
    with open_scene(scene) as simulation:
        simulation.publish("/odom", odometry(0.0, speed=0.5))
        simulation.advance(0.1)  # the message arrives at 0 s
        assert simulation.pose("rov").position[0] == pytest.approx(0.5 * (0.1 + 0.1), abs=1e-9)
        simulation.advance(1.0)
        assert simulation.pose("rov").position[0] == pytest.approx(0.5 * 0.3)


def test_poses_of_rep_103_are_east_north_up_with_a_body_forward_left_up(tmp_path: Path) -> None:
    scene = follower_scene(tmp_path, axes="enu", type="pose")
    with open_scene(scene) as simulation:
        yaw = 0.4
        quaternion = Quaternion(0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))
        message = PoseStamped(pose=PoseMessage(Point(1.0, 2.0, -3.0), quaternion))
        simulation.publish("/odom", message)
        simulation.advance(0.01)
        pose = simulation.pose("rov", "W")
        assert pose.position == pytest.approx([1.0, 2.0, -3.0])
        assert pose.rotation[:, 0] == pytest.approx([math.cos(yaw), math.sin(yaw), 0.0])


def test_sensors_stop_while_poses_are_stale_and_go_on_afterwards(tmp_path: Path) -> None:
    scene = follower_scene(tmp_path, timeout=0.1, on_timeout="stop")
    with open_scene(scene) as simulation:
        times: list[float] = []
        simulation.bus.subscribe("imu", Imu, lambda message: times.append(simulation.time))
        simulation.advance(0.2)
        assert not times, "no pose has arrived yet"
        simulation.publish("/odom", odometry(0.0))
        simulation.advance(0.4)
        assert times[0] < 0.22
        assert 0.29 < times[-1] < 0.32
        simulation.publish("/odom", odometry(0.01))
        simulation.advance(0.05)
        assert times[-1] > 0.6
        assert find_follower(simulation).state.filter.n_timeouts == 1


def test_hostile_poses_are_left_out_counted_and_reported(tmp_path: Path) -> None:
    with open_scene(follower_scene(tmp_path, max_speed=2.0)) as simulation:
        simulation.publish("/odom", odometry(1.0))
        simulation.advance(0.1)
        for x in (math.nan, math.inf, 1e300, -1e7):
            simulation.publish("/odom", odometry(x))
        simulation.publish("/odom", odometry(500.0))
        for _ in range(1000):
            simulation.publish("/odom", odometry(1.0))
        simulation.advance(0.1)
        assert simulation.pose("rov").position == pytest.approx([1.0, 0.0, 0.0])
        state = find_follower(simulation).state.filter
        assert (state.n_invalid, state.n_jumps) == (4, 1)
        assert state.n_excess > 800
        assert "4 invalid, 1 jumps" in find_follower(simulation).report[0]


def test_a_vehicle_that_stays_at_a_new_place_is_moved_there_without_a_velocity(
    tmp_path: Path,
) -> None:
    with open_scene(follower_scene(tmp_path, max_speed=2.0)) as simulation:
        simulation.publish("/odom", odometry(0.0))
        simulation.advance(0.1)
        for _ in range(N_CONSISTENT_JUMPS):
            assert simulation.pose("rov").position[0] == pytest.approx(0.0)
            simulation.publish("/odom", odometry(50.0))
            simulation.advance(0.02)
        assert simulation.pose("rov").position[0] == pytest.approx(50.0)
        velocity = simulation.world.vehicles.find("rov").velocity
        assert velocity == pytest.approx(np.zeros(6), abs=1e-9)


def test_a_follower_needs_a_topic_or_a_port(tmp_path: Path) -> None:
    with pytest.raises(BadSetting, match="neither a topic nor a port"):
        open_scene(follower_scene(tmp_path, topic=""))
    with pytest.raises(BadSetting, match="a topic and a port"):
        open_scene(follower_scene(tmp_path, mavlink_port=14560))


def test_the_state_of_a_follower_is_saved_and_restored(tmp_path: Path) -> None:
    with open_scene(follower_scene(tmp_path)) as simulation:
        simulation.publish("/odom", odometry(0.0, speed=0.4))
        simulation.advance(0.02)
        saved_state = simulation.save()
        simulation.advance(0.1)
        position = simulation.pose("rov").position
        simulation.restore(saved_state)
        simulation.advance(0.1)
        assert np.array_equal(simulation.pose("rov").position, position)


def test_delays_are_counted_above_the_smallest() -> None:
    poses = PoseFilter(FilterSettings())
    for i in range(100):
        delay = 0.02 + (0.03 if i % 10 == 9 else 0.0)
        stamp = 1000.0 + 0.1 * i
        poses.accept(MeasuredPose(Pose.identity(), 0.1 * i + delay, stamp))
    delays = summarize_delays(poses.state)
    assert delays is not None
    assert delays.n == 100
    assert delays.min_delay == pytest.approx(-999.98, abs=1e-3)
    assert delays.median_delay == pytest.approx(0.0, abs=1e-3)
    assert delays.high_delay == pytest.approx(0.03, abs=1.5e-3)
    assert delays.max_delay == pytest.approx(0.03, abs=1.5e-3)


def test_without_a_twist_the_velocity_is_that_between_two_poses() -> None:
    poses = PoseFilter(FilterSettings(horizon=1.0))
    start, end = (
        Pose.from_rpy((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
        Pose.from_rpy((0.1, 0.0, 0.0), (0.0, 0.0, 0.05)),
    )
    poses.accept(MeasuredPose(start, 0.0))
    poses.accept(MeasuredPose(end, 0.1))
    pose = poses.predict(0.2)
    assert pose is not None
    assert pose.position == pytest.approx([0.2, 0.0, 0.0], abs=1e-3)
    assert math.atan2(pose.rotation[1, 0], pose.rotation[0, 0]) == pytest.approx(0.1)


def frames(*messages: Message) -> bytes:
    codec = Codec()
    return b"".join(codec.encode(m, Identity(1, 1), i) for i, m in enumerate(messages))


def attitude(yaw: float, time: int = 1000) -> Message:
    return Message("ATTITUDE", {"time_boot_ms": time, "yaw": yaw, "yawspeed": 0.25})


def local_position(x: float, time: int = 1010) -> Message:
    fields = {"time_boot_ms": time, "x": x, "y": 2.0, "z": 3.0, "vx": 0.0, "vy": 0.5}
    return Message("LOCAL_POSITION_NED", fields)


def test_a_mavlink_position_is_joined_with_the_newest_attitude() -> None:
    poses = PoseReader().read(
        [frames(local_position(9.0), attitude(math.pi / 2), local_position(1.0))]
    )
    assert len(poses) == 1, "the first position has no attitude"
    pose = poses[0]
    assert pose is not None
    assert pose.position == pytest.approx((1.0, 2.0, 3.0))
    assert pose.quaternion == pytest.approx((math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)))
    # it moves east and looks east
    assert pose.twist == pytest.approx((0.5, 0.0, 0.0, 0.0, 0.0, 0.25), abs=1e-7)
    assert pose.time == pytest.approx(1.010)


def test_mavlink_odometry_is_a_pose_and_nan_is_none() -> None:
    fields = {"time_usec": 2_000_000, "frame_id": 1, "x": 1.0, "q": (1.0, 0.0, 0.0, 0.0), "vx": 0.3}
    good, bad = Message("ODOMETRY", fields), Message("ODOMETRY", fields | {"y": math.nan})
    poses = PoseReader().read([frames(good), frames(bad), b"\xfd\x00garbage", frames(good)])
    assert [pose is not None for pose in poses] == [True, False, True]
    assert poses[0] is not None
    assert poses[0].twist[0] == pytest.approx(0.3)


def test_an_old_attitude_is_not_joined() -> None:
    assert PoseReader().read([frames(attitude(0.0, 1000), local_position(1.0, 3000))]) == []


def test_a_vehicle_follows_mavlink_datagrams_at_a_port(tmp_path: Path) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    scene = follower_scene(tmp_path, topic="", mavlink_port=port)
    with (
        open_scene(scene, udp_address="127.0.0.1") as simulation,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender,
    ):
        simulation.advance(0.01)
        for data in (b"noise", frames(attitude(0.0)), frames(local_position(1.0))):
            sender.sendto(data, ("127.0.0.1", port))
        simulation.advance(0.01)
        # north, east, down in W: x east, y north, z up
        assert simulation.pose("rov", "W").position[[1, 2]] == pytest.approx([1.0, -3.0])
        assert simulation.pose("rov", "W").position[0] == pytest.approx(2.0, abs=0.01)
