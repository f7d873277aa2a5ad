"""Sensors of a simulation as bytes: their values, their times, and the delay of a line."""

from __future__ import annotations

import math
import os
import socket
from pathlib import Path

import pytest

from tests.devices.streams.stream_scenes import instrument, open_streams, record_bytes
from uwsim.autopilots.instruments.attitude import read_attitude
from uwsim.autopilots.instruments.depth import read_bottom_distance, read_depth
from uwsim.autopilots.instruments.dvpdl import read_dvpdl
from uwsim.autopilots.instruments.rdi_pd4 import read_pd4
from uwsim.autopilots.instruments.rdi_pd6 import read_pd6_line
from uwsim.autopilots.instruments.satellite import Position
from uwsim.autopilots.instruments.usbl import read_beacon_position
from uwsim.autopilots.instruments.water_linked import read_velocity_report
from uwsim.devices.streams.instrument_stream import InstrumentStream
from uwsim.errors import SceneError
from uwsim.simulation import Simulation


def streams_of(simulation: Simulation) -> list[InstrumentStream]:
    return [d for d in simulation.world.devices if isinstance(d, InstrumentStream)]


def test_a_gps_states_the_place_and_the_time_of_the_simulation(tmp_path: Path) -> None:
    stream = instrument("GGA RMC", "/gps", more="<epoch>2026-07-01T23:59:59.5+02:00</epoch>")
    with open_streams(tmp_path, stream, depth=0.1) as simulation:
        messages = record_bytes(simulation)
        simulation.advance(0.3)
    assert [time for time, _ in messages] == [0.0, 0.25]
    gga, rmc, end = messages[1][1].split(b"\r\n")
    assert end == b""
    position = Position.from_bytes(gga)
    assert position.time_of_day_us == 79_199_750_000  # 21:59:59.750 UTC
    assert position.latitude - 41.9616 == pytest.approx(2.0 / 111_000.0, rel=0.01)
    assert position.longitude - 2.8353 == pytest.approx(-1.0 / 82_900.0, rel=0.01)
    assert rmc.split(b",")[9] == b"010726"


def test_a_gps_under_water_has_no_fix(tmp_path: Path) -> None:
    with open_streams(tmp_path, instrument("GGA", "/gps"), depth=1.5) as simulation:
        messages = record_bytes(simulation)
        simulation.advance(0.0)
    assert messages[0][1].startswith(b"$GPGGA,000000.000,,,,,0,00,")


def test_an_attitude_is_that_of_the_imu_in_north_east_down(tmp_path: Path) -> None:
    with open_streams(tmp_path, instrument("HDT PRDID PASHR", "/imu")) as simulation:
        messages = record_bytes(simulation)
        simulation.advance(0.0)
    hdt, prdid, pashr = map(read_attitude, messages[0][1].splitlines())
    assert hdt.heading == pytest.approx(math.degrees(0.5), abs=3.0)
    for attitude in (prdid, pashr):
        assert attitude.heading == pytest.approx(hdt.heading, abs=0.006)
        assert abs(attitude.roll) < 3.0
        assert abs(attitude.pitch) < 3.0


def test_depth_and_altitude_are_those_of_the_sensors(tmp_path: Path) -> None:
    streams = instrument("ISDPT", "/depth") + instrument(
        "DBT DPT", "/altitude", name="altimeter", bytes_topic="altimeter"
    )
    with open_streams(tmp_path, streams) as simulation:
        depths, altitudes = record_bytes(simulation), record_bytes(simulation, "altimeter")
        simulation.advance(0.0)
    assert read_depth(depths[0][1]).depth == pytest.approx(1.5, abs=1e-3)
    dbt, dpt = map(read_bottom_distance, altitudes[0][1].splitlines())
    assert dbt.distance == dpt.distance == pytest.approx(4.0 - 1.5 - 0.3, abs=0.1)


