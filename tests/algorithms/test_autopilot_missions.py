"""Missions arm an autopilot, set its mode, and send setpoints by simulation time."""

from __future__ import annotations

import itertools
import math
import socket
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.support.fake_autopilot import FakeAutopilot
from uwsim.algorithms import check_parameters
from uwsim.algorithms.autopilot_missions import AutopilotPath, AutopilotStation, read_path
from uwsim.algorithms.pilot import AXES, TOPIC, Pilot
from uwsim.assets.bundled import bundled_files
from uwsim.bus import Algorithm
from uwsim.devices.ardupilot import ArduPilotSpec
from uwsim.devices.mavlink import MavlinkSpec
from uwsim.errors import BadSetting
from uwsim.messages import Empty, Float64MultiArray, MultiArrayLayout
from uwsim.model.scene_model import SceneModel
from uwsim.physics.compile_scene import compile_scene
from uwsim.runs.trial.pilot_topics import pilot_topics
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation
from uwsim.viewer.live.mapping import PilotMapping
from uwsim.viewer.live.pilot_targets import find_pilot_targets

GUIDED, ALT_HOLD = 4, 2


@pytest.fixture(scope="module")
def port() -> Iterator[socket.socket]:
    with socket.create_server(("127.0.0.1", 0)) as listener:
        yield listener


@pytest.fixture(scope="module")
def model(port: socket.socket) -> SceneModel:
    """Return bluerov2-scene with MAVLink alone: the fake autopilot has no physics."""
    scene = read_scene(Path(bundled_files("scenes")["bluerov2-scene"]))
    (vehicle,) = scene.vehicles
    link = MavlinkSpec(name="/bluerov2/autopilot", address=f"tcp:127.0.0.1:{port.getsockname()[1]}")
    parts = [part for part in vehicle.parts if not isinstance(part, ArduPilotSpec | MavlinkSpec)]
    return compile_scene(replace(scene, vehicles=(replace(vehicle, parts=(*parts, link)),)))


class Flight:
    """A run of a mission with a fake autopilot."""

    def __init__(
        self,
        port: socket.socket,
        model: SceneModel,
        mission: Algorithm,
        parameters: dict[str, float | str] | None = None,
    ) -> None:
        self.autopilot = FakeAutopilot(listener=port)
        self.autopilot.has_estimate = True
        self.simulation = Simulation(model, is_blind=True, udp_address="127.0.0.1")
        self.autopilot.accept()
        self.start_times: list[float] = []
        self.simulation.bus.services.serve("startBench", Empty, self._start)
        self.simulation.watch(lambda: self.autopilot.poll(self.simulation.time))
        self.simulation.attach(mission, parameters=parameters or {})

    def _start(self, _: Empty) -> Empty:
        self.start_times.append(self.simulation.time)
        return Empty()

    def close(self) -> None:
        self.simulation.close()
        self.autopilot.close()


def test_a_station_is_held_armed_and_guided(port: socket.socket, model: SceneModel) -> None:
    flight = Flight(port, model, AutopilotStation(), {"position": "0.5 -1 2", "yaw": "0.3"})
    flight.simulation.advance(12.0)
    autopilot = flight.autopilot
    assert (autopilot.is_armed, autopilot.mode) == (True, GUIDED)
    commands = [m for m in autopilot.find_messages("COMMAND_LONG") if m.command in (176, 400)]
    assert [(m.command, m.param2 if m.command == 176 else m.param1) for m in commands] == [
        *((176, ALT_HOLD), (400, 1.0), (176, GUIDED))
    ]
    setpoint = autopilot.find_messages("SET_POSITION_TARGET_LOCAL_NED")[-1]
    assert [setpoint.x, setpoint.y, setpoint.z] == pytest.approx([0.5, -1.0, 2.0 - 1.5])
    assert [setpoint.vx, setpoint.vy, setpoint.vz] == [0, 0, 0]
    assert setpoint.yaw == pytest.approx(0.3)
    assert setpoint.type_mask & 0x3F == 0  # a position with a velocity, which is no waypoint
    sticks = autopilot.find_messages("MANUAL_CONTROL")
    assert {(m.x, m.y, m.z, m.r) for m in sticks} == {(0, 0, 500, 0)}
    assert 5.0 < flight.start_times[0] < 11.0
    flight.close()


def test_nothing_is_commanded_before_the_estimate(port: socket.socket, model: SceneModel) -> None:
    flight = Flight(port, model, AutopilotStation(), {"estimate_time": 6.0})
    flight.autopilot.has_estimate = False
    flight.simulation.advance(5.0)
    assert not [m for m in flight.autopilot.find_messages("COMMAND_LONG") if m.command == 176]
    flight.simulation.advance(4.0)  # without an estimate, the commands are tried
    assert [m for m in flight.autopilot.find_messages("COMMAND_LONG") if m.command == 176]
    flight.close()


def test_an_autopilot_that_refuses_to_arm_is_asked_again(
    port: socket.socket, model: SceneModel
) -> None:
    flight = Flight(port, model, AutopilotStation())
    flight.autopilot.can_arm = False
    flight.simulation.advance(6.0)
    assert not flight.autopilot.is_armed
    assert flight.start_times == []
    flight.autopilot.can_arm = True
    flight.simulation.advance(10.0)
    assert flight.autopilot.is_armed
    assert flight.start_times
    flight.close()


