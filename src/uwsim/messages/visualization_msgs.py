"""Messages of visualization_msgs with ROS's defaults (see `uwsim.messages`)."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from rosbags.typesys.stores import ros2_jazzy as ros

from .geometry_msgs import Pose, Vector3
from .sensor_msgs import CompressedImage
from .std_msgs import ColorRGBA, Duration, Header

_BYTES_0: Any = partial(np.zeros, 0, np.uint8)
"""What makes the array, anew for each message."""


@dataclass
class MeshFile(ros.visualization_msgs__msg__MeshFile):
    """The content of a mesh file."""

    filename: str = ""
    data: np.ndarray[tuple[int, ...], np.dtype[np.uint8]] = field(default_factory=_BYTES_0)


@dataclass
class Marker(ros.visualization_msgs__msg__Marker):
    """A shape to show: `ns` and `id` name it; type, pose, scale [m] and colour say what it is."""

    header: Header = field(default_factory=Header)
    ns: str = ""
    id: int = 0
    type: int = 0
    action: int = 0
    pose: Pose = field(default_factory=Pose)
    scale: Vector3 = field(default_factory=Vector3)
    color: ColorRGBA = field(default_factory=ColorRGBA)
    lifetime: Duration = field(default_factory=Duration)
    frame_locked: bool = False
    points: list[ros.geometry_msgs__msg__Point] = field(default_factory=list)
    colors: list[ros.std_msgs__msg__ColorRGBA] = field(default_factory=list)
    texture_resource: str = ""
    texture: CompressedImage = field(default_factory=CompressedImage)
    uv_coordinates: list[ros.visualization_msgs__msg__UVCoordinate] = field(default_factory=list)
    text: str = ""
    mesh_resource: str = ""
    mesh_file: MeshFile = field(default_factory=MeshFile)
    mesh_use_embedded_materials: bool = False


@dataclass
class MarkerArray(ros.visualization_msgs__msg__MarkerArray):
    """Several shapes."""

    markers: list[ros.visualization_msgs__msg__Marker] = field(  # type: ignore[assignment]
        default_factory=list
    )
