r"""Series of an autopilot's log, and their assembly to a log of a vehicle.

Frames are north-east-down and forward-right-down, which are L and the base of nearly all scenes.
Positions are relative to the origin of the autopilot's filter. Attitudes and positions have
different times; positions and velocities are interpolated linearly to the times of attitudes.

An output becomes the command of a motor by the parameters of the autopilot, if the log has them:
``SERVOn_FUNCTION`` 33 to 40 and 82 to 85 are the motors 1 to 12. With ``SERVOn_MIN``, ``_TRIM``,
``_MAX`` and ``MOT_k_DIRECTION`` (-1: a reversed propeller, which the autopilot compensates), the
pulse width :math:`p` is the command

.. math:: u = d \, \frac{p - p_\mathrm{trim}}{p_\mathrm{max} - p_\mathrm{trim}} \quad
    \text{for } p \ge p_\mathrm{trim}, \text{ else } \quad
    u = d \, \frac{p - p_\mathrm{trim}}{p_\mathrm{trim} - p_\mathrm{min}}

Without parameters, outputs 1 to 8 are motors with 1100, 1500 and 1900 us.

The log has samples of outputs that the autopilot changes more often: 400 times a second, of which
ArduSub logs 10 (``ten_hz_logging_loop`` of ``ArduSub/Sub.cpp``). Between two samples the commands
are on the line from the one to the other (`samples.interpolate_commands`).
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType

import numpy as np

from ..base.files.input_files import compute_hash
from ..base.geometry import Array
from ..errors import BadSetting, choices
from .assemble import check_content, make_motion
from .frames import quaternions_from_rpy
from .mapping import LogMapping
from .samples import Samples, interpolate_commands
from .vehicle_log import CommandSeries, MotionSeries, SensorSeries, VehicleLog

MOTOR = re.compile(r"motor(\d+)")
"""The name of a motor in an autopilot's log without a mapping."""
N_OUTPUTS = 32
"""The greatest number of outputs."""
MOTOR_FUNCTIONS = {
    **{32 + motor: motor for motor in range(1, 9)},
    **{73 + motor: motor for motor in range(9, 13)},
}
"""The number of the motor of each function of an output."""
DEFAULT_PULSES = (1100.0, 1500.0, 1900.0)
"""The pulse widths of full reverse, stop and full forward [us]."""
N_DEFAULT_MOTORS = 8


@dataclass(kw_only=True)
class AutopilotSeries:
    """The series of an autopilot's log, as a reader collects them."""

    attitudes: Samples = field(default_factory=lambda: Samples(3, "attitude"))
    """The angles roll, pitch and yaw [rad]."""
    rates: Samples = field(default_factory=lambda: Samples(3, "rates"))
    """The angular velocities p, q and r in body axes [rad/s]."""
    positions: Samples = field(default_factory=lambda: Samples(6, "position"))
    """The positions [m] and velocities [m/s], north, east, down."""
    outputs: Samples = field(default_factory=lambda: Samples(N_OUTPUTS, "outputs"))
    """The pulse widths of all outputs [us]; NaN: none."""
    parameters: dict[str, float] = field(default_factory=dict)
    """The parameters of the autopilot, by name."""
    sensors: dict[str, tuple[str, tuple[str, ...], tuple[str, ...], Samples]] = field(
        default_factory=dict
    )
    """The kind, names, units and readings of each sensor."""

    def add_reading(
        self,
        sensor: str,
        kind: str,
        names: tuple[str, ...],
        units: tuple[str, ...],
        time: float,
        values: Sequence[float],
    ) -> None:
        """Add a reading of a sensor."""
        if sensor not in self.sensors:
            self.sensors[sensor] = (kind, names, units, Samples(len(names), sensor))
        self.sensors[sensor][3].append(time, values)


