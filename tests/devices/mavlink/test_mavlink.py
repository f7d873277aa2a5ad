"""A vehicle's link to its autopilot: sensors at their rates, commands, reports, hostile bytes."""

from __future__ import annotations

import math
import re
import socket
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pymavlink.dialects.v20.ardupilotmega as dialect
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import uwsim
from tests.support.fake_autopilot import FakeAutopilot
from uwsim.assets.bundled import bundled_files
from uwsim.devices.mavlink.link import Link
from uwsim.devices.mavlink.mavlink import MavlinkDevice
from uwsim.devices.mavlink.start_watch import StartWatch
from uwsim.errors import UwsimError
from uwsim.messages import (
    Bool,
    Float64MultiArray,
    MultiArrayLayout,
    Point,
    Pose,
    PoseStamped,
    Quaternion,
    Range,
    String,
    Twist,
    TwistStamped,
    Vector3,
    header,
)
from uwsim.model.scene_model import SceneModel
from uwsim.physics.compile_scene import compile_scene
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation

ELEMENT = """<u:mavlink>
      <name>ap</name> <address>{address}</address> {content}
    </u:mavlink>
    <u:dynamics>bluerov2_heavy</u:dynamics>"""
HOME = "<home> <x>10</x> <y>0</y> <z>0</z> </home>"
SENSORS = (
    "<dvl>/bluerov2/dvl</dvl> <odometry>/bluerov2/odom</odometry> "
    f"<range>/bluerov2/altitude</range> {HOME}"
)


def write_scene(folder: Path, address: str, content: str = SENSORS) -> Path:
    text = bundled_files("scenes")["bluerov2-scene"].read_text()
    text = re.sub(r"<u:(ardupilot|mavlink)>.*?</u:\1>", "", text, flags=re.DOTALL)
    element = ELEMENT.format(address=address, content=content)
    path = folder / "scene.xml"
    path.write_text(text.replace("<u:dynamics>bluerov2_heavy</u:dynamics>", element))
    return path


class Pair:
    """A simulation and the autopilot to which it is connected."""

    def __init__(self, port: socket.socket, model: SceneModel) -> None:
        self.autopilot = FakeAutopilot(listener=port)
        self.simulation = Simulation(model, is_blind=True, udp_address="127.0.0.1")
        self.autopilot.accept()
        self.simulation.watch(lambda: self.autopilot.poll(self.simulation.time))

    @property
    def device(self) -> MavlinkDevice:
        return next(d for d in self.simulation.world.devices if isinstance(d, MavlinkDevice))

    def close(self) -> None:
        self.simulation.close()
        self.autopilot.close()


@pytest.fixture(scope="module")
def port() -> Iterator[socket.socket]:
    with socket.create_server(("127.0.0.1", 0)) as listener:
        yield listener


@pytest.fixture(scope="module")
def model(port: socket.socket, tmp_path_factory: pytest.TempPathFactory) -> SceneModel:
    address = f"tcp:127.0.0.1:{port.getsockname()[1]}"
    scene = write_scene(tmp_path_factory.mktemp("scene"), address)
    return compile_scene(read_scene(scene))


@pytest.fixture
def pair(port: socket.socket, model: SceneModel) -> Iterator[Pair]:
    pair = Pair(port, model)
    yield pair
    pair.close()


def publish(pair: Pair, topic: str, message: object) -> None:
    pair.simulation.bus.publisher(f"ap/{topic}", type(message))(message)


def test_sensors_arrive_at_the_rates_of_their_topics(pair: Pair) -> None:
    pair.simulation.advance(3.0)
    counts = {
        name: len(pair.autopilot.find_messages(name))
        for name in ("VISION_POSITION_DELTA", "ODOMETRY", "DISTANCE_SENSOR")
    }
    assert counts["VISION_POSITION_DELTA"] == pytest.approx(30, abs=2)
    assert counts["ODOMETRY"] == pytest.approx(150, abs=2)
    assert counts["DISTANCE_SENSOR"] == pytest.approx(30, abs=2)
    deltas = pair.autopilot.find_messages("VISION_POSITION_DELTA")
    assert {message.time_delta_usec for message in deltas} == {100_000}
    assert {(m.get_srcSystem(), m.get_srcComponent()) for m in deltas} == {(1, 197)}
    heartbeats = pair.autopilot.find_messages("HEARTBEAT")
    assert len(heartbeats) in (6, 8)  # of a station and of a computer on board


