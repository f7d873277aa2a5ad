"""What ArduPilot reads is the vehicle's motion in its axes; what it writes moves the vehicle."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.small_robots import scene_of, shape, write_robot
from tests.support.ardupilot_stub import State, Stub, free_port
from tests.support.opened import open_scene
from uwsim.assets.bundled import bundled_files
from uwsim.base.geometry import Pose, rotation_from_rpy
from uwsim.devices.ardupilot import ArduPilotSpec
from uwsim.devices.ardupilot.channels import ChannelSpec
from uwsim.devices.lamp import LampSpec, MountedLamp
from uwsim.errors import SceneError, UnknownName
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import NedOriginSpec, SceneSpec, SimParamsSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.simulation import Simulation

NED = SimParamsSpec(offsetr=(math.pi, 0.0, -math.pi / 2))
GRAVITY = 9.81
HYDRODYNAMICS = """<hydrodynamics name="box">
  <source>a box</source> <density>1000</density>
  <body link="base_link">
    <mass>20</mass> <inertia>0.5 0.6 0.7 0 0 0</inertia>
    <volume>0.02</volume> <shape>box</shape> <size>0.5 0.4 0.1</size>
  </body>
  <thruster name="port" link="base_link">
    <position> <x>0</x> <y>{y}</y> <z>0</z> </position>
    <direction> <x>1</x> <y>0</y> <z>0</z> </direction> <forward>40</forward>
  </thruster>
  <thruster name="starboard" link="base_link">
    <position> <x>0</x> <y>{minus_y}</y> <z>0</z> </position>
    <direction> <x>1</x> <y>0</y> <z>0</z> </direction> <forward>40</forward>
  </thruster>
