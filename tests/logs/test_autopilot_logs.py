"""Logs of autopilots, as their own library reads them."""

from __future__ import annotations

import contextlib
import math
import struct
from pathlib import Path

import numpy as np
import pytest

from tests.logs.dataflash_files import FORMAT_OF_FORMATS, FORMATS, format_message, message
from uwsim.errors import UwsimError
from uwsim.logs import LogError, LogMapping, read_log
from uwsim.logs.dataflash import read_messages
from uwsim.logs.mapping import CommandMapping


def make_dataflash(*, with_parameters: bool = True) -> bytes:
    """Return a log of 4 s: a turn to starboard at 0.3 rad/s, 0.5 m/s north, 10 m deep."""
    parts = [FORMAT_OF_FORMATS, *map(format_message, FORMATS)]
    if with_parameters:
        for name, value in (
            ("SERVO1_FUNCTION", 34.0),
            ("SERVO2_FUNCTION", 33.0),
            ("MOT_1_DIRECTION", -1.0),
            ("SERVO1_TRIM", 1520.0),
        ):
            parts.append(message("PARM", 0, name.encode(), value))
    for step in range(41):
        time = 5_000_000 + step * 100_000
        t = 0.1 * step
        yaw = round(100.0 * math.degrees(0.3 * t))
        parts.append(message("RATE", time, 0.0, 0.0, math.degrees(0.3)))
        parts.append(
            message("XKF1", time, 0, 100, -200, yaw, 0.5, 0.0, 0.0, 0.0, 0.5 * t, 1.0, 10.0)
        )
        parts.append(message("XKF1", time, 1, 0, 0, 0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0))
        parts.append(message("RCOU", time, 1900, 1600, *[1500] * 6))
        parts.append(message("IMU", time, 0, 0.0, 0.0, 0.3, 0.0, 0.0, -9.8))
        parts.append(message("BARO", time, 0, 0.0, 201000.0))
    return b"".join(parts)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    file = tmp_path / "dive.bin"
    file.write_bytes(make_dataflash())
    return file


def test_a_dataflash_log_has_motion_commands_and_sensors(path: Path) -> None:
    log = read_log(path)
    assert log.format == "bin"
    assert log.duration == pytest.approx(4.0)
    motion = log.motion
    assert motion is not None
    assert motion.twist_source == "log"
    np.testing.assert_allclose(motion.positions[-1], [2.0, 1.0, 10.0], atol=1e-6)
    half = 0.5 * 1.2
    assert abs(motion.quaternions[-1, 3]) == pytest.approx(math.sin(half), abs=2e-3)
    assert motion.twists is not None
    np.testing.assert_allclose(motion.twists[:, 5], 0.3, atol=1e-6)
    forward = 0.5 * math.cos(1.2)
    assert motion.twists[-1, 0] == pytest.approx(forward, abs=0.01)
    assert motion.twists[-1, 1] == pytest.approx(-0.5 * math.sin(1.2), abs=0.02)
    [commands] = log.commands
    assert commands.names == ("motor1", "motor2")
    np.testing.assert_allclose(commands.values[0], [-0.25, 1.0], atol=1e-9)
    assert log.sensors["pressure"].values[0, 0] == 201000.0
    assert log.sensors["imu"].names == ("ax", "ay", "az", "p", "q", "r")


def test_without_parameters_the_first_eight_outputs_are_motors(tmp_path: Path) -> None:
    file = tmp_path / "dive.bin"
    file.write_bytes(make_dataflash(with_parameters=False))
    log = read_log(file)
    [commands] = log.commands
    assert commands.names == tuple(f"motor{number}" for number in range(1, 9))
    np.testing.assert_allclose(commands.values[0, :2], [1.0, 0.25])
    assert any("SERVOn_FUNCTION" in remark for remark in log.remarks)


def test_a_mapping_names_the_outputs_and_their_signs(path: Path) -> None:
    mapping = LogMapping(
        commands={
            "thrusters": CommandMapping(
                columns=("C1", "C2"), names=("port", "starboard"), signs=(-1.0, 1.0)
            )
        }
    )
    [commands] = read_log(path, mapping=mapping).commands
    assert commands.names == ("port", "starboard")
    np.testing.assert_allclose(commands.values[0], [-1.0, -0.25], atol=1e-9)


def test_our_reader_reads_what_the_library_of_the_autopilot_reads(path: Path) -> None:
    reader_module = pytest.importorskip("pymavlink.DFReader", reason="the extra mavlink")
    reader = reader_module.DFReader_binary(str(path))
    their_records = []
    while (record := reader.recv_match(type=["XKF1", "RCOU", "PARM"])) is not None:
        their_records.append((record.get_type(), record.to_dict()))
    reader.data_map.close()
    reader.filehandle.close()  # it closes neither itself
    our_records = list(read_messages(path, ["XKF1", "RCOU", "PARM"], []))
    assert [name for name, _ in our_records] == [name for name, _ in their_records]
    for (_, fields), (_, other) in zip(our_records, their_records, strict=True):
        for column, value in fields.items():
            expected = other[column]
            if not isinstance(expected, str):
                expected = pytest.approx(expected, rel=1e-6)
            assert value == expected


