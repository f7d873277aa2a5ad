"""Answers survive the search for keys by which ArduPilot reads them, if they are finite."""

from __future__ import annotations

import json
import math
import struct
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.support.ardupilot_stub import read_answer
from uwsim.autopilots.ardupilot import Answer, encode_answer
from uwsim.errors import UwsimError

AT_REST = Answer(
    timestamp=1.5,
    gyro=(0.0, 0.0, 0.0),
    specific_force=(0.0, 0.0, -9.81),
    position=(1.0, 2.0, 3.0),
    quaternion=(1.0, 0.0, 0.0, 0.0),
    velocity=(0.1, 0.2, 0.3),
)
NUMBERS = st.floats(min_value=-1e37, max_value=1e37)
VECTORS = st.tuples(NUMBERS, NUMBERS, NUMBERS)


def test_the_bytes_are_those_of_the_documentation() -> None:
    assert encode_answer(AT_REST) == (
        b'\n{"timestamp":1.5,"imu":{"gyro":[0.0,0.0,0.0],"accel_body":[0.0,0.0,-9.81]},'
        b'"position":[1.0,2.0,3.0],"quaternion":[1.0,0.0,0.0,0.0],"velocity":[0.1,0.2,0.3]}\n'
    )


@given(
    st.builds(
        Answer,
        timestamp=NUMBERS,
        gyro=VECTORS,
        specific_force=VECTORS,
        position=VECTORS,
        quaternion=st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS),
        velocity=VECTORS,
        is_geodetic=st.booleans(),
        ranges=st.lists(st.none() | NUMBERS, max_size=6),
        battery=st.none() | st.tuples(NUMBERS, NUMBERS),
        wind=st.none() | VECTORS,
    )
)
def test_every_finite_number_is_read_back_to_the_bit(answer: Answer) -> None:
    data = encode_answer(answer)
    json.loads(data)  # it is JSON as well
    state = read_answer(b"rest of an older answer" + data)
    assert state is not None
    expected = {
        "timestamp": (answer.timestamp,),
        "imu.gyro": answer.gyro,
        "imu.accel_body": answer.specific_force,
        "quaternion": answer.quaternion,
        "velocity": answer.velocity,
    }
    if answer.is_geodetic:
        expected |= dict(
            zip(("latitude", "longitude", "altitude"), ((x,) for x in answer.position), strict=True)
        )
    else:
        expected["position"] = answer.position
    for i, distance in enumerate(answer.ranges, start=1):
        if distance is not None:
            expected[f"rng_{i}"] = (distance,)
    if answer.battery is not None:
        expected["battery.voltage"], expected["battery.current"] = (
            (answer.battery[0],),
            (answer.battery[1],),
        )
    if answer.wind is not None:
        expected["velocity_wind"] = answer.wind
    assert {key: bits(value) for key, value in state.items()} == {
        key: bits(value) for key, value in expected.items()
    }


def bits(numbers: object) -> bytes:
    values = list(numbers)  # type: ignore[call-overload]
    return struct.pack(f"{len(values)}d", *values)


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, 1e39])
@pytest.mark.parametrize("name", ["gyro", "specific_force", "position", "velocity"])
def test_a_number_that_is_not_finite_is_not_sent(name: str, bad: float) -> None:
    with pytest.raises(UwsimError, match=f"The {name} .* cannot be sent to ArduPilot"):
        encode_answer(replace(AT_REST, **{name: (0.0, bad, 0.0)}))


def test_a_time_that_is_not_finite_is_not_sent() -> None:
    with pytest.raises(UwsimError, match="The timestamp"):
        encode_answer(replace(AT_REST, timestamp=math.nan))


def test_a_rangefinder_without_an_echo_is_left_out() -> None:
    state = read_answer(encode_answer(replace(AT_REST, ranges=(None, math.inf, 2.5))))
    assert state is not None
    assert [key for key in state if key.startswith("rng")] == ["rng_3"]


@pytest.mark.parametrize("key", [b"timestamp", b"imu", b"gyro", b"velocity", b"position"])
def test_the_reader_of_the_tests_misses_a_required_key(key: bytes) -> None:
    assert read_answer(encode_answer(AT_REST).replace(key, b"other")) is None