</hydrodynamics>"""
JAW = """<link name="jaw"><inertial> <mass value="0.5"/>
  <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/> </inertial></link>
  <joint name="hinge" type="revolute"> <parent link="base_link"/> <child link="jaw"/>
    <axis xyz="0 0 1"/> <limit lower="-1" upper="1" effort="20" velocity="1"/> </joint>"""


def craft(
    folder: Path, spec: ArduPilotSpec, *, is_z_down: bool = True, joints: str = "", **fields: object
) -> VehicleSpec:
    """Return a craft with two thrusters that skid steer, whose base has z down or up."""
    y = -0.3 if is_z_down else 0.3
    (folder / "box.xml").write_text(HYDRODYNAMICS.format(y=y, minus_y=-y))
    robot = write_robot(folder, f'<link name="base_link">{shape()}</link>{joints}')
    orientation = (0.0, 0.0, 0.0) if is_z_down else (math.pi, 0.0, 0.0)
    return replace(
        VehicleSpec(
            name="craft", file=str(robot), orientation=orientation, dynamics="box",
            position=(1.0, 2.0, 5.0), parts=(spec,),
        ),
        **fields,
    )  # fmt: skip


@contextmanager
def opened(folder: Path, *vehicles: VehicleSpec) -> Iterator[Simulation]:
    scene = replace(
        scene_of(vehicles[0], sim_params=NED), vehicles=vehicles, path=str(folder / "scene.xml"),
        ned_origin=NedOriginSpec(lat=41.775, lon=3.033),
    )  # fmt: skip
    with open_scene(
        scene, timestep=0.0025, data_path=[folder], udp_address="127.0.0.1", is_blind=True
    ) as simulation:
        yield simulation


def turn_to_starboard(state: State) -> list[int]:
    return [1600, 1500]


@pytest.mark.parametrize("is_z_down", [True, False])
def test_both_axes_of_a_base_give_the_same_motion(tmp_path: Path, is_z_down: bool) -> None:
    port = free_port()
    vehicle = craft(tmp_path, ArduPilotSpec(port=port), is_z_down=is_z_down)
    with opened(tmp_path, vehicle) as simulation:
        with Stub(port, turn_to_starboard) as stub:
            simulation.advance(1.0)
        pose = simulation.pose("craft")
    first, last = stub.states[0], stub.states[395]
    assert np.allclose(first["position"], (1.0, 2.0, 5.0), atol=1e-3)
    assert np.allclose(first["imu.accel_body"][1:], (0.0, -GRAVITY), atol=0.02)
    assert first["imu.accel_body"][0] == pytest.approx(10.0 / 20.0, rel=0.3)  # 10 N at 1600 us
    assert np.allclose(np.abs(last["quaternion"][1:3]), 0.0, atol=1e-3)
    assert last["quaternion"][3] > 0.1  # the port thruster turns it to starboard, about down
    assert last["imu.gyro"][2] > 0.2
    assert last["position"][1] > 2.0  # and north becomes east
    assert pose.position[0] == pytest.approx(last["position"][0], abs=0.05)


def test_a_tilted_vehicle_at_rest_feels_gravity_in_its_axes(tmp_path: Path) -> None:
    port, (roll, pitch, yaw) = free_port(), (0.3, -0.2, 1.0)
    with opened(tmp_path, craft(tmp_path, ArduPilotSpec(port=port))) as simulation:
        pose = Pose(np.array([1.0, 2.0, 5.0]), rotation_from_rpy(roll, pitch, yaw))
        simulation.set_pose("craft", pose)
        with Stub(port, lambda state: [1500, 1500]) as stub:
            simulation.advance(0.005)
    state = stub.states[0]
    expected = (
        GRAVITY * math.sin(pitch),
        -GRAVITY * math.sin(roll) * math.cos(pitch),
        -GRAVITY * math.cos(roll) * math.cos(pitch),
    )
    assert np.allclose(state["imu.accel_body"], expected, atol=0.02)
    assert np.allclose(state["quaternion"], pose.quaternion, atol=1e-3)


def test_the_specific_force_is_the_derivative_of_the_velocity(tmp_path: Path) -> None:
    port = free_port()
    with (
        opened(tmp_path, craft(tmp_path, ArduPilotSpec(port=port))) as simulation,
        Stub(port, turn_to_starboard) as stub,
    ):
        simulation.advance(1.0)
    states = stub.states[100:300]
    velocities = np.array([state["velocity"] for state in states])
    differences = np.diff(velocities, axis=0) / 0.0025
    for state, difference in zip(states[1:], differences, strict=True):
        ned_from_body = Pose.from_quaternion(np.zeros(3), np.array(state["quaternion"])).rotation
        force = ned_from_body @ np.array(state["imu.accel_body"])
        assert np.allclose(force + np.array([0.0, 0.0, GRAVITY]), difference, atol=0.02)


def test_the_position_may_be_latitude_and_longitude(tmp_path: Path) -> None:
    port = free_port()
    spec = ArduPilotSpec(port=port, position="geodetic")
    with (
        opened(tmp_path, craft(tmp_path, spec)) as simulation,
        Stub(port, lambda state: [1500, 1500]) as stub,
    ):
        simulation.advance(0.01)
    state = stub.states[0]
    assert "position" not in state
    assert state["latitude"][0] == pytest.approx(41.775 + 1.0 / 111_070.0, abs=1e-7)
    assert state["longitude"][0] == pytest.approx(3.033 + 2.0 / 83_130.0, abs=1e-7)
    assert state["altitude"][0] == pytest.approx(-5.0, abs=1e-2)


def test_home_and_wind_are_sent(tmp_path: Path) -> None:
    port = free_port()
    spec = ArduPilotSpec(port=port, home=(1.0, 0.5, 2.0), wind=(3.0, -2.0, 0.0))
    with (
        opened(tmp_path, craft(tmp_path, spec)) as simulation,
        Stub(port, lambda state: [1500, 1500]) as stub,
    ):
        simulation.advance(0.01)
    assert np.allclose(stub.states[0]["position"], (0.0, 1.5, 3.0), atol=1e-3)
    assert stub.states[0]["velocity_wind"] == (3.0, -2.0, 0.0)


def test_channels_drive_reversed_thrusters_lamps_and_joints(tmp_path: Path) -> None:
    port = free_port()
    channels = (
        ChannelSpec(number=3, thruster="port", reversed=True),
        ChannelSpec(number=4, lamp="headlight"),
        ChannelSpec(number=5, joint="hinge", lower=-0.5, upper=0.5),
    )
    lamp = LampSpec(name="headlight", relative_to="base_link")
    vehicle = craft(tmp_path, ArduPilotSpec(port=port, channels=channels), joints=JAW)
    vehicle = replace(vehicle, parts=(lamp, *vehicle.parts))
    with opened(tmp_path, vehicle) as simulation:
        (headlight,) = [d for d in simulation.world.devices if isinstance(d, MountedLamp)]
        with Stub(port, lambda state: [1900, 1900, 1700, 1300, 1900]):
            simulation.advance(0.3)
            assert simulation.velocity("craft")[0] < -0.1
            simulation.advance(1.7)
        assert headlight.state.brightness == pytest.approx(0.25)
        assert simulation.world.vehicles.find("craft").joints[0] == pytest.approx(0.5, abs=0.02)
    with opened(tmp_path, vehicle) as simulation:
        (headlight,) = [d for d in simulation.world.devices if isinstance(d, MountedLamp)]
        with Stub(port, lambda state: [0] * 16):
            simulation.advance(0.5)
        assert abs(simulation.velocity("craft")[0]) < 0.01
        assert headlight.state.brightness == 0.0


def test_time_waits_for_all_vehicles(tmp_path: Path) -> None:
    ports = free_port(), free_port()
    vehicles = [
        replace(
            craft(tmp_path, ArduPilotSpec(port=port)),
            name=f"craft{i}",
            position=(3.0 * i, 0.0, 5.0),
        )
        for i, port in enumerate(ports)
    ]
    with (
        opened(tmp_path, *vehicles) as simulation,
        Stub(ports[0], turn_to_starboard) as first,
        Stub(ports[1], turn_to_starboard) as second,
    ):
        simulation.advance(0.5)
    n = min(len(first.states), len(second.states))
    assert n > 190
    assert [s["timestamp"] for s in first.states[:n]] == [s["timestamp"] for s in second.states[:n]]
    assert abs(second.states[0]["position"][0] - first.states[0]["position"][0]) == pytest.approx(3)


@pytest.mark.parametrize("rate", [100.0, 130.0, 1200.0])
def test_exchanges_take_a_whole_number_of_steps(tmp_path: Path, rate: float) -> None:
    port = free_port()
    with (
        opened(tmp_path, craft(tmp_path, ArduPilotSpec(port=port, rate=rate))) as simulation,
        Stub(port, turn_to_starboard) as stub,
    ):
        simulation.advance(0.2)
    n_steps = max(1, round(400.0 / rate))
    times = np.array([state["timestamp"][0] for state in stub.states])
    assert np.allclose(np.diff(times), 0.0025 * n_steps, atol=1e-12)


@pytest.mark.parametrize(
    ("channel", "message"),
    [
        (ChannelSpec(number=1), "expected one of <thruster>, <lamp> and <joint>"),
        (ChannelSpec(number=1, thruster="port", lamp="a"), "expected one of"),
        (ChannelSpec(number=1, thruster="prot"), "No thruster is called 'prot'.*'port'"),
        (ChannelSpec(number=1, joint="hinge"), "No joint is called 'hinge'"),
        (ChannelSpec(number=1, thruster="port", curve=(1500.0,)), "expected pairs"),
    ],
)
def test_a_channel_that_drives_nothing_is_an_error(
    tmp_path: Path, channel: ChannelSpec, message: str
) -> None:
    vehicle = craft(tmp_path, ArduPilotSpec(channels=(channel,)))
    with (
        pytest.raises((SceneError, UnknownName), match=message),
        opened(tmp_path, vehicle),
    ):
        pass


def test_the_scene_of_the_page_sends_rangefinder_and_battery() -> None:
    scene: SceneSpec = read_scene(bundled_files("scenes")["bluerov2-scene"])
    (vehicle,) = scene.vehicles
    port = free_port()
    parts = tuple(
        replace(part, port=port) if isinstance(part, ArduPilotSpec) else part
        for part in vehicle.parts
    )
    scene = replace(scene, vehicles=(replace(vehicle, parts=parts),))
    with (
        open_scene(scene, timestep=0.0025, udp_address="127.0.0.1", is_blind=True) as simulation,
        Stub(port) as stub,
    ):
        simulation.advance(0.3)
    state = stub.states[-1]
    assert state["rng_1"][0] == pytest.approx(2.36, abs=0.1)
    assert 14.0 < state["battery.voltage"][0] < 14.8
    assert 1.0 < state["battery.current"][0] < 5.0
