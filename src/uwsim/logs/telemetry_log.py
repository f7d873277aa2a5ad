"""Logs of telemetry (``.tlog``): MAVLink packets, each after its time since 1970 [us], 8 bytes.

==================================  =======================================================
``ATTITUDE``                        attitude and angular velocity
``LOCAL_POSITION_NED``              position and velocity
``SERVO_OUTPUT_RAW``                outputs, as commands of motors (`autopilot_series`)
``PARAM_VALUE``                     parameters
``SCALED_IMU2``, ``RAW_IMU``        specific force and angular velocity
``SCALED_PRESSURE2``                pressure of the external sensor
``DISTANCE_SENSOR``                 range
``BATTERY_STATUS``                  voltage and current
==================================  =======================================================

Messages of the first autopilot are read. A time is that of the autopilot's clock if the message has
one, so that delays of the link do not matter.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

from ..base.files.input_files import read_document
from ..errors import Diagnostic, MissingExtra
from .autopilot_series import N_OUTPUTS, AutopilotSeries, assemble_log
from .csv_log import LogError
from .limits import MAX_BYTES
from .mapping import LogMapping
from .units import GRAVITY
from .vehicle_log import VehicleLog

STAMP = struct.Struct(">Q")
"""The time before a packet."""
HEADS = {0xFE: 8, 0xFD: 12}
"""The length of a packet without its payload [bytes], by its first byte."""
SIGNATURE_LENGTH = 13
MAX_LOST_BYTES = 1024 * 1024
"""The greatest number of bytes that belong to no packet."""
GROUND_STATION = 6
"""The type of a component that is no autopilot (``MAV_TYPE_GCS``)."""


def read_telemetry_log(
    path: Path, mapping: LogMapping | None = None, vehicle: str = ""
) -> VehicleLog:
    """Read a telemetry log.

    Args:
        path: the file.
        mapping: names of outputs and the origin; None: all motors.
        vehicle: the name of the vehicle.

    Raises:
        MissingExtra: pymavlink is not installed.
        LogError: the file has no packet.
        AssetError: it has neither attitudes nor outputs.
    """
    remarks: list[str] = []
    collector = _Collector()
    for time, message in read_packets(path, remarks):
        collector.add(time, message)
    return assemble_log(path, "tlog", collector.series, mapping or LogMapping(), vehicle, remarks)


def read_packets(path: Path, remarks: list[str]) -> Iterator[tuple[float, Any]]:
    """Yield the time [s] and the message of each valid packet.

    Packets with a wrong checksum or an unknown type are skipped.
    """
    try:
        from pymavlink.dialects.v20 import ardupilotmega as mavlink
    except ImportError:
        raise MissingExtra(
            "A .tlog needs pymavlink: install the extra with pip install 'uwsim[mavlink]'."
        ) from None
    try:
        data = read_document(path, at_most=MAX_BYTES)
    except Exception as error:
        raise LogError(getattr(error, "diagnostics", ())) from None
    decoder = mavlink.MAVLink(None)
    offset, n_lost, n_packets, n_invalid = 0, 0, 0, 0
    while offset + STAMP.size + 3 <= len(data):
        length = _packet_length(data, offset + STAMP.size)
        if length is None:
            n_lost += 1
            offset += 1
            if n_lost > MAX_LOST_BYTES:
                raise _error(path, f"more than {MAX_LOST_BYTES} bytes belong to no packet")
            continue
        end = offset + STAMP.size + length
        if end > len(data):
            remarks.append("the log ends within a packet.")
            break
        try:
            message = decoder.decode(bytearray(data[offset + STAMP.size : end]))
        except mavlink.MAVError:
            n_invalid += 1
            offset += 1
            continue
        n_packets += 1
        yield STAMP.unpack_from(data, offset)[0] * 1e-6, message
        offset = end
    if n_packets == 0:
        raise _error(path, "has no MAVLink packet")
    if n_lost or n_invalid:
        remarks.append(
            f"{n_lost + n_invalid} bytes of the file belong to no valid packet; skipped."
        )


def _packet_length(data: bytes, offset: int) -> int | None:
    """Return the length of the packet at an offset; None if none begins there."""
    head = HEADS.get(data[offset])
    if head is None:
        return None
    is_signed = data[offset] == 0xFD and data[offset + 2] & 1
    return head + data[offset + 1] + (SIGNATURE_LENGTH if is_signed else 0)


class _Collector:
    """The messages of a log, by the series to which they belong."""

    def __init__(self) -> None:
        self.series = AutopilotSeries()
        """The series."""
        self._system: int | None = None
        self._clock = _Clock()
        self._outputs = [math.nan] * N_OUTPUTS
        self._imu = ""
        self._receivers: dict[str, Callable[[float, Any], None]] = {
            "ATTITUDE": self._add_attitude,
            "LOCAL_POSITION_NED": self._add_local_position,
            "SERVO_OUTPUT_RAW": self._add_outputs,
            "SCALED_IMU2": partial(self._add_imu, "SCALED_IMU2"),
            "RAW_IMU": partial(self._add_imu, "RAW_IMU"),
            "SCALED_PRESSURE2": self._add_pressure,
            "DISTANCE_SENSOR": self._add_range,
            "BATTERY_STATUS": self._add_battery,
        }

    def add(self, time: float, message: Any) -> None:
        """Add a message with the time of its record [s]."""
        name, system = message.get_type(), message.get_srcSystem()
        if name == "HEARTBEAT" and message.type != GROUND_STATION and self._system is None:
            self._system = system
        if self._system is not None and system != self._system:
            return
        if name == "PARAM_VALUE":
            self._add_parameter(message)
            return
        receive = self._receivers.get(name)
        boot_time = self._clock.time(message, time)
        if receive is not None and boot_time is not None:
            receive(boot_time, message)

    def _add_attitude(self, time: float, m: Any) -> None:
        angles, rates = (m.roll, m.pitch, m.yaw), (m.rollspeed, m.pitchspeed, m.yawspeed)
        self.series.attitudes.append(time, angles)
        self.series.rates.append(time, rates)

    def _add_local_position(self, time: float, m: Any) -> None:
        self.series.positions.append(time, (m.x, m.y, m.z, m.vx, m.vy, m.vz))

    def _add_outputs(self, time: float, m: Any) -> None:
        first = 16 * min(int(m.port), 1)
        for number in range(1, 17):
            self._outputs[first + number - 1] = float(getattr(m, f"servo{number}_raw", math.nan))
        if first == 0:
            self.series.outputs.append(time, self._outputs)

    def _add_parameter(self, m: Any) -> None:
        name = m.param_id if isinstance(m.param_id, str) else m.param_id.decode("ascii", "replace")
        self.series.parameters[name.rstrip("\0")] = float(m.param_value)

    def _add_imu(self, name: str, time: float, m: Any) -> None:
        """Add milli-g and milli-rad/s of the first of two messages that occurs."""
        self._imu = self._imu or name
        if self._imu == name:
            force = [1e-3 * GRAVITY * value for value in (m.xacc, m.yacc, m.zacc)]
            rates = [1e-3 * value for value in (m.xgyro, m.ygyro, m.zgyro)]
            names, units = ("ax", "ay", "az", "p", "q", "r"), ("m/s2",) * 3 + ("rad/s",) * 3
            self.series.add_reading("imu", "imu", names, units, time, [*force, *rates])

    def _add_pressure(self, time: float, m: Any) -> None:
        values = [100.0 * m.press_abs]
        self.series.add_reading("pressure", "pressure", ("pressure",), ("Pa",), time, values)

    def _add_range(self, time: float, m: Any) -> None:
        values = [0.01 * m.current_distance]
        self.series.add_reading("range", "range", ("range",), ("m",), time, values)

    def _add_battery(self, time: float, m: Any) -> None:
        cells = [value for value in m.voltages if value != 0xFFFF]
        values = [1e-3 * sum(cells), 0.01 * m.current_battery]
        names, units = ("voltage", "current"), ("V", "A")
        self.series.add_reading("battery", "battery", names, units, time, values)


class _Clock:
    """The clock of the autopilot, whose counters overflow."""

    def __init__(self) -> None:
        self._offset: float | None = None

    def time(self, message: Any, record_time: float) -> float | None:
        """Return the time of a message since the autopilot started [s]; None: not yet known."""
        boot = getattr(message, "time_boot_ms", None)
        period = 2**32 * 1e-3
        seconds = None if boot is None else boot * 1e-3
        if seconds is None and message.get_type() in ("SERVO_OUTPUT_RAW", "RAW_IMU"):
            seconds, period = message.time_usec * 1e-6, 2**32 * 1e-6
        if self._offset is None:
            if boot is None:
                return None
            self._offset = record_time - boot * 1e-3
        expected_time = record_time - self._offset
        if seconds is None or seconds > 1e8:
            return expected_time
        overflows = round((expected_time - seconds) / period)
        return float(seconds + period * overflows)


def _error(path: Path, message: str) -> LogError:
    return LogError([Diagnostic(file=str(path), line=None, message=message)])
