"""Logs of real and simulated vehicles: motion, commands and sensors on one time base."""

from __future__ import annotations

from .vehicle_log import CommandSeries, MotionSeries, SensorSeries, VehicleLog

__all__ = ["CommandSeries", "MotionSeries", "SensorSeries", "VehicleLog"]
