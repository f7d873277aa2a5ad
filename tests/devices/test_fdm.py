"""A vehicle that goes where UDP datagrams of a flight dynamics model say."""

from __future__ import annotations

import math
import socket
import struct
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.small_robots import scene_of, shape, write_robot
from tests.support.opened import open_scene
from uwsim.base.geodesy import Geodetic
from uwsim.devices.fdm import FdmInput, read_datagram
from uwsim.errors import UwsimError
from uwsim.messages import Quaternion, TFMessage, Transform, TransformStamped, Vector3, header
from uwsim.scene.spec import NedOriginSpec, SceneSpec, SimParamsSpec
from uwsim.scene.vehicle import VehicleSpec

LATITUDE, LONGITUDE = 41.775, 3.033
ORIGIN = Geodetic(latitude=math.radians(LATITUDE), longitude=math.radians(LONGITUDE))
NED = SimParamsSpec(offsetr=(math.pi, 0.0, -math.pi / 2))


def packet(
    north: float = 0.0,
    up: float = 0.0,
    angles: tuple[float, float, float] = (0.0, 0.0, 0.0),
    *,
    version: int = 24,
) -> bytes:
    latitude = ORIGIN.latitude + north / 6.3646e6  # along the meridian, to a part in 1e4
    place = struct.pack(">IIddd", version, 0, ORIGIN.longitude, latitude, up)
    return place + struct.pack(">ffff", 5.0, *angles) + bytes(360)


def scene_in(folder: Path, port: int, *, params: SimParamsSpec = NED) -> SceneSpec:
    robot = write_robot(folder, f'<link name="base_link">{shape()}</link>')
    vehicle = VehicleSpec(name="rov", file=str(robot), position=(1.0, 2.0, 3.0), fdm=port)
    origin = NedOriginSpec(lat=LATITUDE, lon=LONGITUDE)
    return replace(scene_of(vehicle, sim_params=params), ned_origin=origin)


def test_the_layout_is_that_of_flightgear_to_the_byte() -> None:
    data = bytes.fromhex(
        "00000018" "00000000"
        "3ff0000000000000"  # longitude 1.0
        "3fe0000000000000"  # latitude 0.5
        "c024000000000000"  # altitude -10.0
        "41200000"  # agl 10.0
        "3dcccccd" "be4ccccd" "3fc00000"  # roll 0.1, pitch -0.2, yaw 1.5
    )  # fmt: skip
    assert len(data) == 48
    pose = read_datagram(data, Geodetic(latitude=0.5, longitude=1.0))
    assert pose is not None
    assert np.allclose(pose.position, [0.0, 0.0, 10.0], atol=1e-8)
    assert pose.rotation[2, 0] == pytest.approx(math.sin(0.2), abs=1e-7)  # nose down
    assert math.atan2(pose.rotation[1, 0], pose.rotation[0, 0]) == pytest.approx(1.5, abs=1e-7)


@pytest.mark.parametrize(
    "data",
    [
        b"",
        packet()[:47],
        packet(version=25),
        packet(version=24 << 24),  # little-endian
        packet(angles=(math.nan, 0.0, 0.0)),
        packet(angles=(0.0, 1e6, 0.0)),
        packet(up=math.inf),
        packet(up=1e9),
        packet(north=1e8),
        bytes(range(256)),
        b"\xff" * 408,
    ],
)
def test_packets_that_are_short_foreign_or_senseless_are_dropped(data: bytes) -> None:
    assert read_datagram(data, ORIGIN) is None


def test_a_vehicle_is_where_the_newest_packet_says_and_others_are_counted(tmp_path: Path) -> None:
    waiting = [packet(north=5.0), b"junk", packet(north=100.0, up=-3.0, angles=(0.0, 0.0, 0.5))]
    with open_scene(scene_in(tmp_path, 5503)) as simulation:
        [fdm] = simulation.world.devices
        assert isinstance(fdm, FdmInput)
        fdm._receive = lambda: [waiting.pop(0) for _ in range(len(waiting))]
        simulation.advance()
        pose = simulation.pose("rov")
    assert pose.position == pytest.approx([100.0, 0.0, 3.0], abs=0.05)
    assert pose.rotation[:2, 0] == pytest.approx([math.cos(0.5), math.sin(0.5)], abs=1e-3)
    assert (fdm.state.n_valid, fdm.state.n_invalid) == (2, 1)


def test_where_ned_counts_from_may_come_from_tf(tmp_path: Path) -> None:
    with open_scene(scene_in(tmp_path, 5503)) as simulation:
        [fdm] = simulation.world.devices
        assert isinstance(fdm, FdmInput)
        fdm._receive = lambda: [packet(up=-3.0)]
        frame = TransformStamped(
            header=header(0.0, "world"),
            child_frame_id="local_origin_ned",
            transform=Transform(translation=Vector3(x=7.0, y=8.0), rotation=Quaternion()),
        )
        simulation.publish("/tf", TFMessage(transforms=[frame]))
        simulation.advance(2 * simulation.timestep)
        assert simulation.pose("rov").position == pytest.approx([7.0, 8.0, 3.0], abs=1e-6)


def free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as found:
        found.bind(("127.0.0.1", 0))
        port: int = found.getsockname()[1]
        return port


def test_packets_come_over_udp_where_the_simulation_takes_any(tmp_path: Path) -> None:
    port = free_port()
    with open_scene(scene_in(tmp_path, port), udp_address="127.0.0.1") as simulation:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            for data in (b"?", packet(up=-9.0)):
                sender.sendto(data, ("127.0.0.1", port))
        [fdm] = simulation.world.devices
        assert isinstance(fdm, FdmInput)
        for _ in range(200):
            simulation.advance()
            if fdm.state.n_valid:
                break
            time.sleep(0.005)
        assert simulation.pose("rov").position == pytest.approx([0.0, 0.0, 9.0], abs=1e-6)
        assert fdm.state.n_invalid == 1


def test_without_an_address_no_port_is_opened_and_the_vehicle_stays(tmp_path: Path) -> None:
    port = free_port()
    with open_scene(scene_in(tmp_path, port)) as simulation:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
            other.bind(("127.0.0.1", port))  # it is free
        simulation.advance(0.01)
        assert simulation.pose("rov").position == pytest.approx([1.0, 2.0, 3.0])


def test_a_port_that_is_taken_is_an_error_that_names_it(tmp_path: Path) -> None:
    scene = scene_in(tmp_path, 1)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind(("127.0.0.1", 0))
        port = other.getsockname()[1]
        taken = replace(scene, vehicles=(replace(scene.vehicles[0], fdm=port),))
        with pytest.raises(UwsimError, match=f"UDP port {port} of 127.0.0.1 cannot be opened"):
            open_scene(taken, udp_address="127.0.0.1")


@pytest.mark.parametrize("port", [-1, 0])
def test_a_port_that_is_off_makes_no_input(tmp_path: Path, port: int) -> None:
    with open_scene(scene_in(tmp_path, port)) as simulation:
        assert simulation.world.devices == ()
