"""Images of a virtual camera on a topic, at a rate, and only when somebody reads them."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from ..bus import Bus
from ..messages import CameraInfo, Image, image
from ..scene.ros_interfaces import VirtualCameraToROSImageSpec
from ..sensors.virtual_camera import VirtualCamera


def sample_step(n: int, rate: float, timestep: float) -> int:
    """Step at which sample ``n`` of a sensor with ``rate`` [Hz] is taken (DESIGN 4)."""
    return math.ceil(n / (rate * timestep) - 1e-9)


class SampleTimer:
    """Calls something at the samples of a rate."""

    def __init__(self, start: int, rate: float, timestep: float, call: Callable[[], None]) -> None:
        self._start, self._rate, self._timestep, self._call = start, rate, timestep, call
        self._n_samples = 0
        self._due = start  # step of the next sample

    def tick(self, step: int) -> None:
        """Call it, if its step has come."""
        if step >= self._due:
            self._n_samples += 1
            self._due = self._start + sample_step(self._n_samples, self._rate, self._timestep)
            self._call()


class ImagePublisher:
    """One ``<VirtualCameraToROSImage>`` at work.

    A sample that nobody reads is not drawn, but takes its turn in the camera's random stream: the
    pictures do not depend on who is listening. A blind one publishes black images, for algorithms
    that do not look at them.
    """

    def __init__(
        self,
        spec: VirtualCameraToROSImageSpec,
        camera: VirtualCamera,
        bus: Bus,
        timestep: float,
        *,
        is_blind: bool = False,
    ) -> None:
        self.camera = camera
        """The camera whose images these are."""
        camera.n_pictures = camera.n_pictures or 0
        self.n_frames = 0
        """Images published."""
        self.last: npt.NDArray[np.uint8] | None = None
        """The pixels of the last image published; read-only."""
        self._bus = bus
        self._timestep = timestep
        self._rate = float(spec.rate)
        self._image_topic, self._info_topic = spec.image_topic, spec.info_topic
        shape = (camera.intrinsics.height, camera.intrinsics.width)
        black = np.zeros(shape if camera.is_grey else (*shape, 3), dtype=np.uint8)
        self._blank = black if is_blind else None
        self._publish_image = bus.publisher(spec.image_topic, Image)
        self._publish_info = bus.publisher(spec.info_topic, CameraInfo)
        self._n_samples = 0
        self.due = 0
        """Step of the next sample."""
        self._digest = hashlib.sha256()

    @property
    def sha256(self) -> str:
        """Hash of all pixels published so far, in order."""
        return self._digest.hexdigest()

    def publish(self) -> None:
        """Take the sample that is due and publish it."""
        self._n_samples += 1
        self.camera.n_pictures = (self.camera.n_pictures or 0) + 1
        self.due = sample_step(self._n_samples, self._rate, self._timestep)
        time = self._bus.step * self._timestep
        if self._bus.has_readers(self._info_topic):
            self._publish_info(self.camera.info(time))
        if not self._bus.has_readers(self._image_topic):
            self.camera.skip()
            return
        if self._blank is None:
            pixels = self.camera.shoot()
            self._digest.update(np.ascontiguousarray(pixels).data)
        else:
            pixels = self._blank
        self.last = pixels
        self.n_frames += 1
        self._publish_image(image(pixels, time=time, frame_id=self.camera.frame_id))
