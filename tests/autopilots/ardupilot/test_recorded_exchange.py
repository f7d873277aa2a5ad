"""The recorded exchange with a real ArduSub: the same packets get the same answers."""

from __future__ import annotations

import json
import math

import pytest

from tests.support.recorded_exchange import ANSWERS, describe_answers, read_packets, replay
from uwsim.autopilots.ardupilot import read_servo_packet


def test_every_packet_of_a_real_ardusub_is_read() -> None:
    packets = [read_servo_packet(data) for data in read_packets()]
    assert len(packets) == 12800
    assert [packet.frame_count for packet in packets if packet] == list(range(12800))
    assert {packet.frame_rate for packet in packets if packet} == {400}
    armed_outputs = [packet.pwm[:8] for packet in packets[22 * 400 :] if packet]
    assert any(width != 1500 for pwm in armed_outputs for width in pwm)


def test_the_same_packets_get_the_same_answers() -> None:
    """Compare; ``python -m tests.support.recorded_exchange --answers`` after a new physics."""
    expected = json.loads(ANSWERS.read_text())
    answers = describe_answers(replay(read_packets()))
    assert answers["seconds"] == expected["seconds"]
    assert answers["sha256"] == expected["sha256"]


def test_the_recorded_vehicle_holds_its_depth_and_moves_to_starboard() -> None:
    states = [json.loads(text) for text in json.loads(ANSWERS.read_text())["seconds"]]
    depths = [state["position"][2] for state in states[23:]]
    assert max(depths) - min(depths) < 0.1
    north, east, _ = (
        b - a for a, b in zip(states[25]["position"], states[31]["position"], strict=True)
    )
    assert east > 0.4
    assert abs(north) < 0.05
    w, x, y, z = states[31]["quaternion"]
    heading = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    assert heading == pytest.approx(0.0, abs=math.radians(5.0))
