"""Sonar images: types of marine_acoustic_msgs, with ROS's defaults.

Names, order and units are those of its ``.msg`` files, which are next to this one; a test compares
them.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Any, ClassVar

import numpy as np

from .geometry_msgs import Vector3
from .std_msgs import Header

_FLOATS_0: Any = partial(np.zeros, 0, np.float32)
_BYTES_0: Any = partial(np.zeros, 0, np.uint8)


@dataclass
class PingInfo:
    """Of a ping: frequency [Hz], speed of sound [m/s], widths of the beams [rad]."""

    frequency: float = 0.0
    sound_speed: float = 0.0
    tx_beamwidths: np.ndarray[tuple[int, ...], np.dtype[np.float32]] = field(
        default_factory=_FLOATS_0
    )
    rx_beamwidths: np.ndarray[tuple[int, ...], np.dtype[np.float32]] = field(
        default_factory=_FLOATS_0
    )
    __msgtype__: ClassVar[str] = "marine_acoustic_msgs/msg/PingInfo"


@dataclass
class SonarImageData:
    """Numbers of a sonar image as bytes: ranges one after the other, each with all beams."""

    is_bigendian: bool = False
    dtype: int = 0
    beam_count: int = 0
    data: np.ndarray[tuple[int, ...], np.dtype[np.uint8]] = field(default_factory=_BYTES_0)
    __msgtype__: ClassVar[str] = "marine_acoustic_msgs/msg/SonarImageData"


@dataclass
class ProjectedSonarImage:
    """A ping of an imaging sonar: z ahead, x up, beams in the y-z plane, bins of range [m]."""

    header: Header = field(default_factory=Header)
    ping_info: PingInfo = field(default_factory=PingInfo)
    beam_directions: list[Vector3] = field(default_factory=list)
    ranges: np.ndarray[tuple[int, ...], np.dtype[np.float32]] = field(default_factory=_FLOATS_0)
    image: SonarImageData = field(default_factory=SonarImageData)
    __msgtype__: ClassVar[str] = "marine_acoustic_msgs/msg/ProjectedSonarImage"
