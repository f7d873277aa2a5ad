"""The motors of an autopilot's log, as thrusters of the vehicle, by its ``<u:ardupilot>``.

Motor m of the log is the thruster of ``<channel> <number>m</number>``, with the opposite sign if
the channel is ``<reversed>``. The log's ``MOT_m_DIRECTION`` is already applied: it describes a
propeller of the real vehicle, ``<reversed>`` the frame's matrix. A ``<curve>`` is not applied. A
vehicle without channels has its motors in the order of its hydrodynamics file.
"""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from ..devices.ardupilot import ArduPilotSpec
from ..errors import BadSetting
from ..logs import CommandSeries, VehicleLog
from ..scene.vehicle import VehicleSpec

MOTOR = re.compile(r"motor(\d+)")
"""The name of a motor in an autopilot's log without a mapping."""


def name_motors(log: VehicleLog, vehicle: VehicleSpec) -> VehicleLog:
    """Return a log whose commands have the names and the signs of the vehicle's thrusters.

    Args:
        log: the log; it is returned as it is if its commands are not those of motors.
        vehicle: the vehicle.

    Raises:
        BadSetting: a motor has no channel with a thruster.
    """
    channels = [
        channel
        for device in vehicle.parts_of(ArduPilotSpec)
        for channel in device.channels
        if channel.thruster is not None
    ]
    if not channels:
        return log
    channels_by_number = {channel.number: channel for channel in channels}

    def rename(series: CommandSeries) -> CommandSeries:
        matches = [MOTOR.fullmatch(name) for name in series.names]
        numbers = [int(match[1]) for match in matches if match is not None]
        if series.kind != "thrusters" or len(numbers) != len(series.names):
            return series
        lost_motors = [number for number in numbers if number not in channels_by_number]
        if lost_motors:
            raise BadSetting(
                f"Motor {lost_motors[0]} of the log has no <channel> with a thruster in "
                f"<u:ardupilot> of {vehicle.name!r}. Name the thrusters in [commands.thrusters] of "
                "a mapping file."
            )
        thruster_channels = [channels_by_number[number] for number in numbers]
        signs = np.array([-1.0 if channel.reversed else 1.0 for channel in thruster_channels])
        names = tuple(str(channel.thruster) for channel in thruster_channels)
        return replace(series, names=names, values=series.values * signs)

    return replace(log, commands=tuple(rename(series) for series in log.commands))
