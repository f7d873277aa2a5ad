"""The content of messages: frames, signs, units and masks."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from uwsim.autopilots.mavlink import Codec, Identity, Message, MessageReader, commands
from uwsim.autopilots.mavlink.commands import Sticks, Target
from uwsim.autopilots.mavlink.modes import SURFACE_BOAT, mode_name, mode_number
from uwsim.autopilots.mavlink.navigation import (
    NavigationSample,
    confidence_of,
    distance_sensor,
    odometry,
    rotation_vector,
    vision_position_delta,
)
from uwsim.autopilots.mavlink.status import (
    AutopilotStatus,
    apply_heartbeat,
    describe_result,
    is_autopilot_heartbeat,
    read_text,
    servo_outputs,
)
from uwsim.base.geometry import rotation_from_rpy
from uwsim.errors import BadSetting

TARGET = Target()
CODEC = Codec()
MESSAGES = {
    "arm": commands.arm(TARGET, True, is_forced=True),
    "mode": commands.set_mode(TARGET, 16),
    "interval": commands.set_message_interval(TARGET, 32, 0.1),
    "origin": commands.set_origin(TARGET, latitude=0.7, longitude=-2.0, altitude=1.5),
    "sticks": commands.manual_control(TARGET, Sticks(surge=0.5, roll=-1.0)),
    "local": commands.local_target(TARGET, 1.0, position=(1, 2, 3), velocity=(0, 0, 0), yaw=1.0),
    "global": commands.global_target(TARGET, 1.0, latitude=0.7, longitude=0.1, altitude=-3.0),
    "count": commands.mission_count(TARGET, 4),
    "item": commands.waypoint(TARGET, 1, latitude=0.7, longitude=0.1, altitude=-3.0),
    "range": distance_sensor(2.0, 1.5, minimum=0.3, maximum=50.0, beam_width=0.4),
}


@pytest.mark.parametrize("message", MESSAGES.values(), ids=MESSAGES.keys())
def test_every_message_can_be_sent(message: Message) -> None:
    frame = CODEC.encode(message, Identity(255, 190), 0)
    (read,) = MessageReader(CODEC).read(frame)
    for name, value in message.fields.items():
        assert read.fields[name] == pytest.approx(value)


@given(
    axis=st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: math.hypot(*v) > 0.1),
    angle=st.floats(0, 3.1),
)
def test_a_rotation_vector_is_axis_times_angle(axis: tuple[float, ...], angle: float) -> None:
    unit = np.array(axis) / math.hypot(*axis)
    x, y, z = unit
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    rotation = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    assert rotation_vector(rotation) == pytest.approx(angle * unit, abs=1e-6)


def test_the_velocity_that_ardupilot_computes_of_a_delta_is_that_of_the_ping() -> None:
    velocity = np.array([0.31, -0.12, 0.05])
    message = vision_position_delta(
        12.5, 0.1, velocity=velocity, turn=np.array([0.0, 0.0, 0.02]), confidence=90.0
    )
    (read,) = MessageReader(CODEC).read(CODEC.encode(message, Identity(1, 197), 0))
    interval = read.fields["time_delta_usec"] * 1e-6  # as AP_VisualOdom computes it
    assert np.array(read.fields["position_delta"]) / interval == pytest.approx(velocity, rel=1e-6)
    assert read.fields["angle_delta"][2] / interval == pytest.approx(0.2)
    assert read.fields["time_usec"] == 12_500_000


def test_the_confidence_falls_with_the_error_velocity() -> None:
    assert confidence_of(0.0) == 100.0
    assert confidence_of(-0.1) == pytest.approx(75.0)
    assert confidence_of(3.0) == 0.0
    assert confidence_of(math.nan) == 50.0


def test_odometry_has_the_frames_and_variances_that_ardupilot_reads() -> None:
    sample = NavigationSample(
        time=3.0,
        position=np.array([1.0, 2.0, 3.0]),
        quaternion=(1.0, 0.0, 0.0, 0.0),
        velocity=np.array([0.1, 0.2, 0.3]),
        angular_velocity=np.array([0.01, 0.02, 0.03]),
    )
    fields = odometry(
        sample, position_std=0.1, attitude_std=0.02, velocity_std=0.05, reset_counter=257
    ).fields
    assert (fields["frame_id"], fields["child_frame_id"]) == (20, 12)
    covariance = fields["pose_covariance"]
    assert [covariance[k] for k in (0, 6, 11)] == pytest.approx([0.01] * 3)
    assert [covariance[k] for k in (15, 18, 20)] == pytest.approx([0.0004] * 3)
    assert sum(map(abs, covariance)) == pytest.approx(3 * 0.01 + 3 * 0.0004)
    assert [fields["velocity_covariance"][k] for k in (0, 6, 11)] == pytest.approx([0.0025] * 3)
    assert fields["reset_counter"] == 1


def test_a_distance_without_echo_is_beyond_the_maximum_and_of_the_worst_quality() -> None:
    for distance, centimetres, quality in [(1.234, 123, 100), (math.inf, 5001, 1), (60.0, 5001, 1)]:
        fields = distance_sensor(0, distance, minimum=0.3, maximum=50.0, beam_width=0.4).fields
        assert (fields["current_distance"], fields["signal_quality"]) == (centimetres, quality)
        assert fields["orientation"] == 25  # down


@given(values=st.lists(st.floats(-3, 3), min_size=6, max_size=6))
def test_sticks_are_clipped_and_the_vertical_one_rests_at_500(values: list[float]) -> None:
    surge, sway, heave, yaw, pitch, roll = values
    sticks = Sticks(surge=surge, sway=sway, heave=heave, yaw=yaw, pitch=pitch, roll=roll)
    fields = commands.manual_control(TARGET, sticks).fields
    clipped = [min(1.0, max(-1.0, value)) for value in values]
    assert [fields[n] for n in "xyr"] == [round(1000 * clipped[k]) for k in (0, 1, 3)]
    assert fields["z"] == 500 + round(500 * clipped[2])
    assert (fields["s"], fields["t"]) == (round(400 * clipped[4]), round(400 * clipped[5]))
    assert 0 <= fields["z"] <= 1000


@pytest.mark.parametrize(
    ("position", "velocity", "yaw", "mask"),
    [
        ((1, 2, 3), None, None, 0b110111111000),
        ((1, 2, 3), None, 0.5, 0b100111111000),
        (None, (0.1, 0, 0), None, 0b110111000111),
        ((1, 2, 3), (0.1, 0, 0), 0.5, 0b100111000000),
    ],
)
def test_the_mask_of_a_target_ignores_what_is_not_given(
    position: tuple[float, ...] | None,
    velocity: tuple[float, ...] | None,
    yaw: float | None,
    mask: int,
) -> None:
    message = commands.local_target(TARGET, 1.0, position=position, velocity=velocity, yaw=yaw)
    assert message.fields["type_mask"] == mask


def test_modes_have_the_numbers_of_ardupilot() -> None:
    assert [mode_number(name) for name in ("manual", "STABILIZE", "ALT_HOLD", "POSHOLD")] == [
        *(19, 0, 2, 16)
    ]
    assert mode_number("GUIDED", SURFACE_BOAT) == 15
    assert mode_name(4) == "GUIDED"
    assert mode_name(99) == "MODE 99"
    with pytest.raises(BadSetting, match="Did you mean 'POSHOLD'"):
        mode_number("POSHOLT")


def test_only_heartbeats_of_an_autopilot_change_the_status() -> None:
    status = AutopilotStatus()
    fields = {"type": 12, "autopilot": 3, "base_mode": 0x81, "custom_mode": 16}
    beat = Message("HEARTBEAT", fields, 1, 1)
    assert is_autopilot_heartbeat(beat)
    assert apply_heartbeat(status, beat, 2.0)
    assert not apply_heartbeat(status, beat, 3.0)
    assert (status.mode_name, status.is_armed, status.heartbeat_time) == ("POSHOLD", True, 3.0)
    assert not is_autopilot_heartbeat(Message("HEARTBEAT", {"autopilot": 8}, 255, 190))
    assert not is_autopilot_heartbeat(Message("HEARTBEAT", fields, 1, 100))


def test_a_long_text_arrives_in_pieces() -> None:
    status = AutopilotStatus()

    def piece(text: str, number: int, k: int) -> str | None:
        fields = {"severity": 4, "text": text, "id": number, "chunk_seq": k}
        return read_text(status, Message("STATUSTEXT", fields))

    assert piece("EKF3 IMU0 is using optical flow", 0, 0) == (
        "warning: EKF3 IMU0 is using optical flow"
    )
    assert piece("a" * 50, 1, 0) is None
    assert piece("bc", 1, 1) == "warning: " + "a" * 50 + "bc"
    assert piece("d" * 50, 2, 0) is None
    assert piece("e", 3, 0) == "warning: e"  # the rest of text 2 is lost
    for k in range(20):
        piece("f" * 50, 4, k)
    assert len(status.text) <= 500


def test_servo_outputs_and_results_are_read() -> None:
    message = Message("SERVO_OUTPUT_RAW", {"servo1_raw": 1500, "servo8_raw": 1900})
    assert servo_outputs(message)[:8] == (1500, 0, 0, 0, 0, 0, 0, 1900)
    assert describe_result(Message("COMMAND_ACK", {"result": 4})) == "failed"
    assert describe_result(Message("COMMAND_ACK", {"result": 77})) == "result 77"


def test_a_turn_of_the_bow_to_starboard_is_positive() -> None:
    turn = rotation_from_rpy(0, 0, 0.2).T @ rotation_from_rpy(0, 0, 0.3)
    assert rotation_vector(turn) == pytest.approx([0.0, 0.0, 0.1])