def test_velocities_and_positions_are_in_the_axes_of_the_autopilot(pair: Pair) -> None:
    thrusts = np.array([-0.5, -0.5, 0.5, 0.5, 0.3, 0.3, 0.3, 0.3])
    ranges = pair.simulation.bus.inbox("bluerov2/altitude", Range)
    command = pair.simulation.bus.publisher("bluerov2/thrusters", Float64MultiArray)
    for _ in range(20):
        command(Float64MultiArray(layout=MultiArrayLayout(dim=[], data_offset=0), data=thrusts))
        pair.simulation.advance(0.1)
    pair.simulation.advance()  # messages of the end of a step are sent in the next one
    velocity = pair.simulation.world.vehicles.find("bluerov2").velocity[:3]  # forward, right, down
    assert np.abs(velocity).max() > 0.05
    delta = pair.autopilot.find_messages("VISION_POSITION_DELTA")[-1]
    measured = np.array(delta.position_delta) / (delta.time_delta_usec * 1e-6)
    assert measured == pytest.approx(velocity, abs=0.03)  # noise and the lever arm
    position = pair.simulation.pose("bluerov2").position  # L is north, east, down in this scene
    odometry = pair.autopilot.find_messages("ODOMETRY")[-1]
    assert [odometry.x + 10, odometry.y, odometry.z] == pytest.approx(position, abs=0.02)
    assert [odometry.vx, odometry.vy, odometry.vz] == pytest.approx(velocity, abs=0.02)
    distance = pair.autopilot.find_messages("DISTANCE_SENSOR")[-1].current_distance
    assert distance == pytest.approx(100 * ranges.take()[-1].range, abs=0.51)


def test_the_first_heartbeat_brings_the_origin_and_requests_the_estimate(pair: Pair) -> None:
    pair.simulation.advance(1.5)
    (origin,) = pair.autopilot.find_messages("SET_GPS_GLOBAL_ORIGIN")
    north = 10 / 111_070  # of home, where a degree of latitude is 111.07 km
    assert origin.latitude == pytest.approx((41.9616 + north) * 1e7, abs=3)
    assert origin.longitude == pytest.approx(2.8353e7, abs=1)
    requested = [m.param1 for m in pair.autopilot.find_messages("COMMAND_LONG") if m.command == 511]
    assert sorted(requested) == [30, 32]


def test_mode_arming_and_texts_are_commanded_and_reported(
    pair: Pair, capsys: pytest.CaptureFixture[str]
) -> None:
    simulation = pair.simulation
    modes = simulation.bus.inbox("ap/flight_mode", String)
    texts = simulation.bus.inbox("ap/status_text", String)
    armed = simulation.bus.inbox("ap/is_armed", Bool)
    simulation.advance(0.5)
    publish(pair, "mode", String(data="POSHOLD"))
    pair.autopilot.can_arm = False
    publish(pair, "arm", Bool(data=True))
    simulation.advance(0.5)
    assert pair.autopilot.mode == 16
    assert not pair.autopilot.is_armed
    pair.autopilot.can_arm = True
    publish(pair, "arm", Bool(data=True))
    simulation.advance(0.5)
    assert pair.autopilot.is_armed
    assert modes.take()[-1].data == "POSHOLD"
    assert armed.take()[-1].data
    assert [text.data for text in texts.take()] == ["critical: Arm: EKF attitude is bad"]
    output = capsys.readouterr().err
    assert "autopilot of bluerov2: critical: Arm: EKF attitude is bad" in output
    assert "autopilot of bluerov2: command 400 (arming): failed" in output
    assert "autopilot of bluerov2: POSHOLD, armed" in output


