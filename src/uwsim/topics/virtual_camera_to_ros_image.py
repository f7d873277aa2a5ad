"""virtualCameraToROSImage: a camera on topics; images are rendered only for subscribers."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from ..base.record import Record
from ..base.sampling import SampleTimer, TimerState
from ..messages import CameraInfo, Image, image, pixels_of
from ..sensors.virtual_camera import VirtualCamera
from .depth_images import DepthImagePublisher, publish_depth
from .interface import Interface, InterfaceSpec, TopicWorld, rate_element, sample_rate


@dataclass(frozen=True, kw_only=True)
class VirtualCameraToROSImageSpec(InterfaceSpec):
    """A publisher of a camera as sensor_msgs/Image and CameraInfo."""

    sources: ClassVar[tuple[str, ...]] = ("virtualCamera", "virtualRangeImage")
    messages: ClassVar[Mapping[str, type]] = {"image_topic": Image, "info_topic": CameraInfo}

    camera_name: str
    """The name of the camera."""
    image_topic: str
    """The topic of the images."""
    info_topic: str
    """The topic of the camera's description."""
    rate: float = rate_element()
    """The rate of publication [Hz]."""
    depth: bool = False
    """True if depth images are published instead of colour images."""

    def bind(self, world: TopicWorld) -> ImagePublisher | DepthImagePublisher:
        """Find the camera; raise UnknownName if there is no such camera."""
        if self.depth:
            topics = self.image_topic, self.info_topic
            return publish_depth(world, self.camera_name, topics, self.rate)
        return ImagePublisher(self, world.sensors.camera(self.camera_name), world)


@dataclass(slots=True)
class PublisherState(Record):
    """The state of a publisher of images."""

    timer: TimerState
    """The state of the timer of the samples."""
    n_frames: int = 0
    """The number of published images."""
    last_pixels: npt.NDArray[np.uint8] | None = None
    """The pixels of the last image published; read-only."""


class ImagePublisher(Interface):
    """A publisher of the images of a camera.

    An image without a subscriber is not rendered, but the camera's random stream advances: the
    images do not depend on when there are subscribers. In a world that is blind, for algorithms
    that use no images, the images are black.
    """

    def __init__(
        self, spec: VirtualCameraToROSImageSpec, camera: VirtualCamera, world: TopicWorld
    ) -> None:
        self.camera = camera
        """The camera whose images are published."""
        camera.state.n_images = camera.n_images or 0
        self.image_topic = spec.image_topic
        """The topic of the images."""
        self._world, self._info_topic = world, spec.info_topic
        shape = (camera.intrinsics.height, camera.intrinsics.width)
        black = np.zeros(shape if camera.is_grey else (*shape, 3), dtype=camera.pixel_type)
        self._black_image: npt.NDArray[Any] | None = black if world.is_blind else None
        self._publish_image = world.sensors.publisher(spec.camera_name, spec.image_topic, Image)
        self._publish_info = world.bus.publisher(spec.info_topic, CameraInfo)
        self._digest = hashlib.sha256()
        self.request_image: Callable[[ImagePublisher, float], bool] | None = None
        """A function that requests an image, of a publisher and a time [s], from another process.
        It returns False if it cannot; otherwise it calls `deliver` when the image arrives."""
        self.timer = SampleTimer(0, sample_rate(spec.rate, world), world.timestep, self.publish)
        """The timer that publishes at the steps at which a sample is due."""
        self.state: PublisherState = PublisherState(self.timer.state)

    @property
    def n_frames(self) -> int:
        """The number of published images."""
        return self.state.n_frames

    @property
    def last_pixels(self) -> npt.NDArray[np.uint8] | None:
        """The pixels of the last image published; read-only."""
        return self.state.last_pixels

    @property
    def sha256(self) -> str:
        """The SHA-256 hash of the pixels of all images published so far, in order."""
        return self._digest.hexdigest()

    def publish(self) -> None:
        """Take the sample that is due and publish it."""
        self.camera.state.n_images = (self.camera.n_images or 0) + 1
        time, bus = self._world.time, self._world.bus
        if bus.has_subscribers(self._info_topic):
            self._publish_info(self.camera.info(time))
        if not bus.has_subscribers(self.image_topic):
            self.camera.skip()
            return
        if self._black_image is not None:
            self.deliver(image(self._black_image, time=time, frame_id=self.camera.frame_id))
        elif self.request_image is not None and self.request_image(self, time):
            self.camera.skip()
        else:
            self.deliver(self.camera.sample(time))

    def deliver(self, message: Image) -> None:
        """Publish an image of the camera."""
        if self._black_image is None:
            self._digest.update(message.data.data)
        self.state.n_frames += 1
        self._publish_image(message)
        self.state.last_pixels = pixels_of(message)
