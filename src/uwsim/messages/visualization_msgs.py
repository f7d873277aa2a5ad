"""Messages of visualization_msgs with ROS's defaults (see `uwsim.messages`)."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Any, ClassVar

import numpy as np

from .geometry_msgs import Point, Pose, Vector3
from .sensor_msgs import CompressedImage
from .std_msgs import ColorRGBA, Duration, Header

_BYTES_0: Any = partial(np.zeros, 0, np.uint8)
"""What makes the array, anew for each message."""


@dataclass
class MeshFile:
    """The content of a mesh file."""

    filename: str = ""
    data: np.ndarray[tuple[int, ...], np.dtype[np.uint8]] = field(default_factory=_BYTES_0)
    __msgtype__: ClassVar[str] = "visualization_msgs/msg/MeshFile"


@dataclass
class UVCoordinate:
    """A place in a texture."""

    u: float = 0.0
    v: float = 0.0
    __msgtype__: ClassVar[str] = "visualization_msgs/msg/UVCoordinate"


@dataclass
class Marker:
    """A shape to show: `ns` and `id` name it; type, pose, scale [m] and colour say what it is."""

    ARROW: ClassVar[int] = 0
    CUBE: ClassVar[int] = 1
    SPHERE: ClassVar[int] = 2
    CYLINDER: ClassVar[int] = 3
    LINE_STRIP: ClassVar[int] = 4
    LINE_LIST: ClassVar[int] = 5
    CUBE_LIST: ClassVar[int] = 6
    SPHERE_LIST: ClassVar[int] = 7
    POINTS: ClassVar[int] = 8
    TEXT_VIEW_FACING: ClassVar[int] = 9
    MESH_RESOURCE: ClassVar[int] = 10
    TRIANGLE_LIST: ClassVar[int] = 11
    ARROW_STRIP: ClassVar[int] = 12
    ADD: ClassVar[int] = 0
    MODIFY: ClassVar[int] = 0
    DELETE: ClassVar[int] = 2
    DELETEALL: ClassVar[int] = 3
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
    points: list[Point] = field(default_factory=list)
    colors: list[ColorRGBA] = field(default_factory=list)
    texture_resource: str = ""
    texture: CompressedImage = field(default_factory=CompressedImage)
    uv_coordinates: list[UVCoordinate] = field(default_factory=list)
    text: str = ""
    mesh_resource: str = ""
    mesh_file: MeshFile = field(default_factory=MeshFile)
    mesh_use_embedded_materials: bool = False
    __msgtype__: ClassVar[str] = "visualization_msgs/msg/Marker"


@dataclass
class MarkerArray:
    """Several shapes."""

    markers: list[Marker] = field(default_factory=list)
    __msgtype__: ClassVar[str] = "visualization_msgs/msg/MarkerArray"