def test_sticks_are_repeated_so_that_no_failsafe_acts(pair: Pair) -> None:
    pair.simulation.advance(0.5)
    assert pair.autopilot.find_messages("MANUAL_CONTROL") == []
    layout = MultiArrayLayout(dim=[], data_offset=0)
    publish(pair, "sticks", Float64MultiArray(layout=layout, data=np.array([0.5, 0, -0.2])))
    pair.simulation.advance(1.0)
    received = pair.autopilot.find_messages("MANUAL_CONTROL")
    assert len(received) == pytest.approx(26, abs=2)
    assert {(m.x, m.y, m.z, m.r) for m in received} == {(500, 0, 400, 0)}
    assert {m.get_srcSystem() for m in received} == {255}
    publish(pair, "sticks", Float64MultiArray(layout=layout, data=np.full(9, 0.5)))
    pair.simulation.advance(0.2)
    assert pair.autopilot.find_messages("MANUAL_CONTROL")[-1].x == 500  # nine numbers are ignored


def test_a_setpoint_of_the_scene_is_one_in_north_east_down(pair: Pair) -> None:
    pair.simulation.advance(0.2)
    half = math.sqrt(0.5)
    velocity = Twist(linear=Vector3(0.1, 0.2, 0.3), angular=Vector3(0, 0, 0))
    publish(pair, "setpoint_velocity", TwistStamped(header=header(0), twist=velocity))
    pose = Pose(Point(1.0, 2.0, 3.0), Quaternion(0.0, 0.0, half, half))  # to the east
    publish(pair, "setpoint_position", PoseStamped(header=header(0), pose=pose))
    pair.simulation.advance(1.0)
    publish(pair, "setpoint_position", PoseStamped(header=header(0), pose=pose))
    pair.simulation.advance(0.1)
    moving, fixed = pair.autopilot.find_messages("SET_POSITION_TARGET_LOCAL_NED")
    assert [moving.x, moving.y, moving.z] == pytest.approx([1 - 10, 2, 3])
    assert [moving.vx, moving.vy, moving.vz] == pytest.approx([0.1, 0.2, 0.3])
    assert moving.yaw == pytest.approx(math.pi / 2)
    assert fixed.type_mask & 0x38  # the velocity was too old


def test_the_estimate_of_the_autopilot_is_published_in_the_frame_of_the_scene(pair: Pair) -> None:
    estimates = pair.simulation.bus.inbox("ap/estimate", PoseStamped)
    pair.simulation.advance(0.2)
    pair.autopilot.send(dialect.MAVLink_attitude_message(0, 0.0, 0.0, 0.5, 0, 0, 0))
    pair.autopilot.send(dialect.MAVLink_local_position_ned_message(0, 1.0, 2.0, 3.0, 0, 0, 0))
    pair.simulation.advance(0.2)
    (estimate,) = estimates.take()
    position, q = estimate.pose.position, estimate.pose.orientation
    assert [position.x, position.y, position.z] == pytest.approx([1 + 10, 2, 3])
    assert 2 * math.atan2(q.z, q.w) == pytest.approx(0.5)


def test_a_silent_autopilot_and_its_return_are_reported(
    pair: Pair, capsys: pytest.CaptureFixture[str]
) -> None:
    pair.simulation.advance(1.0)
    pair.autopilot._heartbeat_time = 8.5
    pair.simulation.advance(9.0)
    assert capsys.readouterr().err.count("no heartbeat for 5 s") == 1
    assert (
        len(pair.autopilot.find_messages("SET_GPS_GLOBAL_ORIGIN")) == 2
    )  # it may have started again


def test_messages_of_other_systems_change_nothing(pair: Pair) -> None:
    pair.simulation.advance(0.5)
    other = dialect.MAVLink(None, 77, 1)
    beat = dialect.MAVLink_heartbeat_message(12, 3, 0x81, 4, 4, 3)
    pair.autopilot.send_bytes(bytes(beat.pack(other)))
    pair.simulation.advance(0.2)
    status = pair.device.state.status
    assert (status.system, status.mode_name, status.is_armed) == (1, "MANUAL", False)


def test_without_a_connection_the_device_does_nothing(model: SceneModel) -> None:
    with Simulation(model, is_blind=True) as simulation:
        device = next(d for d in simulation.world.devices if isinstance(d, MavlinkDevice))
        assert device.idle_until(0.0) == math.inf
        simulation.advance(0.1)


