"""The layouts of PD4 and PD6 against the manual's, and closed round trips."""

from __future__ import annotations

import math
import struct

import pytest

from uwsim.autopilots.instruments.dvl import DvlPing
from uwsim.autopilots.instruments.rdi_pd4 import LENGTH, read_pd4, write_pd4
from uwsim.autopilots.instruments.rdi_pd6 import read_pd6_line, write_pd6
from uwsim.autopilots.instruments.utc import parse_epoch
from uwsim.autopilots.instruments.water_linked import VelocityReport, read_velocity_report
from uwsim.errors import BadMessage

TIME = parse_epoch("2026-03-04T05:06:07.890Z")
PING = DvlPing(
    time_us=TIME,
    velocity=(1.25, -0.5, 0.25),
    error_velocity=0.003,
    earth_velocity=(0.1, 0.2, -0.3),
    water_velocity=(1.0, 0.0, -0.125),
    water_error_velocity=-0.001,
    water_earth_velocity=(0.4, 0.5, 0.6),
    distance_made_good=(10.0, -20.5, 0.25),
    altitude=12.34,
    water_layer=2.0,
    vertical_ranges=(12.3, 12.4, math.nan, 12.5),
    roll=-1.5,
    pitch=2.25,
    heading=359.996,
    depth=30.5,
    sound_speed=1501.4,
    salinity=35.0,
    temperature=-1.25,
)


def test_each_byte_of_pd4_is_where_the_manual_has_it() -> None:
    data = write_pd4(PING)
    assert len(data) == LENGTH == 47
    assert data[:4] == bytes((0x7D, 0, 45, 0))
    assert data[4] == 0b10110011  # ship axes, tilts, three beams, 600 kHz
    assert struct.unpack_from("<4h", data, 5) == (-500, 1250, -250, 3)  # starboard, forward, up
    assert struct.unpack_from("<4H", data, 13) == (1230, 1240, 0, 1250)  # [cm]
    assert data[21] == 0b00110000  # no echo in beam 3
    assert struct.unpack_from("<4h", data, 22) == (0, 1000, 125, -1)
    assert struct.unpack_from("<2H", data, 30) == (20, 20)  # [dm]
    assert data[34] == 0
    assert tuple(data[35:39]) == (5, 6, 7, 89)
    assert struct.unpack_from("<HHh", data, 39) == (0, 1501, -125)
    assert struct.unpack_from("<H", data, 45)[0] == sum(data[:45]) % 65536


def test_earth_axes_of_pd4_are_east_north_up() -> None:
    data = write_pd4(PING, "earth")
    assert data[4] >> 6 == 0b11
    assert read_pd4(data).velocity == (0.1, 0.2, -0.3)


def test_pd4_without_bottom_lock_has_bad_velocities() -> None:
    data = write_pd4(DvlPing(time_us=TIME))
    assert struct.unpack_from("<4h", data, 5) == (-32768,) * 4
    assert data[21] == 0xFF
    fields = read_pd4(data)
    assert all(map(math.isnan, (*fields.velocity, *fields.ranges, *fields.water_velocity)))


def test_a_fast_vehicle_does_not_overflow_pd4() -> None:
    fields = read_pd4(write_pd4(DvlPing(time_us=TIME, velocity=(100.0, -10.0, 0.0))))
    assert fields.velocity[1:] == (32.767, 0.0)


@pytest.mark.parametrize("position", range(47))
def test_a_changed_byte_of_pd4_is_found(position: int) -> None:
    data = bytearray(write_pd4(PING))
    data[position] ^= 0x10
    with pytest.raises(BadMessage):
        read_pd4(bytes(data))


def test_the_lines_of_pd6_have_the_widths_of_the_manual() -> None:
    assert write_pd6(PING).split(b"\r\n") == [
        b":SA,+02.25,-01.50,000.00",
        b":TS,26030405060789,35.0,-01.2,0030.5,1501.4,000",
        b":WI,+00000,+01000,+00125,-00001,A",
        b":WS,+00000,+01000,+00125,A",
        b":WE,+00400,+00500,+00600,A",
        b":WD,+00000000.00,+00000000.00,+00000000.00,0002.00,000.00",
        b":BI,-00500,+01250,-00250,+00003,A",
        b":BS,-00500,+01250,-00250,A",
        b":BE,+00100,+00200,-00300,A",
        b":BD,+00000010.00,-00000020.50,+00000000.25,0012.34,000.00",
        b"",
    ]


def test_lines_of_pd6_are_read() -> None:
    lines = {line.name: line for line in map(read_pd6_line, write_pd6(PING).splitlines())}
    assert lines["BI"].values == (-0.5, 1.25, -0.25, 0.003)
    assert lines["BD"].values == (10.0, -20.5, 0.25, 12.34, 0.0)
    assert lines["SA"].values == (2.25, -1.5, 0.0)
    bad = {
        line.name: line for line in map(read_pd6_line, write_pd6(DvlPing(time_us=0)).splitlines())
    }
    assert not bad["BS"].is_good
    assert all(map(math.isnan, bad["BS"].values))


@pytest.mark.parametrize(
    "line", [b"", b"BI,1,2,3,4,A", b":BX,1,2,3,A", b":BS,1,2,A", b":BS,1,2,x,A", b":BS,1,2,3,Q"]
)
def test_wrong_lines_of_pd6_are_errors(line: bytes) -> None:
    with pytest.raises(BadMessage):
        read_pd6_line(line)


def test_a_velocity_report_is_read_as_written() -> None:
    report = VelocityReport(
        velocity=(0.5, -0.25, 0.125),
        altitude=3.25,
        figure_of_merit=0.002,
        time_us=TIME,
        sent_us=TIME,
        interval_ms=125.0,
        covariance=(1e-6, 0.0, 0.0, 0.0, 1e-6, 0.0, 0.0, 0.0, 4e-6),
    )
    assert read_velocity_report(report.to_bytes()) == report
