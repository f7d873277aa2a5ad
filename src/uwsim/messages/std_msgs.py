"""Messages of std_msgs and of builtin_interfaces, with ROS's defaults (see `uwsim.messages`)."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Any, ClassVar

import numpy as np

_ZEROS_0: Any = partial(np.zeros, 0)
_FLOATS_0: Any = partial(np.zeros, 0, np.float32)
_BYTES_0: Any = partial(np.zeros, 0, np.uint8)
"""What makes the arrays, anew for each message."""


@dataclass
class Time:
    """A moment, from the beginning of the simulation."""

    sec: int = 0
    nanosec: int = 0
    __msgtype__: ClassVar[str] = "builtin_interfaces/msg/Time"


@dataclass
class Header:
    """When and in which frame."""

    stamp: Time = field(default_factory=Time)
    frame_id: str = ""
    __msgtype__: ClassVar[str] = "std_msgs/msg/Header"


@dataclass
class Bool:
    """True or False."""

    data: bool = False
    __msgtype__: ClassVar[str] = "std_msgs/msg/Bool"


@dataclass
class Float64:
    """A number."""

    data: float = 0.0
    __msgtype__: ClassVar[str] = "std_msgs/msg/Float64"


@dataclass
class String:
    """Text."""

    data: str = ""
    __msgtype__: ClassVar[str] = "std_msgs/msg/String"


@dataclass
class MultiArrayDimension:
    """One dimension of an array."""

    label: str = ""
    size: int = 0
    stride: int = 0
    __msgtype__: ClassVar[str] = "std_msgs/msg/MultiArrayDimension"


@dataclass
class MultiArrayLayout:
    """The layout of an array."""

    dim: list[MultiArrayDimension] = field(default_factory=list)
    data_offset: int = 0
    __msgtype__: ClassVar[str] = "std_msgs/msg/MultiArrayLayout"


@dataclass
class Float32MultiArray:
    """Numbers of 32 bits."""

    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    data: np.ndarray[tuple[int, ...], np.dtype[np.float32]] = field(default_factory=_FLOATS_0)
    __msgtype__: ClassVar[str] = "std_msgs/msg/Float32MultiArray"


@dataclass
class Float64MultiArray:
    """Numbers of 64 bits."""

    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    data: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = field(default_factory=_ZEROS_0)
    __msgtype__: ClassVar[str] = "std_msgs/msg/Float64MultiArray"


@dataclass
class UInt8MultiArray:
    """Bytes."""

    layout: MultiArrayLayout = field(default_factory=MultiArrayLayout)
    data: np.ndarray[tuple[int, ...], np.dtype[np.uint8]] = field(default_factory=_BYTES_0)
    __msgtype__: ClassVar[str] = "std_msgs/msg/UInt8MultiArray"


@dataclass
class ColorRGBA:
    """A colour and its opacity [0..1]."""

    r: float = 0.0
    g: float = 0.0
    b: float = 0.0
    a: float = 0.0
    __msgtype__: ClassVar[str] = "std_msgs/msg/ColorRGBA"


@dataclass
class Duration:
    """A span of time."""

    sec: int = 0
    nanosec: int = 0
    __msgtype__: ClassVar[str] = "builtin_interfaces/msg/Duration"
