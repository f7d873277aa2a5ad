"""Logs of real and simulated vehicles: motion, commands and sensors on one time base.

.. code-block:: python

    log = read_log("dive.mcap", vehicle="bluerov2")
    print(log.duration, log.motion.positions[0], log.remarks)
"""

from __future__ import annotations

from .autopilot_series import name_motors
from .csv_log import LogError, write_csv_log
from .mapping import LogMapping
from .mapping_reader import MappingError, read_mapping
from .read_log import SUFFIXES, read_log
from .vehicle_log import CommandSeries, MotionSeries, SensorSeries, VehicleLog

__all__ = [
    "SUFFIXES",
    "CommandSeries",
    "LogError",
    "LogMapping",
    "MappingError",
    "MotionSeries",
    "SensorSeries",
    "VehicleLog",
    "name_motors",
    "read_log",
    "read_mapping",
    "write_csv_log",
]
