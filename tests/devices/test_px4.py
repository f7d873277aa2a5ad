"""PX4 in lock-step: what it measures, what its outputs do, and what a wrong peer causes."""

from __future__ import annotations

import hashlib
import math
import socket
import threading
import time
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from tests.support.opened import open_scene
from tests.support.px4_stub import Px4Stub, connect, find_free_port
from uwsim.assets.bundled import bundled_files
from uwsim.base.geometry import rotation_from_quaternion, rpy_from_rotation
from uwsim.devices.ardupilot.spec import ArduPilotSpec
from uwsim.devices.px4 import Px4Spec
from uwsim.devices.px4.px4 import BLUEROV2_MOTORS, Motors, Px4
from uwsim.errors import BadSetting, ClientLost, UnknownName, UwsimError
from uwsim.messages import Float64MultiArray
from uwsim.runs.planning.ardupilot_scene import connect_ardupilot
from uwsim.runs.planning.px4_scene import connect_px4
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.simulation import Simulation

THRUSTERS = tuple(name.removeprefix("-") for name in BLUEROV2_MOTORS)
FORWARD = (0.5, 0.5, 0.5, 0.5)
STEPS = 250
"""The number of steps of a run, 0.5 s."""


def scene_with(spec: Px4Spec) -> SceneSpec:
    scene = read_scene(bundled_files("scenes")["bluerov2-scene"])
    (vehicle,) = scene.vehicles
    parts = [part for part in vehicle.parts if not isinstance(part, ArduPilotSpec)]
    return replace(scene, vehicles=(replace(vehicle, parts=(*parts, spec)),))


def open_simulation(port: int, **settings: Any) -> Simulation:
    spec = Px4Spec(relative_to="base_link", port=port, limit=20.0, **settings)
    return open_scene(scene_with(spec), udp_address="127.0.0.1", is_blind=True)


def device_of(simulation: Simulation) -> Px4:
    return next(part for part in simulation.world.devices if isinstance(part, Px4))


def run(
    control: Any, *, steps: int = STEPS, stub: dict[str, Any] | None = None, **settings: Any
) -> tuple[Simulation, Px4Stub]:
    """Run steps with a stub of PX4; return both after the end."""
    port = find_free_port()
    with open_simulation(port, **settings) as simulation:
        px4 = Px4Stub(port, control, **(stub or {}))
        for _ in range(steps):
            simulation.advance()
    px4.join()
    return simulation, px4


def hold_depth(sensor: Any) -> list[float]:
    """Return outputs that depend on each sensor: a PD controller of depth and yaw rate."""
    push = 0.3 * (sensor.pressure_alt + 1.5) - 0.2 * (sensor.zacc + 9.81)
    turn = 0.2 * sensor.zgyro + 1e-3 * sensor.xmag
    return [turn, -turn, turn, -turn, -push, push, push, -push]


def test_each_step_of_px4_is_answered_once_at_its_time() -> None:
    _, px4 = run(hold_depth)
    times = [sensor.time_usec for sensor in px4.sensors]
    assert len(times) > STEPS // 2  # 250 Hz, steps of 2 ms, and the last ones of the start
    assert set(np.diff(times)) == {4000}


def test_the_applied_commands_are_published_at_each_answer() -> None:
    port, messages = find_free_port(), []
    with open_simulation(port) as simulation:
        simulation.bus.subscribe("bluerov2/autopilot/thrusters", Float64MultiArray, messages.append)
        px4 = Px4Stub(port, lambda _: FORWARD)
        for _ in range(20):
            simulation.advance()
    px4.join()
    assert len(messages) == 10
    assert messages[-1].data.tolist() == [0.5] * 4 + [0.0] * 4


def test_two_runs_exchange_the_same_bytes() -> None:
    digests = set()
    for _ in range(2):
        simulation, px4 = run(hold_depth, satellite_rate=10.0, odometry_rate=25.0)
        pose = simulation.world.vehicles.find("bluerov2").world_from_base
        motion = pose.position.tobytes() + pose.rotation.tobytes()
        digests.add(hashlib.sha256(repr(messages_in_run(px4, STEPS)).encode() + motion).hexdigest())
    assert len(digests) == 1