def test_without_pymavlink_the_device_does_nothing_and_names_the_extra(
    model: SceneModel, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with Simulation(model, is_blind=True, udp_address="127.0.0.1") as simulation:
        monkeypatch.undo()
        simulation.advance(0.1)
    assert "pip install 'uwsim[mavlink]'" in capsys.readouterr().err


def test_an_invalid_address_is_reported_with_its_form(tmp_path: Path) -> None:
    with pytest.raises(UwsimError, match="Did you mean 'tcp'"):
        uwsim.load(write_scene(tmp_path, "tpc:127.0.0.1:5760"), udp_address="127.0.0.1")


def test_a_state_is_restored_with_the_link(pair: Pair) -> None:
    pair.simulation.advance(1.0)
    saved = pair.simulation.save()
    pair.simulation.advance(1.0)
    pair.simulation.restore(saved)
    pair.simulation.advance(0.5)
    times = [m.time_usec for m in pair.autopilot.find_messages("VISION_POSITION_DELTA")]
    assert times.count(1_200_000) == 2


@given(data=st.lists(st.binary(max_size=2000), max_size=5))
@settings(
    max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
def test_no_bytes_at_the_port_end_or_slow_the_run(shared_pair: Pair, data: list[bytes]) -> None:
    pair = shared_pair
    n_before = len(pair.autopilot.find_messages("ODOMETRY"))
    for piece in data:
        pair.autopilot.send_bytes(piece)
    pair.simulation.advance(0.2)
    assert len(pair.autopilot.find_messages("ODOMETRY")) == n_before + 10  # the rate is kept


@pytest.fixture(scope="module")
def shared_pair(port: socket.socket, model: SceneModel) -> Iterator[Pair]:
    pair = Pair(port, model)
    pair.simulation.advance(0.2)
    yield pair
    pair.close()


def test_invalid_bytes_are_counted_and_reported_rarely(
    pair: Pair, capsys: pytest.CaptureFixture[str]
) -> None:
    for _ in range(100):
        pair.autopilot.send_bytes(b"GET / HTTP/1.1\r\n" * 10)
        pair.simulation.advance(0.05)
    n_invalid = pair.device.state.link.reader.n_invalid_bytes
    assert n_invalid == 16000
    n_lines = capsys.readouterr().err.count("are no MAVLink; they are skipped")
    assert 1 <= n_lines <= 3


def test_a_text_that_repeats_is_printed_once(
    pair: Pair, capsys: pytest.CaptureFixture[str]
) -> None:
    for _ in range(10):
        pair.autopilot.send_text(6, "yaw alignment complete")
        pair.simulation.advance(0.2)
    assert capsys.readouterr().err.count("yaw alignment complete") == 1


def test_a_flood_of_texts_does_not_flood_the_terminal(
    pair: Pair, capsys: pytest.CaptureFixture[str]
) -> None:
    for k in range(20):
        for i in range(30):
            pair.autopilot.send_text(6, f"text {k} {i}")
        pair.simulation.advance(0.1)
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) <= 200
    assert "later texts are not shown" in lines[-1]


def test_an_autopilot_that_is_absent_is_reported_once(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    now = 100.0
    monkeypatch.setattr("uwsim.devices.mavlink.start_watch.time.monotonic", lambda: now)
    watch = StartWatch("tcp:127.0.0.1:5812")
    watch.check()
    assert capsys.readouterr().err == ""
    now = 106.0
    watch.check()
    watch.check()
    error = capsys.readouterr().err
    assert error.count("no MAVLink at tcp:127.0.0.1:5812: is it SERIAL1 of this ArduPilot") == 1


def test_the_numbers_of_a_connection_are_described(pair: Pair) -> None:
    pair.simulation.advance(1.0)
    text = pair.device.describe()
    assert text.startswith("MAVLink of ")
    assert " messages received, " in text


def test_an_autopilot_that_connects_again_gets_its_origin_again(
    pair: Pair, monkeypatch: pytest.MonkeyPatch
) -> None:
    pair.simulation.advance(1.5)
    assert len(pair.autopilot.find_messages("SET_GPS_GLOBAL_ORIGIN")) == 1
    with monkeypatch.context() as context:
        context.setattr(Link, "is_connected", property(lambda self: False))
        pair.simulation.advance(0.1)
    pair.simulation.advance(1.5)
    assert len(pair.autopilot.find_messages("SET_GPS_GLOBAL_ORIGIN")) == 2
