"""Bytes that manufacturers and standards publish as examples, with their checksums."""

from __future__ import annotations

import math

import pytest

from uwsim.autopilots.instruments import checksums
from uwsim.autopilots.instruments.attitude import Attitude, read_attitude
from uwsim.autopilots.instruments.depth import DepthReading, read_bottom_distance, read_depth
from uwsim.autopilots.instruments.dvpdl import read_dvpdl
from uwsim.autopilots.instruments.satellite import KNOT, Position
from uwsim.autopilots.instruments.sentence import Sentence, read_sentence
from uwsim.autopilots.instruments.usbl import read_beacon_position
from uwsim.autopilots.instruments.water_linked import (
    TransducerReport,
    frame_report,
    read_transducer_report,
    read_velocity_report,
)
from uwsim.errors import BadMessage

SENTENCES = [
    "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47",
    "$GPRMC,123519,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W*6A",
    "$GPZDA,201530.00,04,07,2002,00,00*60",
    "$GPVTG,054.7,T,034.4,M,005.5,N,010.2,K*48",
    "$GPGSA,A,3,04,05,,09,12,,,24,,,,,2.5,1.3,2.1*39",
    "$PRDID,-4.44,2.12,154.25*56",
    "$ISDPT,-000.485,M,000.9689,B,30.81,C*28",
    "$PASHR,085335.000,224.19,T,-01.26,+00.83,+00.00,0.101,0.113,0.267,1,0*06",
    "$PSONLLD,170004.53,ALVIN 914,A,28.8114807,-87.80925696,1951.156,13.96,13.96,0.00,2.62,,,,*6F",
    "$PSIMSSB,180554.432,M44,A,,C,N,M,-61.300,39.017,34.026,0.072,T,0.050576,*47",
    "$SDDBT,7.7,f,2.3,M,1.3,F*05",
    "$INDPT,2.3,0.0*46",
]
REPORTS = [
    "wrz,0.120,-0.400,2.000,y,1.30,1.855,1e-07;0;1.4;0;1.2;0;0.2;0;1e+09,7,14,123.00,1*50",
    "wru,0,0.070,1.10,-40,-95*9c",
    "wru,1,-0.500,1.25,-62,-104*f0",
    "wrx,112.83,0.007,0.017,0.006,0.000,0.93,y,0*d2",
    "wrp,49056.809,0.41,0.15,1.23,0.4,53.9,13.0,19.3,0*de",
    "wrc,1480,20,n,y*59",
]


@pytest.mark.parametrize("line", SENTENCES)
def test_a_published_sentence_is_read_and_written_with_the_same_bytes(line: str) -> None:
    sentence = read_sentence(line.encode() + b"\r\n")
    assert sentence.to_bytes() == line.encode() + b"\r\n"


@pytest.mark.parametrize("line", REPORTS)
def test_a_published_report_of_water_linked_has_our_checksum(line: str) -> None:
    assert frame_report(line.rpartition("*")[0]) == line.encode() + b"\r\n"


def test_checksums_have_their_catalogued_check_values() -> None:
    assert checksums.crc8(b"123456789") == 0xF4
    assert checksums.crc16(b"123456789") == 0x29B1


def test_a_position_of_a_published_gga_sentence() -> None:
    position = Position.from_bytes(SENTENCES[0].encode())
    assert position.is_valid
    assert position.latitude == pytest.approx(48.0 + 7.038 / 60.0)
    assert position.longitude == pytest.approx(11.0 + 31.0 / 60.0)
    assert position.altitude == 545.4
    assert position.time_of_day_us == ((12 * 60 + 35) * 60 + 19) * 1_000_000


def test_a_speed_of_a_published_rmc_sentence() -> None:
    position = Position.from_bytes(SENTENCES[1].encode())
    assert position.speed == pytest.approx(22.4 * KNOT)
    assert position.course == 84.4


def test_an_attitude_of_published_sentences() -> None:
    assert read_attitude(SENTENCES[5].encode()) == Attitude(pitch=-4.44, roll=2.12, heading=154.25)
    assert Attitude(pitch=-4.44, roll=2.12, heading=154.25).prdid().to_bytes() == (
        SENTENCES[5].encode() + b"\r\n"
    )
    pashr = read_attitude(SENTENCES[7].encode())
    assert (pashr.heading, pashr.roll, pashr.pitch) == (224.19, -1.26, 0.83)


def test_a_depth_of_a_published_sentence_is_written_with_the_same_bytes() -> None:
    reading = read_depth(SENTENCES[6].encode())
    assert reading.depth == -0.485
    assert reading.pressure == pytest.approx(96890.0)
    assert reading.isdpt().to_bytes() == SENTENCES[6].encode() + b"\r\n"
    assert DepthReading(depth=12.0).isdpt() == Sentence("ISDPT", ("012.000", "M", "", "B", "", "C"))


def test_distances_to_the_bottom_of_published_sentences() -> None:
    assert read_bottom_distance(SENTENCES[10].encode()).distance == 2.3
    assert read_bottom_distance(SENTENCES[11].encode()).distance == 2.3


def test_positions_of_beacons_in_published_sentences() -> None:
    sonardyne = read_beacon_position(SENTENCES[8].encode())
    assert (sonardyne.beacon, sonardyne.latitude, sonardyne.longitude) == (
        *("ALVIN 914", 28.8114807, -87.80925696),
    )
    assert (sonardyne.depth, sonardyne.error) == (1951.156, 13.96)
    kongsberg = read_beacon_position(SENTENCES[9].encode())
    assert (kongsberg.starboard, kongsberg.forward, kongsberg.depth) == (-61.3, 39.017, 34.026)


def test_motion_of_a_published_dvpdl_sentence() -> None:
    published = "$DVPDL,101234000,50000,0.001263,-0.019663,-0.745226,-0.000,0.001,-0.005,100*22"
    with pytest.raises(BadMessage, match=r"expected \*6E"):  # the checksum on the page is wrong
        read_dvpdl(published.encode())
    motion = read_dvpdl(published.replace("*22", "*6E").encode())
    assert (motion.time_us, motion.interval_us, motion.confidence) == (101234000, 50000, 100)
    assert motion.position_delta == (0.0, 0.001, -0.005)
    assert motion.angle_delta == (0.001263, -0.019663, -0.745226)


def test_reports_of_water_linked_are_read() -> None:
    report = read_velocity_report(REPORTS[0].encode())
    assert report.velocity == (0.12, -0.4, 2.0)
    assert (report.altitude, report.time_us, report.sent_us) == (1.3, 7, 14)
    assert report.covariance[8] == 1e9
    transducer = read_transducer_report(REPORTS[1].encode())
    assert transducer == TransducerReport(
        transducer=0, velocity=0.07, distance=1.1, signal_level=-40.0, noise_level=-95.0
    )
    assert transducer.to_bytes() == REPORTS[1].encode() + b"\r\n"
    assert math.isnan(
        read_velocity_report(
            frame_report("wrz,0.000,0.000,0.000,n,-1.00,2.707,0;0;0;0;0;0;0;0;0,1,2,3.00,0")
        ).altitude
    )
