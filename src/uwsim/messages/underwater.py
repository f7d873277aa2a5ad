"""Pressure, DVL and LedLight of underwater_sensor_msgs, the messages of UWSim, with ROS's defaults.

Names and order are those of its ``.msg`` files, which are next to this one; a test compares them.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from .std_msgs import Duration, Header


@dataclass
class Pressure:
    """One number: a depth [m] or a pressure [Pa], as the sensor is set."""

    header: Header = field(default_factory=Header)
    pressure: float = 0.0
    __msgtype__: ClassVar[str] = "underwater_sensor_msgs/msg/Pressure"


@dataclass
class LedLight:
    """How long a signal lamp is to shine from now on."""

    duration: Duration = field(default_factory=Duration)
    __msgtype__: ClassVar[str] = "underwater_sensor_msgs/msg/LedLight"


@dataclass
class DVL:
    """Velocities [m/s] and distances [m] of a DVL, as in RDI's format PD6.

    The first letter is w for the water, b for the bottom; the second the axes: i of the
    instrument, s of the ship, e of the Earth, d for distances.
    """

    header: Header = field(default_factory=Header)
    header_dvl: str = ""
    date: str = ""
    salinity: float = 0.0
    temperature: float = 0.0
    depth: float = 0.0
    sound_speed: float = 0.0
    test: int = 0
    wi_x_axis: float = 0.0
    wi_y_axis: float = 0.0
    wi_z_axis: float = 0.0
    wi_error: float = 0.0
    wi_status: str = ""
    bi_x_axis: float = 0.0
    bi_y_axis: float = 0.0
    bi_z_axis: float = 0.0
    bi_error: float = 0.0
    bi_status: str = ""
    ws_transverse: float = 0.0
    ws_longitudinal: float = 0.0
    ws_normal: float = 0.0
    ws_status: str = ""
    bs_transverse: float = 0.0
    bs_longitudinal: float = 0.0
    bs_normal: float = 0.0
    bs_status: str = ""
    we_east: float = 0.0
    we_north: float = 0.0
    we_upwards: float = 0.0
    we_status: str = ""
    be_east: float = 0.0
    be_north: float = 0.0
    be_upwards: float = 0.0
    be_status: str = ""
    wd_east: float = 0.0
    wd_north: float = 0.0
    wd_upwards: float = 0.0
    wd_range: float = 0.0
    wd_time: float = 0.0
    bd_east: float = 0.0
    bd_north: float = 0.0
    bd_upwards: float = 0.0
    bd_range: float = 0.0
    bd_time: float = 0.0
    raw_data: str = ""
    __msgtype__: ClassVar[str] = "underwater_sensor_msgs/msg/DVL"
