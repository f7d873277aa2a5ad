"""virtualCameraToROSImage: publishes a camera at a rate; images are rendered only if read."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import ClassVar

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
    """Publishes a camera as sensor_msgs/Image and CameraInfo."""

    sources: ClassVar[tuple[str, ...]] = ("virtualCamera", "virtualRangeImage")
    messages: ClassVar[Mapping[str, type]] = {"image_topic": Image, "info_topic": CameraInfo}

    camera_name: str
    """Name of the camera."""
    image_topic: str
    """Topic of the images."""
    info_topic: str
    """Topic of the camera's description."""
    rate: float = rate_element()
    """How often [Hz]."""
    depth: bool = False
    """Whether depth is published instead of colour (range cameras only)."""

    def bind(self, world: TopicWorld) -> ImagePublisher | DepthImagePublisher:
        """Find the camera; raises UnknownName if it is not there, or no colour camera."""
        if self.depth:
            topics = self.image_topic, self.info_topic
            return publish_depth(world, self.camera_name, topics, self.rate)
        return ImagePublisher(self, world.sensors.camera(self.camera_name), world)


@dataclass(slots=True)
class PublisherState(Record):
    """What a publisher of images has published."""

    timer: TimerState
    """The steps at which a sample is due."""
    n_frames: int = 0
    """The images published."""
    last: npt.NDArray[np.uint8] | None = None
    """The pixels of the last image published; read-only."""


class ImagePublisher(Interface):
    """Publishes the images of a camera.

    A sample without a subscriber is not rendered, but advances the camera's random stream: the
    images do not depend on who is listening. In a blind world the images are black, for
    algorithms that do not look at them.
    """

    def __init__(
        self, spec: VirtualCameraToROSImageSpec, camera: VirtualCamera, world: TopicWorld
    ) -> None:
        self.camera = camera
        """The camera whose images these are."""
        camera.state.n_images = camera.n_images or 0
        self.image_topic = spec.image_topic
        """Where they are published."""
        self._world, self._info_topic = world, spec.info_topic
        shape = (camera.intrinsics.height, camera.intrinsics.width)
        black = np.zeros(shape if camera.is_grey else (*shape, 3), dtype=np.uint8)
        self._blank = black if world.is_blind else None
        self._publish_image = world.sensors.publisher(spec.camera_name, spec.image_topic, Image)
        self._publish_info = world.bus.publisher(spec.info_topic, CameraInfo)
        self._digest = hashlib.sha256()
        self.elsewhere: Callable[[ImagePublisher, float], bool] | None = None
        """Has the sample of a time [s] drawn elsewhere, and calls `deliver`; False: it does not."""
        self.timer = SampleTimer(0, sample_rate(spec.rate, world), world.timestep, self.publish)
        """Publishes at the steps at which a sample is due."""
        self.state: PublisherState = PublisherState(self.timer.state)

    @property
    def n_frames(self) -> int:
        """The images published."""
        return self.state.n_frames

    @property
    def last(self) -> npt.NDArray[np.uint8] | None:
        """The pixels of the last image published; read-only."""
        return self.state.last

    @property
    def sha256(self) -> str:
        """Hash of all pixels published so far, in order."""
        return self._digest.hexdigest()

    def publish(self) -> None:
        """Take the sample that is due and publish it."""
        self.camera.state.n_images = (self.camera.n_images or 0) + 1
        time, bus = self._world.time, self._world.bus
        if bus.has_readers(self._info_topic):
            self._publish_info(self.camera.info(time))
        if not bus.has_readers(self.image_topic):
            self.camera.skip()
            return
        if self._blank is not None:
            self.deliver(image(self._blank, time=time, frame_id=self.camera.frame_id))
        elif self.elsewhere is not None and self.elsewhere(self, time):
            self.camera.skip()
        else:
            self.deliver(self.camera.sample(time))

    def deliver(self, message: Image) -> None:
        """Publish an image of the camera."""
        if self._blank is None:
            self._digest.update(message.data.data)
        self.state.n_frames += 1
        self._publish_image(message)
        self.state.last = pixels_of(message)
