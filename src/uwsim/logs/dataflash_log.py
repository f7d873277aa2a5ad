"""Logs of ArduPilot in the format DataFlash (``.bin``).

===================  ============================================================================
``XKF1``             position, velocity and attitude of the first core of the filter (EKF3)
``NKF1``             the same of EKF2, if there is no ``XKF1``
``ATT``              attitude, if the filter has none
``RATE``             angular velocity
``RCOU``             outputs, as commands of motors by ``PARM`` (`autopilot_series`)
``IMU``, ``BARO``    specific force, angular velocity; pressure, of the first instance
``RFND``, ``BAT``    range; voltage and current
===================  ============================================================================
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path

from .autopilot_series import N_OUTPUTS, AutopilotSeries, assemble_log
from .dataflash import Value, read_messages
from .mapping import LogMapping
from .units import DEGREE
from .vehicle_log import VehicleLog

MESSAGES = ("XKF1", "NKF1", "ATT", "RATE", "RCOU", "PARM", "IMU", "BARO", "RFND", "BAT")
"""The types of messages that are read."""
NAN = math.nan


def read_dataflash_log(
    path: Path, mapping: LogMapping | None = None, vehicle: str = ""
) -> VehicleLog:
    """Read a DataFlash log.

    Args:
        path: the file.
        mapping: names of outputs and the origin; None: all motors.
        vehicle: the name of the vehicle.

    Raises:
        LogError: the file is no DataFlash log, or is damaged.
        AssetError: it has neither attitudes nor outputs.
    """
    remarks: list[str] = []
    collector = _Collector()
    for name, fields in read_messages(path, MESSAGES, remarks):
        collector.add(name, fields)
    series = collector.finish()
    return assemble_log(path, "bin", series, mapping or LogMapping(), vehicle, remarks)


class _Collector:
    """The messages of a log, by the series to which they belong."""

    def __init__(self) -> None:
        self._series = {"XKF1": AutopilotSeries(), "NKF1": AutopilotSeries()}
        self._attitudes = AutopilotSeries()
        self._other = AutopilotSeries()
        self._has_positions: set[str] = set()

    def add(self, name: str, fields: Mapping[str, Value]) -> None:
        """Add a message."""
        time = _number(fields, "TimeUS") * 1e-6
        if name == "PARM":
            self._other.parameters[str(fields.get("Name", ""))] = _number(fields, "Value")
        elif name in self._series:
            if _first(fields, "C"):
                self._add_state(name, time, fields)
        elif name == "ATT":
            angles = [_number(fields, key) * DEGREE for key in ("Roll", "Pitch", "Yaw")]
            self._attitudes.attitudes.append(time, angles)
        elif name == "RATE":
            rates = [_number(fields, key) * DEGREE for key in ("R", "P", "Y")]
            self._other.rates.append(time, rates)
        elif name == "RCOU":
            pulses = [_number(fields, f"C{number}") for number in range(1, N_OUTPUTS + 1)]
            self._other.outputs.append(time, pulses)
        else:
            self._add_sensor(name, time, fields)

    def finish(self) -> AutopilotSeries:
        """Return the series, of the best source of each."""
        series = self._other
        source = next((name for name in ("XKF1", "NKF1") if name in self._has_positions), None)
        if source is not None:
            series.positions = self._series[source].positions
        filter_attitudes = self._series[source].attitudes if source else self._attitudes.attitudes
        n_filter, n_attitudes = len(filter_attitudes), len(self._attitudes.attitudes)
        series.attitudes = (
            self._attitudes.attitudes if n_attitudes >= n_filter else filter_attitudes
        )
        return series

    def _add_state(self, name: str, time: float, fields: Mapping[str, Value]) -> None:
        self._has_positions.add(name)
        series = self._series[name]
        angles = [_number(fields, key) * DEGREE for key in ("Roll", "Pitch", "Yaw")]
        series.attitudes.append(time, angles)
        keys = ("PN", "PE", "PD", "VN", "VE", "VD")
        series.positions.append(time, [_number(fields, key) for key in keys])

    def _add_sensor(self, name: str, time: float, fields: Mapping[str, Value]) -> None:
        add = self._other.add_reading
        if name == "IMU" and _first(fields, "I"):
            keys = ("AccX", "AccY", "AccZ", "GyrX", "GyrY", "GyrZ")
            names, units = ("ax", "ay", "az", "p", "q", "r"), ("m/s2",) * 3 + ("rad/s",) * 3
            add("imu", "imu", names, units, time, [_number(fields, key) for key in keys])
        elif name == "BARO" and _first(fields, "I"):
            add("pressure", "pressure", ("pressure",), ("Pa",), time, [_number(fields, "Press")])
        elif name == "RFND" and _first(fields, "Instance"):
            add("range", "range", ("range",), ("m",), time, [_number(fields, "Dist")])
        elif name == "BAT" and _first(fields, "Inst"):
            values = [_number(fields, "Volt"), _number(fields, "Curr")]
            add("battery", "battery", ("voltage", "current"), ("V", "A"), time, values)


def _number(fields: Mapping[str, Value], name: str) -> float:
    value = fields.get(name, NAN)
    return value if isinstance(value, float) else NAN


def _first(fields: Mapping[str, Value], name: str) -> bool:
    """Return whether a message is of the first instance, or has none."""
    return fields.get(name, 0.0) == 0.0
