"""Tests of the HIL messages of PX4 against pymavlink, which others have written."""

from __future__ import annotations

import math
import random
import struct

import pytest

from uwsim.autopilots.px4 import (
    RECEIVED_FORMATS,
    FrameReader,
    Odometry,
    SatelliteFix,
    SensorReadings,
    TrueState,
    decode_actuator_controls,
    encode_frame,
)

dialect = pytest.importorskip("pymavlink.dialects.v20.common")

READINGS = SensorReadings(
    time_usec=4_000_000,
    specific_force=(0.1, -0.2, -9.81),
    angular_velocity=(0.01, 0.02, -0.03),
    magnetic_field=(2.4e-5, 1e-6, 4e-5),
    pressure=101343.0,
    altitude=-1.5,
    temperature=15.0,
)


def frame_of(message, sequence=0):
    return encode_frame(
        message.message,
        message.payload(),
        crc_extra=message.crc_extra,
        sequence=sequence,
        system=1,
        component=200,
    )


def parse(data):
    """Return the message that pymavlink reads; it raises an error if the checksum is wrong."""
    link = dialect.MAVLink(None)
    (message,) = link.parse_buffer(data)
    return message


def controls_frame(time_usec=4000, *, controls=(0.5,) * 16, flags=1, mode=129, version=2):
    """Return the bytes of HIL_ACTUATOR_CONTROLS that pymavlink writes."""
    link = dialect.MAVLink(None, srcSystem=1, srcComponent=1)
    message = dialect.MAVLink_hil_actuator_controls_message(time_usec, list(controls), mode, flags)
    return message.pack(link, force_mavlink1=version == 1)


def test_pymavlink_reads_the_sensors_in_the_units_of_the_message():
    message = parse(frame_of(READINGS))
    assert message.get_type() == "HIL_SENSOR"
    assert message.time_usec == 4_000_000
    assert message.zacc == pytest.approx(-9.81)
    assert message.zgyro == pytest.approx(-0.03)
    assert message.xmag == pytest.approx(0.24)  # gauss
    assert message.abs_pressure == pytest.approx(1013.43)  # hPa
    assert message.pressure_alt == pytest.approx(-1.5)
    assert message.temperature == pytest.approx(15.0)
    assert message.id == 0


def test_px4_takes_all_sensors_but_differential_pressure_as_updated():
    fields = parse(frame_of(READINGS)).fields_updated
    for bits in (0b111, 0b111000, 0b111000000, 0b1101000000000):  # masks of simulator_mavlink
        assert fields & bits == bits
    assert fields & 1 << 10 == 0


def test_pymavlink_reads_position_and_velocity_of_the_satellite_receiver():
    fix = SatelliteFix(
        time_usec=5,
        latitude=math.radians(41.9616),
        longitude=math.radians(-2.8353),
        altitude=-1.25,
        velocity=(0.3, -0.4, 0.1),
        horizontal_accuracy=0.5,
        vertical_accuracy=0.7,
    )
    message = parse(frame_of(fix))
    assert (message.lat, message.lon, message.alt) == (419616000, -28353000, -1250)
    assert (message.vel, message.vn, message.ve, message.vd) == (50, 30, -40, 10)
    assert message.cog == round(100 * (360 - math.degrees(math.atan2(0.4, 0.3))))
    assert (message.eph, message.epv, message.fix_type) == (50, 70, 3)


def test_pymavlink_reads_the_true_state():
    state = TrueState(
        time_usec=5,
        quaternion=(0.5, 0.5, -0.5, 0.5),
        angular_velocity=(0.1, 0.2, 0.3),
        latitude=0.1,
        longitude=0.2,
        altitude=3.0,
        velocity=(1.0, 2.0, -3.0),
        specific_force=(0.0, 0.0, -9.80665),
    )
    message = parse(frame_of(state))
    assert message.attitude_quaternion == [0.5, 0.5, -0.5, 0.5]
    assert message.yawspeed == pytest.approx(0.3)
    assert (message.vx, message.vy, message.vz) == (100, 200, -300)
    assert message.zacc == -1000  # mG