def assemble_log(
    path: Path,
    log_format: str,
    series: AutopilotSeries,
    mapping: LogMapping,
    vehicle: str,
    remarks: list[str],
) -> VehicleLog:
    """Return the log of a vehicle.

    Args:
        path: the file.
        log_format: the format of the file.
        series: the series of the log, with times on the clock of the autopilot [s].
        mapping: the mapping; its ``commands.thrusters`` names outputs ``C1``, ``C2``, ...
        vehicle: the name of the vehicle.
        remarks: the repairs of the reader, to which more are added.
    """
    attitudes = series.attitudes.finish(remarks, is_motion=True)
    rates = series.rates.finish(remarks, is_motion=True)
    positions = series.positions.finish(remarks, is_motion=True)
    output_times, outputs = series.outputs.finish(remarks)
    readings = {
        name: (kind, names, units, samples.finish(remarks))
        for name, (kind, names, units, samples) in series.sensors.items()
    }
    first_times = [
        float(times[0])
        for times in (
            *(attitudes[0], rates[0], positions[0], output_times),
            *(samples[0] for _, _, _, samples in readings.values()),
        )
        if len(times)
    ]
    start = min(first_times, default=0.0)
    motion = _make_motion(start, attitudes, rates, positions, mapping, remarks)
    commands = _make_commands(output_times - start, outputs, series.parameters, mapping, remarks)
    check_content(motion, len(commands), path.name)
    return VehicleLog(
        path=str(path),
        format=log_format,
        sha256=compute_hash(path),
        vehicle=vehicle or mapping.vehicle,
        motion=motion,
        commands=commands,
        sensors=MappingProxyType(
            {
                name: SensorSeries(
                    kind=kind, names=names, units=units, times=times - start, values=values
                )
                for name, (kind, names, units, (times, values)) in readings.items()
            }
        ),
        start=start,
        remarks=tuple(remarks),
    )


def _make_motion(
    start: float,
    attitudes: tuple[Array, Array],
    rates: tuple[Array, Array],
    positions: tuple[Array, Array],
    mapping: LogMapping,
    remarks: list[str],
) -> MotionSeries | None:
    times, angles = attitudes
    if not len(times):
        return None
    states = _interpolate(times, *positions)
    if len(positions[0]):
        is_covered = np.isfinite(states).all(axis=1)
        if not is_covered.all():
            remarks.append(
                f"motion: {int((~is_covered).sum())} attitudes before the first or after the last "
                "position; removed."
            )
        times, angles, states = times[is_covered], angles[is_covered], states[is_covered]
    else:
        remarks.append("motion: the log has no position.")
    if not len(times):
        return None
    return make_motion(
        times - start,
        states[:, :3],
        quaternions_from_rpy(angles),
        np.hstack([states[:, 3:], _interpolate(times, *rates)]),
        world="ned",
        body="frd",
        remarks=remarks,
        is_world_velocity=True,
        origin=mapping.frames.origin,
    )


def _interpolate(times: Array, sample_times: Array, values: Array) -> Array:
    """Return the values at times, (n, k); NaN before the first and after the last sample."""
    rows = np.full((len(times), values.shape[1]), np.nan)
    if len(sample_times):
        is_covered = (times >= sample_times[0]) & (times <= sample_times[-1])
        for column in range(values.shape[1]):
            numbers = np.interp(times, sample_times, values[:, column])
            rows[:, column] = np.where(is_covered, numbers, np.nan)
    return rows