def test_a_log_that_ends_within_a_message_is_read(path: Path) -> None:
    path.write_bytes(make_dataflash()[:-7])
    log = read_log(path)
    assert "the log ends within a message." in log.remarks


def test_bytes_of_no_message_are_skipped_and_reported(path: Path) -> None:
    data = make_dataflash()
    middle = data.rindex(b"\xa3\x95\x41")
    path.write_bytes(data[:middle] + b"garbage" + data[middle:])
    log = read_log(path)
    assert "7 bytes of the file belong to no message; skipped." in log.remarks


@pytest.mark.parametrize("data", [b"", b"nonsense" * 100, b"\xa3\x95" + bytes(200_000)])
def test_a_file_that_is_no_log_is_an_error(data: bytes, path: Path) -> None:
    path.write_bytes(data)
    with pytest.raises(UwsimError, match=r"dive\.bin"):
        read_log(path)


@pytest.mark.parametrize("seed", range(20))
def test_damaged_logs_raise_errors_of_uwsim_only(seed: int, path: Path) -> None:
    rng = np.random.default_rng(seed)
    data = bytearray(make_dataflash())
    for place in rng.integers(0, len(data), 30):
        data[place] = int(rng.integers(0, 256))
    path.write_bytes(bytes(data))
    with contextlib.suppress(UwsimError):
        read_log(path)


def make_telemetry(*, overflow: bool = False) -> bytes:
    mavlink = pytest.importorskip(
        "pymavlink.dialects.v20.ardupilotmega", reason="the extra mavlink"
    )
    sender = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    origin = 2**32 - 1_000_000 if overflow else 5_000_000
    parts = []

    def add(step: int, packet: object) -> None:
        stamp = 1_700_000_000_000_000 + step * 100_000
        parts.append(struct.pack(">Q", stamp) + packet.pack(sender))  # type: ignore[attr-defined]

    add(0, mavlink.MAVLink_heartbeat_message(12, 3, 0, 0, 0, 3))
    add(0, mavlink.MAVLink_param_value_message(b"SERVO1_FUNCTION", 33.0, 9, 2, 0))
    add(0, mavlink.MAVLink_param_value_message(b"SERVO3_FUNCTION", 34.0, 9, 2, 1))
    for step in range(41):
        t = 0.1 * step
        micros = origin + step * 100_000
        boot = micros // 1000
        add(step, mavlink.MAVLink_attitude_message(boot, 0.01, -0.02, 0.3 * t, 0, 0, 0.3))
        add(step, mavlink.MAVLink_local_position_ned_message(boot, 0.5 * t, 1, 10, 0.5, 0, 0))
        outputs = [1900, 1500, 1100, *[1500] * 5]
        add(
            step,
            mavlink.MAVLink_servo_output_raw_message(micros % 2**32, 0, *outputs),
        )
        add(step, mavlink.MAVLink_scaled_pressure2_message(boot, 2010.0, 0.0, 2000))
    return b"".join(parts)


@pytest.mark.parametrize("overflow", [False, True])
def test_a_telemetry_log_has_motion_commands_and_sensors(overflow: bool, tmp_path: Path) -> None:
    path = tmp_path / "dive.tlog"
    path.write_bytes(make_telemetry(overflow=overflow))
    log = read_log(path)
    assert log.duration == pytest.approx(4.0, abs=1e-3)
    assert log.motion is not None
    assert log.motion.twists is not None
    np.testing.assert_allclose(log.motion.positions[-1], [2.0, 1.0, 10.0], atol=1e-5)
    np.testing.assert_allclose(log.motion.twists[:, 5], 0.3, atol=1e-6)
    [commands] = log.commands
    assert commands.names == ("motor1", "motor2")
    assert commands.interval == pytest.approx(0.1, abs=1e-6)
    np.testing.assert_allclose(commands.values, [[1.0, -1.0]] * len(commands.times))
    assert log.sensors["pressure"].values[0, 0] == pytest.approx(201000.0)


def test_damaged_packets_are_skipped(tmp_path: Path) -> None:
    data = bytearray(make_telemetry())
    data[len(data) // 2] ^= 0xFF
    path = tmp_path / "dive.tlog"
    path.write_bytes(bytes(data) + b"\0" * 40)
    log = read_log(path)
    assert any("belong to no valid packet" in remark for remark in log.remarks)


def test_a_file_without_packets_is_an_error(tmp_path: Path) -> None:
    pytest.importorskip("pymavlink", reason="the extra mavlink")
    path = tmp_path / "dive.tlog"
    path.write_bytes(bytes(5000))
    with pytest.raises(LogError, match="no MAVLink packet"):
        read_log(path)