def test_a_dvl_sends_its_velocity_in_all_formats(tmp_path: Path) -> None:
    streams = "".join(
        instrument(name, "/dvl", name=name, bytes_topic=name.lower())
        for name in ("PD4", "PD4EARTH", "PD6", "WRZ", "DVPDL")
    )
    with open_streams(tmp_path, streams) as simulation:
        autopilot = simulation.world.vehicles.find("rov").autopilot
        assert autopilot is not None
        recorded = {
            name: record_bytes(simulation, name)
            for name in ("pd4", "pd4earth", "pd6", "wrz", "dvpdl")
        }
        autopilot.set_twist((0.4, 0.0, 0.0), (0.0, 0.0, 0.0))
        simulation.advance(5.0)
        forward, starboard, down = simulation.world.vehicles.find("rov").velocity[:3].tolist()
        heading = 0.5
    assert forward > 0.3
    ship, earth = read_pd4(recorded["pd4"][-1][1]), read_pd4(recorded["pd4earth"][-1][1])
    assert ship.velocity == pytest.approx((starboard, forward, -down), abs=0.03)
    assert earth.velocity[:2] == pytest.approx(
        (forward * math.sin(heading), forward * math.cos(heading)), abs=0.05
    )
    assert ship.ranges == pytest.approx((2.5, 2.5, 2.5, 2.5), abs=0.1)
    lines = {line.name: line for line in map(read_pd6_line, recorded["pd6"][-1][1].splitlines())}
    assert lines["BS"].values == pytest.approx(ship.velocity, abs=1e-9)
    report = read_velocity_report(recorded["wrz"][-1][1])
    assert report.velocity == pytest.approx((forward, starboard, down), abs=0.03)
    assert report.interval_ms == 100.0
    assert len(recorded["dvpdl"]) == len(recorded["pd4"]) - 1  # nothing before the first interval
    motion = read_dvpdl(recorded["dvpdl"][-1][1])
    assert motion.interval_us == 100_000
    assert motion.position_delta[0] == pytest.approx(0.1 * forward, abs=2e-3)


def test_positions_by_acoustics_have_the_stated_noise(tmp_path: Path) -> None:
    more = "<rate>50</rate> <std>0.25</std> <transceiver> <x>1</x> <y>0</y> <z>0</z> </transceiver>"
    stream = instrument("PSONLLD PSIMSSB", name="B7", more=more)
    with open_streams(tmp_path, stream) as simulation:
        messages = record_bytes(simulation)
        simulation.advance(8.0)
    lines = [data.splitlines() for _, data in messages]
    sonardyne = [read_beacon_position(first) for first, _ in lines]
    kongsberg = [read_beacon_position(second) for _, second in lines]
    assert len(lines) == 401
    assert {b.beacon for b in (*sonardyne, *kongsberg)} == {"B7"}
    assert sum(b.forward for b in kongsberg) / 401 == pytest.approx(1.0, abs=0.1)
    assert sum(b.starboard for b in kongsberg) / 401 == pytest.approx(-1.0, abs=0.1)
    mean_depth = sum(b.depth for b in kongsberg) / 401
    variance = sum((b.depth - mean_depth) ** 2 for b in kongsberg) / 400
    assert math.sqrt(variance) == pytest.approx(0.25, rel=0.12)
    latitude = sum(b.latitude for b in sonardyne) / 401
    assert (latitude - 41.9616) * 111_070.0 == pytest.approx(2.0, abs=0.1)


def test_two_runs_send_the_same_bytes_and_another_seed_other_bytes(tmp_path: Path) -> None:
    streams = instrument("PD6 PD4", "/dvl") + instrument(
        "PSONLLD", name="B7", bytes_topic="usbl", more="<std>0.3</std>"
    )

    def run(seed: int) -> list[tuple[float, bytes]]:
        with open_streams(tmp_path, streams, seed=seed) as simulation:
            dvl, usbl = record_bytes(simulation), record_bytes(simulation, "usbl")
            simulation.advance(2.0)
        return dvl + usbl

    assert run(1) == run(1)
    assert run(1) != run(2)


