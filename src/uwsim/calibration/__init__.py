"""Calibration of a real water from pictures of LEDs and of a lit board.

``uwsim calibrate`` reads pictures (`pictures`) or a table of readings, fits beam attenuation,
scattering and the shape of the phase function (`estimate`), and writes a water that a scene names.
"""

from __future__ import annotations

from .calibrate import Calibration, calibrate
from .estimate import Accuracy, Estimate, estimate_water
from .forward_model import WaterNumbers
from .measurements import Measurements, WaterReadings
from .quantities import View
from .readings import BoardReading, LedReading, Reading

__all__ = [
    "Accuracy",
    "BoardReading",
    "Calibration",
    "Estimate",
    "LedReading",
    "Measurements",
    "Reading",
    "View",
    "WaterNumbers",
    "WaterReadings",
    "calibrate",
    "estimate_water",
]
