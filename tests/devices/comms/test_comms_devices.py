"""Communication devices in a scene: bytes on a topic of one vehicle arrive on one of another."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.simulation.small_robots import joint, scene_of, shape, write_robot
from tests.support.opened import open_scene
from uwsim.devices.comms.acoustic_comms_device import AcousticCommsDeviceSpec, EnergyModelSpec
from uwsim.devices.comms.comms_channels import AcousticCommsChannelSpec, CustomCommsChannelSpec
from uwsim.devices.comms.comms_device import MacProtocolSpec, MeshSpec
from uwsim.devices.comms.custom_comms_device import CustomCommsDeviceSpec, RateErrorModelSpec
from uwsim.errors import BadMessage
from uwsim.messages import MultiArrayDimension, MultiArrayLayout, String, UInt8MultiArray
from uwsim.scene.spec import NetTracingScriptSpec, OceanStateSpec, SceneSpec, SimParamsSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.simulation import Simulation
from uwsim.topics.comms_device_ros import AcousticCommsDeviceROSSpec, CustomCommsDeviceROSSpec

SEA = AcousticCommsChannelSpec(id=0, temperature=10.0, salinity=35.0)
SPEED = 1489.803 + 1.630e-2 * 50.0 + 1.675e-7 * 50.0**2  # Mackenzie at 10 degrees, S 35, 50 m
MODEM = {"channel_id": 0, "relative_to": "base_link", "symbols_per_second": 500.0, "range": 3500.0}


def modem(name: str, mac: int, **given: Any) -> AcousticCommsDeviceSpec:
    return AcousticCommsDeviceSpec(dccomms_id=name, mac=mac, **{**MODEM, **given})


def radio(name: str, mac: int, **given: Any) -> CustomCommsDeviceSpec:
    common = {"tx_channel_id": 3, "rx_channel_id": 3, "relative_to": "base_link"}
    return CustomCommsDeviceSpec(dccomms_id=name, mac=mac, **{**common, **given})


def scene_in(
    folder: Path,
    make: Callable[[str, int], Any] = modem,
    *,
    apart: float = 1500.0,
    **given: object,
) -> SceneSpec:
    """Two vehicles 50 m deep with a device each, ``left`` with address 1 and ``right`` with 2."""
    links = f'<link name="base_link">{shape(xyz="0 0 0.5")}</link>'
    robot = write_robot(folder, links)
    vehicles = []
    for number, name in enumerate(("left", "right"), start=1):
        device = make(f"{name}_modem", number)
        vehicles.append(
            VehicleSpec(
                name=name,
                file=str(robot),
                position=(apart * (number - 1), 0.0, -50.0),
                parts=(device,),
            )
        )
    scene = scene_of(vehicles[0], acoustic_comms_channels=(SEA,), **given)
    return replace(scene, vehicles=tuple(vehicles))


def packet(data: bytes, to: int | None = None) -> UInt8MultiArray:
    dim = [] if to is None else [MultiArrayDimension(label="destination", size=to)]
    return UInt8MultiArray(
        layout=MultiArrayLayout(dim=[*dim]), data=np.frombuffer(data, dtype=np.uint8)
    )


class Ends:
    """What arrives at both devices, with the step at which it does."""

    def __init__(self, simulation: Simulation) -> None:
        self.heard: list[tuple[str, int, bytes, int]] = []
        for name in ("left", "right"):
            simulation.bus.subscribe(
                f"{name}_modem/rx",
                UInt8MultiArray,
                lambda message, name=name: self.heard.append(  # type: ignore[misc]
                    (name, simulation.step, message.data.tobytes(), message.layout.dim[0].size)
                ),
            )


def test_a_packet_over_1500_m_of_sea_arrives_at_the_step_after_its_delay(tmp_path: Path) -> None:
    with open_scene(scene_in(tmp_path), timestep=0.01) as simulation:
        ends = Ends(simulation)
        simulation.publish("/left_modem/tx", packet(b"where are you?"))
        simulation.advance(2.0)
    # sent at step 0; 14 bytes at 500 bit/s; 1500 m of sound; delivered at the next step
    arrives = 14 * 8 / 500.0 + 1500.0 / SPEED
    assert ends.heard == [("right", math.ceil(arrives / 0.01), b"where are you?", 1)]


def test_two_vehicles_talk_and_the_answer_takes_as_long(tmp_path: Path) -> None:
    with open_scene(scene_in(tmp_path), timestep=0.01) as simulation:
        ends = Ends(simulation)
        answer = simulation.bus.publisher("/right_modem/tx", UInt8MultiArray)
        simulation.bus.subscribe(
            "/right_modem/rx", UInt8MultiArray, lambda _: answer(packet(b"here", to=1))
        )
        simulation.publish("/left_modem/tx", packet(b"ping", to=2))
        simulation.advance(4.0)
    one_way = 4 * 8 / 500.0 + 1500.0 / SPEED
    there = math.ceil(one_way / 0.01)
    back = math.ceil((0.01 * there + one_way) / 0.01)
    assert ends.heard == [("right", there, b"ping", 1), ("left", back, b"here", 2)]


def test_a_packet_for_another_address_is_not_handed_on(tmp_path: Path) -> None:
    with open_scene(scene_in(tmp_path), timestep=0.01) as simulation:
        ends = Ends(simulation)
        simulation.publish("/left_modem/tx", packet(b"?", to=7))
        simulation.advance(2.0)
    assert ends.heard == []


def test_a_vehicle_out_of_range_hears_nothing(tmp_path: Path) -> None:
    with open_scene(scene_in(tmp_path, apart=3501.0), timestep=0.01) as simulation:
        ends = Ends(simulation)
        simulation.publish("/left_modem/tx", packet(b"?"))
        simulation.advance(4.0)
    assert ends.heard == []


def test_a_custom_link_has_the_delays_of_its_channel_and_device(tmp_path: Path) -> None:
    channel = CustomCommsChannelSpec(id=3, min_prop_time=100.0, prop_time_inc_per_meter=1.0)
    scene = scene_in(
        tmp_path,
        lambda name, mac: radio(name, mac, bitrate=800.0, intrinsic_delay=50.0),
        apart=40.0,
        custom_comms_channels=(channel,),
    )
    with open_scene(scene, timestep=0.01) as simulation:
        ends = Ends(simulation)
        simulation.publish("/left_modem/tx", packet(bytes(10)))
        simulation.advance(1.0)
    arrives = 0.05 + 10 * 8 / 800.0 + 0.1 + 0.04
    assert [step for _, step, _, _ in ends.heard] == [math.ceil(arrives / 0.01 - 1e-9)]


def test_a_formula_loses_as_many_packets_as_it_says(tmp_path: Path) -> None:
    model = RateErrorModelSpec(error_unit="packet", error_rate_expr="0.02*m")
    scene = scene_in(
        tmp_path,
        lambda name, mac: radio(name, mac, bitrate=1e6, rate_error_model=model),
        apart=20.0,
    )
    with open_scene(scene, timestep=0.01) as simulation:
        ends = Ends(simulation)
        for _ in range(200):
            simulation.publish("/left_modem/tx", packet(b"x"))
        simulation.advance(0.5)
        counts = simulation.world.network.modem("right/right_modem").counts
    assert counts.n_errors + len(ends.heard) == 200
    assert 90 <= len(ends.heard) <= 150  # 120 expected, 4 sigma are 28


def test_noise_loses_packets_where_the_signal_is_too_weak(tmp_path: Path) -> None:
    sea = replace(SEA, shipping=0.5, wind_speed=5.0, absorption="thorp")

    def received(level: float) -> int:
        def make(name: str, mac: int) -> AcousticCommsDeviceSpec:
            return modem(name, mac, source_level=level, k=1.5, symbols_per_second=4096.0)

        scene = replace(scene_in(tmp_path, make), acoustic_comms_channels=(sea,))
        with open_scene(scene, timestep=0.01) as simulation:
            ends = Ends(simulation)
            simulation.publish("/left_modem/tx", packet(bytes(64)))
            simulation.advance(2.0)
        return len(ends.heard)

    assert received(175.0) == 1  # Eb/N0 is 43 dB
    assert received(132.0) == 0  # 0 dB: 8 % of the bits are damaged


def test_what_is_left_of_the_energy_is_published(tmp_path: Path) -> None:
    model = EnergyModelSpec(energy_level=100.0, p_t_consume=20.0, p_r_consume=1.0, p_idle=0.1)
    scene = scene_in(tmp_path, lambda name, mac: modem(name, mac, energy_model=model))
    with open_scene(scene, timestep=0.01) as simulation:
        simulation.latest_message("/left_modem/energy")
        simulation.publish("/left_modem/tx", packet(bytes(25)))  # 0.4 s
        simulation.advance(2.0)
        left = simulation.latest_message("/left_modem/energy").data
    assert left == pytest.approx(100.0 - 20.0 * 0.4 - 0.1 * 1.6)


def test_a_disabled_device_neither_sends_nor_receives(tmp_path: Path) -> None:
    scene = scene_in(tmp_path, lambda name, mac: modem(name, mac, disable=mac == 2))
    with open_scene(scene, timestep=0.01) as simulation:
        assert "right_modem/rx" not in simulation.topics
        assert "left_modem/rx" in simulation.topics


def test_a_device_on_a_link_that_is_not_there_is_left_out(tmp_path: Path) -> None:
    scene = scene_in(tmp_path, lambda name, mac: modem(name, mac, relative_to="no_link"))
    with open_scene(scene) as simulation:
        assert "left_modem/rx" not in simulation.topics


def test_data_that_are_no_bytes_are_refused(tmp_path: Path) -> None:
    with open_scene(scene_in(tmp_path)) as simulation, pytest.raises(BadMessage, match="bytes"):
        simulation.publish("/left_modem/tx", UInt8MultiArray(data=np.zeros(3)))  # type: ignore[arg-type]


def test_a_restored_simulation_hears_the_same(tmp_path: Path) -> None:
    scene = scene_in(tmp_path)
    with open_scene(scene, timestep=0.01) as first, open_scene(scene, timestep=0.01) as second:
        heard, again = Ends(first), Ends(second)
        first.publish("/left_modem/tx", packet(b"on its way"))
        first.advance(0.5)
        second.restore(first.save())
        first.advance(1.5)
        second.advance(1.5)
    assert heard.heard == again.heard != []


def test_the_interface_publishes_the_links_visual_frame_and_the_frame_of_the_device(
    tmp_path: Path,
) -> None:
    links = (
        f'<link name="base_link">{shape()}</link><link name="mast">{shape(xyz="0 0 0.5")}</link>'
    )
    robot = write_robot(tmp_path, links + joint("step", "base_link mast", xyz="1 0 0"))
    place = {"relative_to": "mast", "position": (0.0, 0.2, 0.0), "orientation": (0.1, 0.2, 0.3)}
    vehicle = VehicleSpec(
        name="rov",
        file=str(robot),
        position=(5.0, 6.0, 7.0),
        parts=(
            modem("modem", 1, **place),
            radio("radio", 2, tf_id="/rf", relative_tf_id="/mast"),
        ),
    )
    interfaces = (
        AcousticCommsDeviceROSSpec(name="modem", topic="/modem/pose", rate=5),
        CustomCommsDeviceROSSpec(name="radio", topic="/radio/pose"),
    )
    ned = SimParamsSpec(offsetr=(math.pi, 0.0, -math.pi / 2))
    scene = scene_of(
        vehicle, ros_interfaces=interfaces, sim_params=ned, ocean_state=OceanStateSpec()
    )
    with open_scene(scene, is_blind=True) as simulation:
        frames: dict[str, Any] = {}
        simulation.bus.subscribe(
            "/tf",
            object,
            lambda m: frames.update({m.transforms[0].child_frame_id: m.transforms[0]}),
        )
        simulation.latest_message("/modem/pose")
        simulation.advance(0.2)
        pose = simulation.latest_message("/modem/pose").position
    assert [pose.x, pose.y, pose.z] == pytest.approx([6.0, 6.0, -7.5])  # W: x east, z up
    assert frames["rov/modem"].header.frame_id == "rov/mast"
    moved = frames["rov/modem"].transform
    assert [moved.translation.x, moved.translation.y] == pytest.approx([0.0, 0.2])
    c, s = [math.cos(a / 2) for a in (0.1, 0.2, 0.3)], [math.sin(a / 2) for a in (0.1, 0.2, 0.3)]
    assert moved.rotation.w == pytest.approx(c[0] * c[1] * c[2] + s[0] * s[1] * s[2])
    assert moved.rotation.x == pytest.approx(s[0] * c[1] * c[2] - c[0] * s[1] * s[2])
    assert (frames["rf"].header.frame_id, frames["rf"].child_frame_id) == ("mast", "rf")


@pytest.mark.parametrize(
    ("name", "kind"),
    [("", "aloha"), ("ALOHA", "aloha"), ("slotted ALOHA", "slotted"), ("CSMA", "csma"),
     ("ns3::AquaSimAloha", "aloha"), ("AquaSimBroadcastMac", "aloha"), ("SFAMA", "aloha")],
)  # fmt: skip
def test_protocols_are_known_by_the_names_that_files_give_them(name: str, kind: str) -> None:
    channel = CustomCommsChannelSpec(id=0).bind()
    spec = MacProtocolSpec(name=name, max_distance=1000.0)
    mac = spec.bind(channel, lambda n_bytes: n_bytes * 1_000_000)
    assert mac.kind == kind
    assert mac.slot == 666_670_000 + 64_000_000
    assert replace(spec, slot=0.5).bind(channel, lambda _: 1).slot == 500_000_000


def test_a_scene_with_a_tracing_script_publishes_what_becomes_of_packets(tmp_path: Path) -> None:
    scene = replace(scene_in(tmp_path, apart=15.0), net_tracing_script=NetTracingScriptSpec())
    with open_scene(scene, timestep=0.01) as simulation:
        lines: list[str] = []
        simulation.bus.subscribe("/network/trace", String, lambda line: lines.append(line.data))
        simulation.publish("/left_modem/tx", packet(b"?"))
        simulation.advance(0.1)
    assert [line.split()[1:3] for line in lines] == [
        ["left/left_modem", "queued"],
        ["left/left_modem", "sent"],
        ["right/right_modem", "received"],
    ]


def test_a_mesh_is_drawn_where_the_device_is(tmp_path: Path) -> None:
    cube = tmp_path / "modem.obj"
    cube.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n")
    mesh = MeshSpec(path=str(cube), scale_factor=(0.5, 0.5, 0.25))
    scene = scene_in(
        tmp_path, lambda name, mac: modem(name, mac, mesh=mesh, position=(0.0, 2.0, 0.0))
    )
    with open_scene(scene) as simulation:
        scenery = simulation.world.scenery
        part = next(each for each in scenery.parts if each.name == "right/right_modem")
        corners = scenery.corners(part)
    assert corners.min(axis=0) == pytest.approx([1500.0, 2.0, -50.0])
    assert corners.max(axis=0) == pytest.approx([1500.5, 2.5, -49.75])
