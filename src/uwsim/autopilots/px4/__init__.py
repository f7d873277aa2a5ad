"""The HIL messages of PX4: sensor readings to PX4, and its actuator controls back."""

from __future__ import annotations

from .frames import FrameReader, encode_frame
from .hil_messages import (
    ACTUATOR_CHANNELS,
    HIL_ACTUATOR_CONTROLS,
    RECEIVED_FORMATS,
    ActuatorControls,
    HilMessage,
    Odometry,
    SatelliteFix,
    SensorReadings,
    TrueState,
    decode_actuator_controls,
)
from .magnetic_field import magnetic_field
from .standard_atmosphere import air_pressure, air_temperature

__all__ = [
    "ACTUATOR_CHANNELS",
    "HIL_ACTUATOR_CONTROLS",
    "RECEIVED_FORMATS",
    "ActuatorControls",
    "FrameReader",
    "HilMessage",
    "Odometry",
    "SatelliteFix",
    "SensorReadings",
    "TrueState",
    "air_pressure",
    "air_temperature",
    "decode_actuator_controls",
    "encode_frame",
    "magnetic_field",
]