def messages_in_run(px4: Px4Stub, steps: int) -> list[dict[str, Any]]:
    """Return the values of the messages of a run, by their time after its first HIL_SENSOR.

    The number of messages of the start, and so PX4's clock, depends on the load of the machine.
    """
    first = px4.sensors[-(steps // 2)].time_usec
    messages = sorted((*px4.sensors, *px4.other_messages), key=lambda message: message.time_usec)
    return [
        {**message.to_dict(), "time_usec": message.time_usec - first}
        for message in messages
        if message.time_usec >= first
    ]


def test_the_noise_of_the_start_does_not_change_the_run() -> None:
    """Start after another number of messages, as the real PX4 does from run to run."""
    first = messages_in_run(run(hold_depth, steps=20)[1], 20)
    port = find_free_port()
    with open_simulation(port) as simulation:
        for _ in range(7):  # more noise at the start
            device_of(simulation)._measure_at_start(4000)
        px4 = Px4Stub(port, hold_depth)
        for _ in range(20):
            simulation.advance()
    px4.join()
    assert messages_in_run(px4, 20) == first


def test_the_sensors_at_rest_are_those_of_a_level_vehicle() -> None:
    _, px4 = run(lambda _: (), steps=20, stub={"is_armed": False})
    sensor = px4.sensors[1]
    assert [sensor.xacc, sensor.yacc, sensor.zacc] == pytest.approx([0.0, 0.0, -9.81], abs=0.3)
    assert [sensor.xgyro, sensor.ygyro, sensor.zgyro] == pytest.approx([0.0] * 3, abs=0.02)
    field = [sensor.xmag, sensor.ymag, sensor.zmag]  # heading north [gauss]
    assert field == pytest.approx([0.2478, 0.0088, 0.3890], abs=0.03)
    assert sensor.pressure_alt == pytest.approx(-1.5, abs=0.1)
    assert sensor.abs_pressure == pytest.approx(1013.25 + 1.5 * 0.12, abs=0.02)


def test_no_sensor_repeats_its_value() -> None:
    """PX4 takes a sensor with 100 equal values in a row as failed."""
    _, px4 = run(lambda _: ())
    for name in ("xacc", "xgyro", "xmag", "abs_pressure"):
        values = [getattr(sensor, name) for sensor in px4.sensors]
        repeats = [a == b for a, b in pairwise(values)]
        n_repeats = max(len(run) for run in "".join("=" if e else " " for e in repeats).split(" "))
        assert n_repeats < 5, name


def test_the_other_messages_have_their_rates_and_come_before_the_sensors() -> None:
    _, px4 = run(hold_depth, satellite_rate=10.0, odometry_rate=25.0)
    counts: dict[str, int] = {}
    for message in px4.other_messages:
        counts[message.get_type()] = counts.get(message.get_type(), 0) + 1
    assert counts == {
        "HIL_GPS": pytest.approx(5, abs=1),
        "ODOMETRY": pytest.approx(13, abs=1),
        "HIL_STATE_QUATERNION": pytest.approx(25, abs=1),
    }
    assert {message.time_usec for message in px4.other_messages} <= {
        sensor.time_usec for sensor in px4.sensors
    }


def test_the_true_state_is_that_of_the_simulation() -> None:
    turn = (0.4, -0.4, 0.4, -0.4)
    simulation, px4 = run(lambda _: turn, steps=STEPS + 1)
    state = [m for m in px4.other_messages if m.get_type() == "HIL_STATE_QUATERNION"][-1]
    rotation = rotation_from_quaternion(np.array(state.attitude_quaternion))
    _, _, yaw = rpy_from_rotation(rotation)
    assert abs(yaw) > 0.02
    vehicle = simulation.world.vehicles.find("bluerov2")
    x, y, _ = vehicle.world_from_base.rotation[:, 0]  # the bow in W: east, north, up
    assert math.atan2(x, y) == pytest.approx(yaw, abs=0.03)  # the last message is older
    assert state.lat == pytest.approx(419616000, abs=30)
    assert state.alt == pytest.approx(-1500, abs=40)


@pytest.mark.parametrize(
    ("outputs", "axis", "sign"),
    [
        ((0.5, 0.5, 0.5, 0.5), 0, 1.0),  # forward
        ((-0.5, 0.5, 0.5, -0.5), 1, 1.0),  # to starboard
        ((0, 0, 0, 0, -0.5, 0.5, 0.5, -0.5), 2, 1.0),  # down
        ((0, 0, 0, 0, 0.5, 0.5, -0.5, -0.5), 3, -1.0),  # roll to port
        ((-0.5, 0.5, -0.5, 0.5), 5, 1.0),  # yaw to starboard
    ],
)
def test_the_outputs_move_the_vehicle_as_the_airframe_of_px4(
    outputs: tuple[float, ...], axis: int, sign: float
) -> None:
    """Derive the signs from the axes CA_ROTORn_A and positions CA_ROTORn_P of airframe 60002."""
    expected = np.zeros(6)
    axes = [(1, -1, 0), (1, 1, 0), (1, 1, 0), (1, -1, 0)]
    axes += [(0, 0, -1), (0, 0, 1), (0, 0, 1), (0, 0, -1)]
    places = [(0.5, 0.3, 0.2), (0.5, -0.3, 0.2), (-0.5, 0.3, 0.2), (-0.5, -0.3, 0.2)]
    places += [(0.5, 0.5, 0), (0.5, -0.5, 0), (-0.5, 0.5, 0), (-0.5, -0.5, 0)]
    for output, direction, place in zip(outputs, axes, places, strict=False):
        force = output * np.array(direction, dtype=float)
        expected += np.concatenate([force, np.cross(place, force)])
    assert sign * expected[axis] > 0.0
    simulation, _ = run(lambda _: outputs)
    velocity = simulation.world.vehicles.find("bluerov2").velocity
    assert sign * velocity[axis] > 0.02


def test_a_vehicle_that_is_not_armed_does_not_move_its_thrusters() -> None:
    simulation, _ = run(lambda _: FORWARD, stub={"is_armed": False})
    assert abs(simulation.world.vehicles.find("bluerov2").velocity[0]) < 1e-3
    assert not device_of(simulation).state.is_armed


def test_answers_to_earlier_sensors_are_not_used() -> None:
    simulation, px4 = run(hold_depth, stub={"sends_stale": True})
    state = device_of(simulation).state.lock_step
    assert state.n_stale > 100
    assert len(px4.sensors) > STEPS // 2


@pytest.mark.skipif(not hasattr(socket, "TCP_QUICKACK"), reason="an option of Linux")
def test_a_peer_that_collects_its_bytes_is_not_slowed() -> None:
    """Acknowledge at once: a peer with Nagle's algorithm waits 40 ms for a late acknowledgement."""
    port = find_free_port()
    with open_simulation(port) as simulation:
        px4 = Px4Stub(port, hold_depth, garbage=bytes(3000), has_delay=True)
        simulation.advance()
        start = time.monotonic()
        for _ in range(200):
            simulation.advance()
        assert time.monotonic() - start < 100 * 0.03  # 0.04 s each without
    px4.join()


def test_bytes_that_are_no_frames_are_counted_and_change_nothing() -> None:
    garbage = bytes(range(256)) + b"\xfd\xff\x00\x00\x00\x00\x00\x5d\x00\x00"
    poses = []
    for settings in ({}, {"garbage": garbage}):
        simulation, _ = run(hold_depth, stub=settings)
        poses.append(simulation.world.vehicles.find("bluerov2").world_from_base.position)
        state = device_of(simulation).state.lock_step
        assert (state.n_skipped > 10000) == bool(settings)
    assert np.array_equal(*poses)


def test_a_px4_that_leaves_ends_the_run() -> None:
    with pytest.raises(ClientLost, match="closed the connection"):
        run(hold_depth, stub={"n_answers": 10})


def test_another_client_cannot_take_the_place_of_a_px4_that_leaves() -> None:
    port = find_free_port()
    with open_simulation(port) as simulation:
        px4 = Px4Stub(port, hold_depth, n_answers=10)
        simulation.advance()
        with connect(port), pytest.raises(ClientLost, match="another client has connected"):
            simulation.advance(1.0)
    px4.join()


def test_a_px4_without_lock_step_ends_the_run() -> None:
    with pytest.raises(ClientLost, match="lock-step"):
        run(hold_depth, stub={"flags": 0})


def test_a_px4_that_does_not_connect_ends_the_run() -> None:
    spec = Px4Spec(relative_to="base_link", port=find_free_port(), limit=0.3)
    with (
        open_scene(scene_with(spec), udp_address="127.0.0.1", is_blind=True) as simulation,
        pytest.raises(ClientLost, match="has not connected"),
    ):
        simulation.advance()


def test_a_program_that_is_no_px4_is_named_when_the_run_ends() -> None:
    port, is_over = find_free_port(), threading.Event()

    def request() -> None:
        with connect(port) as connection:
            connection.sendall(b"GET / HTTP/1.0\r\n\r\n")
            is_over.wait(60.0)

    spec = Px4Spec(relative_to="base_link", port=port, limit=1.0)
    with open_scene(scene_with(spec), udp_address="127.0.0.1", is_blind=True) as simulation:
        thread = threading.Thread(target=request, daemon=True)
        thread.start()
        with pytest.raises(ClientLost, match=r"A program has connected .* 18 bytes of no message"):
            simulation.advance()
        is_over.set()
        thread.join()


def test_a_flood_of_bytes_without_an_answer_ends_the_run() -> None:
    port = find_free_port()

    def flood() -> None:
        with connect(port) as connection:
            try:
                while True:
                    connection.sendall(bytes(range(256)) * 256)
            except OSError:
                return

    spec = Px4Spec(relative_to="base_link", port=port, limit=30.0)
    with open_scene(scene_with(spec), udp_address="127.0.0.1", is_blind=True) as simulation:
        thread = threading.Thread(target=flood, daemon=True)
        thread.start()
        with pytest.raises(ClientLost, match="bytes"):
            simulation.advance()
    thread.join(timeout=10.0)


def test_without_connections_the_device_is_idle() -> None:
    spec = Px4Spec(relative_to="base_link")
    with open_scene(scene_with(spec), is_blind=True) as simulation:
        simulation.advance(0.1)
        assert device_of(simulation).state.lock_step.n_frames == 0


def test_a_rate_that_is_no_whole_number_of_steps_is_an_error() -> None:
    with pytest.raises(UwsimError, match=r"expected 500 or 250 Hz"):
        open_scene(scene_with(Px4Spec(relative_to="base_link", rate=300.0)), is_blind=True)


def test_the_outputs_without_names_are_those_of_a_bluerov2() -> None:
    commands = Motors((), THRUSTERS).commands([0.1 * i for i in range(1, 17)])
    assert commands == pytest.approx([0.1, 0.2, 0.3, 0.4, -0.5, 0.6, 0.7, -0.8])
    with pytest.raises(BadSetting, match="<motor>"):
        Motors((), ("left", "right"))


def test_an_output_names_its_thruster_and_its_sign() -> None:
    commands = Motors(("right", "-left"), ("left", "right")).commands([0.25, 0.5])
    assert commands == pytest.approx([-0.5, 0.25])
    with pytest.raises(UnknownName, match="rigth"):
        Motors(("rigth",), ("left", "right"))
    with pytest.raises(BadSetting, match="at most 16"):
        Motors(("left",) * 17, ("left", "right"))


def test_a_board_whose_z_axis_points_up_is_an_error() -> None:
    spec = Px4Spec(orientation=(math.pi, 0.0, 0.0))
    with pytest.raises(BadSetting, match="points up"):
        open_scene(scene_with(spec), is_blind=True)


def test_a_run_with_px4_has_no_other_autopilot() -> None:
    scene = connect_px4(read_scene(bundled_files("scenes")["bluerov2-scene"]))
    (vehicle,) = scene.vehicles
    assert vehicle.parts_of(Px4Spec) == (Px4Spec(),)
    assert vehicle.parts_of(ArduPilotSpec) == ()
    (vehicle,) = connect_ardupilot(scene).vehicles
    assert vehicle.parts_of(Px4Spec) == ()


def test_a_scene_without_dynamics_or_with_one_port_for_two_is_an_error() -> None:
    with pytest.raises(BadSetting, match="dynamics"):
        connect_px4(read_scene(bundled_files("scenes")["cirs"]))
    scene = scene_with(Px4Spec())
    twice = replace(scene, vehicles=scene.vehicles * 2)
    with pytest.raises(BadSetting, match="4560"):
        connect_px4(twice)
