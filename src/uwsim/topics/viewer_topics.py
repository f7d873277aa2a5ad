"""Interfaces whose messages the viewer shows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..schema import element
from .interface import InterfaceSpec


@dataclass(frozen=True, kw_only=True)
class ROSImageToHUDSpec(InterfaceSpec):
    """Shows images of a topic in the viewer."""

    subscribes: ClassVar[bool] = True

    width: int = element(minimum=1)
    """Columns of the images [px]."""
    height: int = element(minimum=1)
    """Rows of the images [px]."""
    posx: int = 0
    """From the left edge of the window [px]."""
    posy: int = 0
    """From the bottom edge of the window [px]."""
    scale: float = 1.0
    """Size on the screen [1]."""
    black_white: bool = False
    """Whether the images have one channel."""
    image_topic: str
    """Topic of the images."""
    info_topic: str = ""
    """Topic of the camera's description."""


@dataclass(frozen=True, kw_only=True)
class ROSPointCloudLoaderSpec(InterfaceSpec):
    """Shows sensor_msgs/PointCloud2 in the scene."""

    subscribes: ClassVar[bool] = True

    topic: str
    """Name of the topic."""
    del_last_pcd: bool = element("delLastPCD", attribute=True, default=True)
    """Whether a cloud replaces the one before."""