def test_a_line_delays_a_message_by_its_bits(tmp_path: Path) -> None:
    stream = instrument("PD4", "/dvl", more="<bitRate>9600</bitRate>")
    with open_streams(tmp_path, stream) as simulation:
        messages = record_bytes(simulation)
        simulation.advance(0.5)
    first = 47 * 10 / 9600  # 49 ms
    assert messages[0][0] == pytest.approx(first, abs=0.004)
    assert [time for time, _ in messages] == pytest.approx(
        [first + 0.1 * i for i in range(5)], abs=0.004
    )


def test_a_line_that_is_too_slow_loses_whole_messages_and_counts_them(tmp_path: Path) -> None:
    more = "<bitRate>2400</bitRate> <buffer>100</buffer>"
    with open_streams(tmp_path, instrument("PD4", "/dvl", more=more)) as simulation:
        messages = record_bytes(simulation)
        simulation.advance(2.0)
        line = streams_of(simulation)[0].state.line
    assert all(len(data) == 47 for _, data in messages)
    assert len(messages) == 10  # 47 bytes take 0.196 s, measurements come every 0.1 s
    assert line.n_lost == 21 - len(messages) - len(line.queue)


def test_a_saved_stream_continues_with_the_same_bytes(tmp_path: Path) -> None:
    stream = instrument("PD4 DVPDL", "/dvl", more="<bitRate>9600</bitRate>")
    with open_streams(tmp_path, stream) as simulation:
        messages = record_bytes(simulation)
        simulation.advance(0.33)
        saved, n_before = simulation.save(), len(messages)
        simulation.advance(0.5)
        expected = messages[n_before:]
        simulation.restore(saved)
        del messages[:]
        simulation.advance(0.5)
    assert messages == expected


def test_the_bytes_arrive_by_udp_and_on_a_terminal(tmp_path: Path) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.bind(("127.0.0.1", 0))
        receiver.settimeout(5.0)
        port = receiver.getsockname()[1]
        streams = instrument(
            "PD4", "/dvl", more=f"<address>udpout:127.0.0.1:{port}</address>"
        ) + instrument(
            "ISDPT", "/depth", name="depth", bytes_topic="", more="<address>pty</address>"
        )
        with open_streams(tmp_path, streams, udp_address="127.0.0.1") as simulation:
            messages = record_bytes(simulation)
            description = streams_of(simulation)[1].description
            terminal = os.open(description.split()[3], os.O_RDWR | os.O_NOCTTY)
            simulation.advance(0.2)
            assert [receiver.recv(100) for _ in messages] == [data for _, data in messages]
            assert read_depth(os.read(terminal, 100)).depth == pytest.approx(1.5, abs=1e-3)
            os.close(terminal)


def test_without_connections_no_port_is_opened(tmp_path: Path) -> None:
    stream = instrument("PD4", "/dvl", more="<address>serial:/dev/no_such:9600</address>")
    with open_streams(tmp_path, stream) as simulation:
        messages = record_bytes(simulation)
        simulation.advance(0.0)
    assert len(messages) == 1


@pytest.mark.parametrize(
    ("stream", "problem"),
    [
        (instrument("PD5", "/dvl"), "Did you mean 'PD6'"),
        (instrument("PD4 GGA", "/dvl"), "expected formats of one sensor"),
        (instrument("PD4"), "<topic> is missing; expected the topic of a DVL"),
        (instrument("PSONLLD", "/dvl"), "expected none"),
        (instrument("PD4", "/dvl", more="<epoch>noon</epoch>"), "expected one such as 2026"),
        (instrument("PD4", "/dvl", more="<address>upd:h:1</address>"), "its kind is 'upd'"),
        (instrument("PD4 " * 9, "/dvl"), "expected 1 to 8"),
    ],
)
def test_an_invalid_stream_is_an_error_with_its_line(
    tmp_path: Path, stream: str, problem: str
) -> None:
    with pytest.raises(SceneError, match=problem) as error:
        open_streams(tmp_path, stream)
    assert "scene.xml:17" in str(error.value)