def test_values_beyond_a_field_are_limited():
    state = TrueState(
        time_usec=5,
        quaternion=(1.0, 0.0, 0.0, 0.0),
        angular_velocity=(0.0, 0.0, 0.0),
        latitude=0.0,
        longitude=0.0,
        altitude=1e9,
        velocity=(1e6, -1e6, 0.0),
        specific_force=(1e6, 0.0, 0.0),
    )
    message = parse(frame_of(state))
    assert (message.alt, message.vx, message.vy, message.xacc) == (2**31 - 1, 32767, -32768, 32767)


def test_pymavlink_reads_an_odometry_in_ned_and_body_axes():
    odometry = Odometry(
        time_usec=5,
        position=(1.0, 2.0, 3.0),
        quaternion=(1.0, 0.0, 0.0, 0.0),
        velocity=(0.1, 0.2, 0.3),
        angular_velocity=(0.0, 0.0, 0.1),
        position_variance=0.01,
        attitude_variance=0.02,
        velocity_variance=0.03,
    )
    message = parse(frame_of(odometry))
    assert (message.frame_id, message.child_frame_id) == (
        dialect.MAV_FRAME_LOCAL_NED,
        dialect.MAV_FRAME_BODY_FRD,
    )
    assert message.estimator_type == dialect.MAV_ESTIMATOR_TYPE_VISION
    assert (message.x, message.z) == (1.0, 3.0)
    assert [message.pose_covariance[i] for i in (0, 6, 11)] == pytest.approx([0.01] * 3)
    assert [message.pose_covariance[i] for i in (15, 18, 20)] == pytest.approx([0.02] * 3)
    assert [message.velocity_covariance[i] for i in (0, 6, 11)] == pytest.approx([0.03] * 3)


@pytest.mark.parametrize("version", [1, 2])
def test_the_outputs_of_pymavlink_are_read(version):
    controls = tuple(i / 16 - 0.5 for i in range(16))
    reader = FrameReader(RECEIVED_FORMATS)
    (frame,) = reader.read(controls_frame(123_456_789, controls=controls, version=version))
    answer = decode_actuator_controls(frame.payload)
    assert answer.time_usec == 123_456_789
    assert answer.controls == pytest.approx(controls)
    assert answer.is_armed
    assert answer.is_lock_step


def test_a_frame_whose_zeros_are_cut_off_is_read():
    data = controls_frame(7, controls=(0.0,) * 16, mode=0)
    assert len(data) < 40
    (frame,) = FrameReader(RECEIVED_FORMATS).read(data)
    assert decode_actuator_controls(frame.payload).controls == (0.0,) * 16


def test_frames_are_read_however_the_stream_is_cut():
    data = b"".join(controls_frame(time) for time in range(1, 30))
    choose = random.Random(4)
    for _ in range(20):
        reader, times, start = FrameReader(RECEIVED_FORMATS), [], 0
        while start < len(data):
            end = start + choose.randrange(1, 200)
            frames = reader.read(data[start:end])
            times += [decode_actuator_controls(frame.payload).time_usec for frame in frames]
            start = end
        assert times == list(range(1, 30))
        assert reader.n_skipped == 0


def test_a_frame_with_a_wrong_byte_is_skipped_and_the_next_one_is_read():
    choose = random.Random(5)
    for _ in range(200):
        data = bytearray(controls_frame(1))
        data[choose.randrange(1, len(data))] ^= 1 << choose.randrange(8)
        reader = FrameReader(RECEIVED_FORMATS)
        frames = reader.read(bytes(data) + controls_frame(2) * 5)
        times = {decode_actuator_controls(frame.payload).time_usec for frame in frames}
        assert times == {2}
        assert reader.n_skipped > 0


def test_random_bytes_are_skipped_and_counted():
    choose = random.Random(6)
    data = bytes(choose.choice([0xFD, 0xFE, 93, 0, choose.randrange(256)]) for _ in range(20000))
    reader = FrameReader(RECEIVED_FORMATS)
    frames = reader.read(data)
    frames += reader.read(bytes(300))  # ends whatever has begun
    assert frames == []
    assert reader.n_skipped > 19000


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 1e30, -2.0])
def test_outputs_out_of_range_are_refused(value):
    payload = struct.pack("<QQ16fB", 1, 1, *[value] * 16, 128)
    assert decode_actuator_controls(payload) is None


def test_a_payload_that_is_too_long_is_refused():
    assert decode_actuator_controls(bytes(82)) is None
