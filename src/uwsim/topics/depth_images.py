"""Interfaces that publish the depth of a camera: depth images as in REP 118, and point clouds.

Depth is the distance along the optical axis. The camera may also be a colour camera: the depth is
then free of noise and does not depend on the water.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import ClassVar, Protocol, runtime_checkable

import numpy as np

from ..base.geometry import Array, Intrinsics
from ..errors import UnknownName
from ..messages import CameraInfo, Image, PointCloud2, depth_image, point_cloud
from .interface import Interface, InterfaceSpec, TopicWorld, rate_element, sample_rate

CAMERAS = ("virtualRangeImage", "virtualCamera")
"""The elements of the cameras whose depth may be published."""


@runtime_checkable
class DepthCamera(Protocol):
    """A camera that measures depth."""

    @property
    def frame_id(self) -> str:
        """The ``frame_id`` in the headers of its messages."""

    @property
    def intrinsics(self) -> Intrinsics:
        """The intrinsics of the camera."""

    def depth(self, time: float) -> Array:
        """Measure depth along the optical axis at ``time`` [s], (h, w) [m]; +inf: no surface."""

    def info(self, time: float) -> CameraInfo:
        """Create the camera's CameraInfo message, stamped ``time`` [s]."""


@dataclass(frozen=True, kw_only=True)
class RangeImageSensorToROSImageSpec(InterfaceSpec):
    """A publisher of a depth camera as sensor_msgs/Image and CameraInfo."""

    sources: ClassVar[tuple[str, ...]] = CAMERAS
    source_kind: ClassVar[str] = "virtualRangeImage"  # a colour camera gives no depth
    messages: ClassVar[Mapping[str, type]] = {"image_topic": Image, "info_topic": CameraInfo}

    camera_name: str
    """The name of the depth camera."""
    image_topic: str
    """The topic of the images."""
    info_topic: str
    """The topic of the camera's description."""
    rate: float = rate_element()
    """The rate of publication [Hz]."""

    def bind(self, world: TopicWorld) -> DepthImagePublisher:
        """Start to publish; raise UnknownName if there is no such camera."""
        return publish_depth(
            world, self.camera_name, (self.image_topic, self.info_topic), self.rate
        )


class DepthImagePublisher(Interface):
    """A publisher of the depth of a camera; nothing is measured without a subscriber."""

    def __init__(self, name: str, image_topic: str, info_topic: str, world: TopicWorld) -> None:
        camera = _find_camera(world, name)
        self._camera, self._world = camera, world
        self._image_topic, self._info_topic = image_topic, info_topic
        self._publish_image = world.sensors.publisher(name, image_topic, Image)
        self._publish_info = world.bus.publisher(info_topic, CameraInfo)

    def publish(self) -> None:
        """Take the sample that is due and publish it."""
        time, bus, camera = self._world.time, self._world.bus, self._camera
        if bus.has_subscribers(self._info_topic):
            self._publish_info(camera.info(time))
        if bus.has_subscribers(self._image_topic):
            depth = camera.depth(time)
            self._publish_image(depth_image(depth, time=time, frame_id=camera.frame_id))


@dataclass(frozen=True, kw_only=True)
class RangeCameraToPCLSpec(InterfaceSpec):
    """A publisher of a depth camera as sensor_msgs/PointCloud2."""

    sources: ClassVar[tuple[str, ...]] = CAMERAS
    source_kind: ClassVar[str] = "virtualRangeImage"  # a colour camera gives no depth
    messages: ClassVar[Mapping[str, type]] = {"topic": PointCloud2}

    camera_name: str
    """The name of the depth camera."""
    topic: str
    """The name of the topic."""
    rate: float = rate_element()
    """The rate of publication [Hz]."""

    def bind(self, world: TopicWorld) -> PointCloudPublisher:
        """Start to publish; raise UnknownName if there is no such camera."""
        camera = _find_camera(world, self.camera_name)
        publisher = PointCloudPublisher(camera, self.camera_name, self.topic, world)
        is_read = partial(world.bus.has_subscribers, self.topic)
        world.create_timer(sample_rate(self.rate, world), publisher.publish, is_needed=is_read)
        return publisher


class PointCloudPublisher(Interface):
    """A publisher of the depth of a camera as points in its optical frame, one for each pixel.

    The frame has the name of the camera, as on ``/tf``. The point of a pixel without a surface is
    NaN.
    """

    def __init__(self, camera: DepthCamera, frame_id: str, topic: str, world: TopicWorld) -> None:
        self._camera, self._frame_id = camera, frame_id
        self._world = world
        self._publish = world.sensors.publisher(frame_id, topic, PointCloud2)

    def publish(self) -> None:
        """Take the sample that is due and publish it."""
        time = self._world.time
        optical_positions = optical_points(self._camera.depth(time), self._camera.intrinsics)
        self._publish(point_cloud(optical_positions, time=time, frame_id=self._frame_id))


def optical_points(depth: Array, intrinsics: Intrinsics) -> Array:
    """Return the point of each pixel in the optical frame, (h, w, 3) [m]; NaN: no surface.

    Args:
        depth: the depth of each pixel, (h, w) [m]; not finite where there is no surface.
        intrinsics: the intrinsics of the camera.
    """
    measured_depth = np.where(np.isfinite(depth), depth, np.nan)
    points: Array = intrinsics.rays() * [1.0, -1.0, -1.0] * measured_depth[..., None]
    return points


def publish_depth(
    world: TopicWorld, camera: str, topics: tuple[str, str], rate: float
) -> DepthImagePublisher:
    """Publish the depth of a camera on two topics.

    Args:
        world: the world with the camera.
        camera: the name of the camera.
        topics: the topic of the images and the topic of CameraInfo messages.
        rate: the rate of publication [Hz].

    Raises:
        UnknownName: there is no such camera.
    """
    publisher = DepthImagePublisher(camera, *topics, world)
    world.create_timer(sample_rate(rate, world), publisher.publish)
    return publisher


def _find_camera(world: TopicWorld, name: str) -> DepthCamera:
    camera = world.sensors.sensor(name, CAMERAS)
    if not isinstance(camera, DepthCamera):
        raise UnknownName("camera", name, ())
    return camera