def _make_commands(
    times: Array,
    outputs: Array,
    parameters: Mapping[str, float],
    mapping: LogMapping,
    remarks: list[str],
) -> tuple[CommandSeries, ...]:
    if not len(times):
        return ()
    motors = {
        MOTOR_FUNCTIONS[int(function)]: number
        for number in range(1, N_OUTPUTS + 1)
        if (function := parameters.get(f"SERVO{number}_FUNCTION", 0.0)) in MOTOR_FUNCTIONS
    }
    if not motors:
        motors = {number: number for number in range(1, N_DEFAULT_MOTORS + 1)}
        remarks.append(
            "commands: the log has no parameters SERVOn_FUNCTION; outputs 1 to 8 are motors 1 to 8."
        )
    motors = {
        motor: number
        for motor, number in sorted(motors.items())
        if np.isfinite(outputs[:, number - 1]).any()
    }
    names = tuple(f"motor{motor}" for motor in motors)
    values = np.array(
        [_scale_output(outputs, number, motor, parameters) for motor, number in motors.items()]
    ).T.reshape(len(times), len(motors))
    spec = mapping.commands.get("thrusters")
    if spec is not None:
        channels = {f"C{number}": index for index, number in enumerate(motors.values())}
        channels |= {name: index for index, name in enumerate(names)}
        for column in spec.columns:
            if column not in channels:
                raise BadSetting(
                    f"{mapping.path}: no motor has the output {column!r}."
                    f"{choices(column, channels)}"
                )
        values = values[:, [channels[column] for column in spec.columns]]
        values = values * np.array(spec.signs or [1.0] * len(spec.columns))
        names, times = spec.names or spec.columns, times + spec.delay + spec.clock_offset
    is_complete = np.isfinite(values).all(axis=1)
    if not names or not is_complete.any():
        return ()
    times, values = times[is_complete], values[is_complete]
    sample_interval = float(np.median(np.diff(times))) if len(times) > 1 else None
    times, values = interpolate_commands(times, values)
    return (
        CommandSeries(
            kind="thrusters",
            names=names,
            times=times,
            values=values,
            sample_interval=sample_interval,
        ),
    )


def _scale_output(
    outputs: Array, number: int, motor: int, parameters: Mapping[str, float]
) -> Array:
    keys = (f"SERVO{number}_MIN", f"SERVO{number}_TRIM", f"SERVO{number}_MAX")
    low, trim, high = (
        parameters.get(key, default) for key, default in zip(keys, DEFAULT_PULSES, strict=True)
    )
    if not low < trim < high:
        low, trim, high = DEFAULT_PULSES
    pulses = outputs[:, number - 1]
    pulses = np.where(pulses > 0.0, pulses, trim)  # 0: the output is off
    direction = parameters.get(f"MOT_{motor}_DIRECTION", 1.0) or 1.0
    shares = np.where(
        pulses >= trim, (pulses - trim) / (high - trim), (pulses - trim) / (trim - low)
    )
    commands: Array = direction * np.clip(shares, -1.0, 1.0)
    return commands


def name_motors(
    log: VehicleLog, thrusters: Mapping[int, tuple[str, float]], vehicle: str
) -> VehicleLog:
    """Return a log whose commands have the names and the signs of the vehicle's thrusters.

    Motor m of the log is the thruster of channel m, with the opposite sign if the channel is
    reversed. The log's ``MOT_m_DIRECTION`` is already applied: it describes a propeller of the real
    vehicle, ``<reversed>`` the frame's matrix. A ``<curve>`` is not applied. A vehicle without
    channels has its motors in the order of its hydrodynamics file.

    Args:
        log: the log; it is returned as it is if its commands are not those of motors.
        thrusters: the name of the thruster and the sign of its command, by number of the channel;
            without any, the log is returned as it is.
        vehicle: the name of the vehicle.

    Raises:
        BadSetting: a motor has no channel with a thruster.
    """
    if not thrusters:
        return log

    def rename(series: CommandSeries) -> CommandSeries:
        matches = [MOTOR.fullmatch(name) for name in series.names]
        numbers = [int(match[1]) for match in matches if match is not None]
        if series.kind != "thrusters" or len(numbers) != len(series.names):
            return series
        lost_motors = [number for number in numbers if number not in thrusters]
        if lost_motors:
            raise BadSetting(
                f"Motor {lost_motors[0]} of the log has no <channel> with a thruster in "
                f"<u:ardupilot> of {vehicle!r}. Name the thrusters in [commands.thrusters] of "
                "a mapping file."
            )
        names = tuple(thrusters[number][0] for number in numbers)
        signs = np.array([thrusters[number][1] for number in numbers])
        return replace(series, names=names, values=series.values * signs)

    return replace(log, commands=tuple(rename(series) for series in log.commands))