def test_the_setpoint_of_a_path_moves_at_its_speed(port: socket.socket, model: SceneModel) -> None:
    flight = Flight(port, model, AutopilotPath())
    flight.simulation.advance(20.0)
    setpoints = flight.autopilot.find_messages("SET_POSITION_TARGET_LOCAL_NED")
    begin = next(m for m in setpoints if m.vx > 0)
    later = next(m for m in setpoints if m.time_boot_ms >= begin.time_boot_ms + 4000)
    seconds = 1e-3 * (later.time_boot_ms - begin.time_boot_ms)
    assert later.x - begin.x == pytest.approx(0.15 * seconds, abs=1e-3)
    assert later.vx == pytest.approx(0.15)
    assert later.z == pytest.approx(0.0)  # the depth of the start
    flight.close()


@given(
    points=st.lists(st.tuples(*[st.integers(-5, 5)] * 3), min_size=2, max_size=6),
    time=st.floats(0, 200),
)
def test_a_setpoint_is_on_its_path_and_moves_along_it(
    points: list[tuple[int, int, int]], time: float
) -> None:
    points = [p for k, p in enumerate(points) if k == 0 or p != points[k - 1]]
    if len(points) < 2:
        return
    mission = AutopilotPath()
    mission._points = np.array(points, dtype=float)
    mission._lengths = [math.dist(a, b) for a, b in itertools.pairwise(points)]
    mission._yaw, mission.parameters = 0.0, {"speed": 0.5, "laps": 2.0}
    position, velocity, _ = mission.setpoint(time)
    on_edge = [
        abs(math.dist(a, position) + math.dist(position, b) - math.dist(a, b)) < 1e-6
        for a, b in itertools.pairwise(points)
    ]
    assert any(on_edge)
    is_moving = 0.0 < time < 2.0 * sum(mission._lengths) / 0.5
    assert float(np.sqrt(np.sum(velocity**2))) == pytest.approx(0.5 if is_moving else 0.0)


def test_a_mission_stays_at_the_end_of_its_last_lap() -> None:
    mission = AutopilotPath()
    mission._points = np.array([[0.0, 0.0, 1.5], [1.0, 0.0, 1.5], [1.0, 1.0, 1.5]])
    mission._lengths, mission._yaw = [1.0, 1.0], 0.0
    mission.parameters = {"speed": 0.5, "laps": 1.0}
    assert np.array_equal(mission.setpoint(3.9)[1], [0.0, 0.5, 0.0])
    position, velocity, _ = mission.setpoint(5.0)
    assert np.array_equal(position, [1.0, 1.0, 1.5])
    assert np.array_equal(velocity, np.zeros(3))


@pytest.mark.parametrize(
    ("mission", "parameters", "expected"),
    [
        (AutopilotStation, {"position": "1 2"}, "expected 3 numbers"),
        (AutopilotStation, {"position": "1 2 nan"}, "expected 3 numbers"),
        (AutopilotStation, {"positon": "1 2 3"}, "Did you mean 'position'"),
        (AutopilotPath, {"path": "1 2 3 4"}, "has 4 numbers"),
        (AutopilotPath, {"path": "1 2 3 1 2 3"}, "two equal points"),
        (AutopilotPath, {"yaw": "north"}, "expected a number"),
    ],
)
def test_an_invalid_parameter_is_an_error(
    mission: type[Algorithm], parameters: dict[str, float | str], expected: str
) -> None:
    with pytest.raises(BadSetting, match=expected):
        check_parameters(mission, parameters)


def test_a_path_has_a_limit() -> None:
    with pytest.raises(BadSetting, match="2 points or more"):
        read_path(" ".join(["1 2 3 4 5 6"] * 1000))


def test_a_pilot_steers_the_vehicle_by_its_autopilot(
    port: socket.socket, model: SceneModel
) -> None:
    with Simulation(model, is_blind=True) as simulation:
        parameters = pilot_topics(simulation)
        assert "autopilot" not in parameters  # nothing is connected
        assert parameters["thrusters_topic"]
    flight = Flight(port, model, Pilot(), {"autopilot": "/bluerov2/autopilot", "start": ""})
    parameters = pilot_topics(flight.simulation)
    assert parameters["autopilot"] == "/bluerov2/autopilot"
    assert not {"twist_topic", "thrusters_topic"} & set(parameters)
    targets = find_pilot_targets(flight.simulation.world, parameters)
    keys = targets.keys(PilotMapping())
    assert {keys[key] for key in "567890"} == {
        *("+arm", "-arm", "+mode1", "+mode2", "+mode3", "+mode4")
    }
    assert targets.names["mode4"] == "POSHOLD"
    values = np.zeros(len(AXES))
    values[[AXES.index("surge"), AXES.index("arm"), AXES.index("mode4")]] = 1.0
    layout = MultiArrayLayout(dim=[], data_offset=0)
    flight.simulation.bus.publisher(TOPIC, Float64MultiArray)(Float64MultiArray(layout, values))
    flight.simulation.advance(1.5)
    assert (flight.autopilot.is_armed, flight.autopilot.mode) == (True, 16)
    assert flight.autopilot.find_messages("MANUAL_CONTROL")[-1].x == 1000
    flight.close()
