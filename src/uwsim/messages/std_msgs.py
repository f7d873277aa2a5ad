"""Messages of std_msgs and of builtin_interfaces, with ROS's defaults (see `uwsim.messages`)."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from rosbags.typesys.stores import ros2_jazzy as ros

_ZEROS_0: Any = partial(np.zeros, 0)
_FLOATS_0: Any = partial(np.zeros, 0, np.float32)
_BYTES_0: Any = partial(np.zeros, 0, np.uint8)
"""What makes the arrays, anew for each message."""


@dataclass
class Time(ros.builtin_interfaces__msg__Time):
    """A moment, from the beginning of the simulation."""

    sec: int = 0
    nanosec: int = 0


@dataclass
class Header(ros.std_msgs__msg__Header):
    """When and in which frame."""

    stamp: Time = field(default_factory=Time)
    frame_id: str = ""


@dataclass
class Bool(ros.std_msgs__msg__Bool):
    """True or False."""

    data: bool = False


@dataclass
class Float64(ros.std_msgs__msg__Float64):
    """A number."""

    data: float = 0.0


@dataclass
class String(ros.std_msgs__msg__String):
    """Text."""

    data: str = ""


@dataclass
class MultiArrayDimension(ros.std_msgs__msg__MultiArrayDimension):
    """One dimension of an array."""

    label: str = ""
    size: int = 0
    stride: int = 0


@dataclass
class MultiArrayLayout(ros.std_msgs__msg__MultiArrayLayout):
    """The layout of an array."""

    dim: list[ros.std_msgs__msg__MultiArrayDimension] = field(default_factory=list)
    data_offset: int = 0


@dataclass
class Float32MultiArray(ros.std_msgs__msg__Float32MultiArray):
    """Numbers of 32 bits."""

    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    data: np.ndarray[tuple[int, ...], np.dtype[np.float32]] = field(default_factory=_FLOATS_0)


@dataclass
class Float64MultiArray(ros.std_msgs__msg__Float64MultiArray):
    """Numbers of 64 bits."""

    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    data: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_0)


@dataclass
class UInt8MultiArray(ros.std_msgs__msg__UInt8MultiArray):
    """Bytes."""

    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    data: np.ndarray[tuple[int, ...], np.dtype[np.uint8]] = field(default_factory=_BYTES_0)


@dataclass
class ColorRGBA(ros.std_msgs__msg__ColorRGBA):
    """A colour and its opacity [0..1]."""

    r: float = 0.0
    g: float = 0.0
    b: float = 0.0
    a: float = 0.0


@dataclass
class Duration(ros.builtin_interfaces__msg__Duration):
    """A span of time."""

    sec: int = 0
    nanosec: int = 0
