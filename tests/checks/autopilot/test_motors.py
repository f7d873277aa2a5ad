"""The comparison of thrusters with ArduSub's matrices finds every single mistake."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from uwsim.autopilots.ardupilot.frames import AXES, FRAMES, Frame, find_frame
from uwsim.checks.autopilot.motors import MIRRORS, Motor, find_differences
from uwsim.errors import BadSetting

HALF = np.sqrt(0.5)
HEAVY = {
    0: Motor(1, "bow_starboard", np.array([0.16, 0.11, 0.09]), np.array([-HALF, HALF, 0.0])),
    1: Motor(2, "bow_port", np.array([0.16, -0.11, 0.09]), np.array([-HALF, -HALF, 0.0])),
    2: Motor(3, "stern_starboard", np.array([-0.16, 0.11, 0.09]), np.array([HALF, HALF, 0.0])),
    3: Motor(4, "stern_port", np.array([-0.16, -0.11, 0.09]), np.array([HALF, -HALF, 0.0])),
    4: Motor(5, "down_bow_starboard", np.array([0.12, 0.22, 0.0]), np.array([0.0, 0.0, 1.0])),
    5: Motor(6, "down_bow_port", np.array([0.12, -0.22, 0.0]), np.array([0.0, 0.0, 1.0])),
    6: Motor(7, "down_stern_starboard", np.array([-0.12, 0.22, 0.0]), np.array([0.0, 0.0, 1.0])),
    7: Motor(8, "down_stern_port", np.array([-0.12, -0.22, 0.0]), np.array([0.0, 0.0, 1.0])),
}
"""A BlueROV2 Heavy, in forward, starboard, down."""
VECTORED_6DOF = find_frame("2")
CONSTRUCTIBLE = [frame for frame in FRAMES if frame.number != 0]
"""Frames of which `ideal_motors` makes thrusters; the roll of bluerov1 comes from its shape."""


def ideal_motors(frame: Frame) -> dict[int, Motor]:
    """Return thrusters with exactly the signs of a frame: the force by the linear factors, and a
    place at which it has the moments."""
    motors = {}
    for index, (roll, pitch, yaw, throttle, forward, lateral) in enumerate(frame.motors):
        direction = np.array([forward, lateral, -throttle], dtype=float)
        direction /= np.linalg.norm(direction, axis=0)
        moment = np.array([roll, pitch, yaw], dtype=float)
        position = np.cross(direction, moment) * 0.2
        assert np.cross(position, direction) == pytest.approx(0.2 * moment)
        motors[index] = Motor(index + 1, f"t{index + 1}", position, direction)
    return motors


@pytest.mark.parametrize("frame", CONSTRUCTIBLE, ids=[f.name for f in CONSTRUCTIBLE])
def test_thrusters_with_the_factors_of_a_frame_agree_with_it(frame: Frame) -> None:
    assert find_differences(ideal_motors(frame), frame) == []


def test_a_bluerov2_heavy_is_a_vectored_6dof_and_no_other_frame_of_8_motors() -> None:
    assert find_differences(HEAVY, VECTORED_6DOF) == []
    assert find_differences(HEAVY, find_frame("vectored_6dof_90"))


@given(scale=st.floats(0.2, 5.0), tilt=st.floats(-0.3, 0.3), index=st.integers(0, 7))
def test_size_and_small_tilts_of_thrusters_do_not_matter(
    scale: float, tilt: float, index: int
) -> None:
    motors = {k: replace(motor, position=scale * motor.position) for k, motor in HEAVY.items()}
    direction = motors[index].direction + tilt * np.array([0.0, 0.0, 1.0])
    motors[index] = replace(motors[index], direction=direction / np.sqrt(np.sum(direction**2)))
    assert find_differences(motors, VECTORED_6DOF) == []


@pytest.mark.parametrize("index", range(8))
def test_each_reversed_thruster_is_found_with_the_parameter_that_mends_it(index: int) -> None:
    motors = {**HEAVY, index: replace(HEAVY[index], direction=-HEAVY[index].direction)}
    (finding,) = find_differences(motors, VECTORED_6DOF)
    assert finding.channels == (index + 1,)
    assert f"thruster {HEAVY[index].thruster!r}, is reversed" in finding.text
    assert f"MOT_{index + 1}_DIRECTION -1" in finding.text


@pytest.mark.parametrize(("first", "second"), list(itertools.combinations(range(8), 2)))
def test_each_exchange_of_two_thrusters_is_found_with_their_functions(
    first: int, second: int
) -> None:
    motors = dict(HEAVY)
    motors[first] = replace(HEAVY[second], channel=first + 1)
    motors[second] = replace(HEAVY[first], channel=second + 1)
    (finding,) = find_differences(motors, VECTORED_6DOF)
    assert set(finding.channels) == {first + 1, second + 1}
    text = finding.text
    assert f"channels {first + 1} and {second + 1} are exchanged" in text
    assert f"SERVO{first + 1}_FUNCTION {33 + second}" in text
    assert f"SERVO{second + 1}_FUNCTION {33 + first}" in text


MISTAKES = [
    (index, cause)
    for index in range(8)
    for cause, (_, direction_signs) in MIRRORS.items()
    if index < 4 or direction_signs == (1, 1, 1)  # a vertical push has no x and y
]


@pytest.mark.parametrize(("index", "cause"), MISTAKES)
def test_each_mirrored_thruster_is_found(index: int, cause: str) -> None:
    position_signs, direction_signs = MIRRORS[cause]
    mirrored = replace(
        HEAVY[index],
        position=HEAVY[index].position * np.array([*position_signs, 1]),
        direction=HEAVY[index].direction * np.array(direction_signs),
    )
    (finding,) = find_differences({**HEAVY, index: mirrored}, VECTORED_6DOF)
    assert finding.channels == (index + 1,)
    assert repr(HEAVY[index].thruster) in finding.text
    if "is mirrored against" in finding.text:
        assert finding.text.endswith(f"Probably {cause}")
    else:  # both signs of the force changed: seen from outside it is reversed
        assert "is reversed" in finding.text


@given(order=st.permutations(range(8)))
def test_any_order_of_the_thrusters_is_recognized(order: list[int]) -> None:
    motors = {k: replace(HEAVY[source], channel=k + 1) for k, source in enumerate(order)}
    findings = find_differences(motors, VECTORED_6DOF)
    named_channels = {channel for finding in findings for channel in finding.channels}
    assert named_channels == {k + 1 for k, source in enumerate(order) if k != source}
    assert not any("mirrored" in finding.text for finding in findings)


def test_missing_and_surplus_thrusters_are_reported() -> None:
    few = {k: motor for k, motor in HEAVY.items() if k != 6}
    (finding,) = find_differences(few, VECTORED_6DOF)
    assert "nothing is at motor 7" in finding.text
    (finding,) = find_differences(HEAVY, find_frame("vectored"))
    assert "does not drive 'down_stern_starboard', 'down_stern_port'" in finding.text


def test_skid_steering_is_checked_with_the_names_of_rover() -> None:
    port = Motor(1, "port", np.array([-0.4, -0.3, 0.1]), np.array([1.0, 0.0, 0.0]))
    starboard = Motor(2, "starboard", np.array([-0.4, 0.3, 0.1]), np.array([1.0, 0.0, 0.0]))
    frame = find_frame("skid_steering")
    assert find_differences({0: port, 1: starboard}, frame) == []
    crossed = {0: replace(starboard, channel=1), 1: replace(port, channel=2)}
    (finding,) = find_differences(crossed, frame)
    assert "SERVO1_FUNCTION 74, SERVO2_FUNCTION 73" in finding.text
    backward = {0: replace(port, direction=-port.direction), 1: starboard}
    (finding,) = find_differences(backward, frame)
    assert "SERVO1_REVERSED 1" in finding.text


def test_factors_are_signs_along_known_axes() -> None:
    for frame in FRAMES:
        for factors in frame.motors:
            assert len(factors) == len(AXES)
            assert any(factors)
    assert [len(frame.motors) for frame in FRAMES] == [6, 6, 8, 8, 3, 5, 5, 3, 2]
    with pytest.raises(BadSetting, match="Did you mean 'vectored_6dof'"):
        find_frame("vectored_6doff")
