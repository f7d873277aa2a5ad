"""The sentences that uwsim writes, read by a parser of others (pynmea2)."""

from __future__ import annotations

from datetime import date, time
from typing import Any

import pytest

from uwsim.autopilots.instruments.attitude import Attitude
from uwsim.autopilots.instruments.depth import BottomDistance
from uwsim.autopilots.instruments.satellite import Fix
from uwsim.autopilots.instruments.sentence import Sentence
from uwsim.autopilots.instruments.utc import parse_epoch

NMEA = pytest.importorskip("pynmea2", reason="pynmea2 is not installed: pip install pynmea2")
FIX = Fix(
    time_us=parse_epoch("2026-03-04T05:06:07Z") + 250_000,
    latitude=-41.9616,
    longitude=2.8353,
    altitude=12.5,
    speed=1.5,
    course=123.4,
)
ATTITUDE = Attitude(time_us=FIX.time_us, roll=2.12, pitch=-4.44, heading=154.25)


def parse(sentence: Sentence) -> Any:
    """Return the sentence as the other parser reads it, with its checksum."""
    return NMEA.parse(sentence.to_bytes().decode(), check=True)


def test_a_fix_has_its_position_and_time() -> None:
    message = parse(FIX.gga())
    assert message.sentence_type == "GGA"
    assert message.is_valid
    assert message.latitude == pytest.approx(FIX.latitude, abs=1e-6)
    assert message.longitude == pytest.approx(FIX.longitude, abs=1e-6)
    assert message.altitude == pytest.approx(FIX.altitude)
    assert message.timestamp.replace(tzinfo=None) == time(5, 6, 7, 250_000)


def test_a_minimum_fix_has_its_date_speed_and_course() -> None:
    message = parse(FIX.rmc())
    assert (message.sentence_type, message.status) == ("RMC", "A")
    assert message.datestamp == date(2026, 3, 4)
    assert message.timestamp.replace(tzinfo=None) == time(5, 6, 7, 250_000)
    assert message.latitude == pytest.approx(FIX.latitude, abs=1e-6)
    assert message.spd_over_grnd == pytest.approx(1.5 / 0.514444, abs=0.01)
    assert message.true_course == pytest.approx(123.4, abs=0.05)


def test_course_and_speed_are_in_their_units() -> None:
    message = parse(FIX.vtg())
    assert message.true_track == pytest.approx(123.4, abs=0.05)
    assert float(message.spd_over_grnd_kts) == pytest.approx(1.5 / 0.514444, abs=0.01)
    assert float(message.spd_over_grnd_kmph) == pytest.approx(5.4, abs=0.01)


def test_the_kind_of_fix_is_read() -> None:
    message = parse(FIX.gsa())
    assert (message.sentence_type, message.mode_fix_type) == ("GSA", "3")


def test_date_and_time_are_read() -> None:
    message = parse(FIX.zda())
    assert (message.day, message.month, message.year) == (4, 3, 2026)
    assert message.timestamp.replace(tzinfo=None) == time(5, 6, 7, 250_000)


def test_a_fix_that_is_not_valid_is_read_as_such() -> None:
    fix = Fix(time_us=FIX.time_us)
    assert not parse(fix.gga()).is_valid
    assert parse(fix.rmc()).status == "V"


def test_attitudes_are_read() -> None:
    assert float(parse(ATTITUDE.hdt()).heading) == pytest.approx(154.25, abs=0.05)
    rdi = parse(ATTITUDE.prdid())
    assert (rdi.pitch, rdi.roll, rdi.heading) == (-4.44, 2.12, 154.25)
    oxts = parse(ATTITUDE.pashr())
    assert (oxts.true_heading, oxts.is_true_heading) == (154.25, "T")
    assert (oxts.roll, oxts.pitch) == (2.12, -4.44)


def test_distances_to_the_bottom_are_in_their_units() -> None:
    below = parse(BottomDistance(distance=2.3).dbt())
    assert float(below.depth_meters) == pytest.approx(2.3)
    assert float(below.depth_feet) == pytest.approx(2.3 / 0.3048, abs=0.05)
    assert float(below.depth_fathoms) == pytest.approx(2.3 / 1.8288, abs=0.05)
    assert float(parse(BottomDistance(distance=2.3).dpt()).depth) == pytest.approx(2.3)
