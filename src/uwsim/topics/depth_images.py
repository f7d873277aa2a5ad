"""Interfaces that publish depth cameras."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..schema import element
from .interface import InterfaceSpec


@dataclass(frozen=True, kw_only=True)
class RangeImageSensorToROSImageSpec(InterfaceSpec):
    """Publishes a depth camera as sensor_msgs/Image and CameraInfo."""

    sources: ClassVar[tuple[str, ...]] = ("virtualRangeImage", "virtualCamera")

    camera_name: str
    """Name of the depth camera."""
    image_topic: str
    """Topic of the images."""
    info_topic: str
    """Topic of the camera's description."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class RangeCameraToPCLSpec(InterfaceSpec):
    """Publishes a depth camera as sensor_msgs/PointCloud2."""

    sources: ClassVar[tuple[str, ...]] = ("virtualRangeImage",)

    camera_name: str
    """Name of the depth camera."""
    topic: str
    """Name of the topic."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""
