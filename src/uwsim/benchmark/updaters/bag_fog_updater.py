r"""bagFogUpdater: fog over recorded images, to test an algorithm on real footage.

.. code-block:: xml

    <bagFogUpdater>
      <initialValue>0</initialValue> <finalValue>1</finalValue> <step>0.1</step>
      <interval>20</interval>
      <bag>dive.bag</bag> <imageTopic>camera</imageTopic> <infoTopic>camera_info</infoTopic>
      <imageDepth>2.5</imageDepth>
      <imagePub>/foggy/image</imagePub> <infoPub>/foggy/camera_info</infoPub>
      <u:depthTopic>/depth/image</u:depthTopic>
      <u:noise>0.02</u:noise>
      <u:truth> <u:file>corners.csv</u:file> <u:topic>truth/corners</u:topic> </u:truth>
    </bagFogUpdater>

The recording is replayed in an endless loop, in simulation time and with the recorded times between
images; between the last image and the first image of the next loop, the mean of these times passes.
Everything in an image is assumed to be at the distance ``imageDepth``. In fog of the density f
[1/m] and the colour g, an image c therefore becomes

.. math:: c' = c\, t + g\, (1 - t), \quad t = e^{-(f \cdot imageDepth)^2}

as in the renderer (docs/rendering.md); g is the scene's fog colour. Each image is published as
``rgb8`` or ``mono8`` together with the camera's CameraInfo; both are stamped with the time of
publication. Not modelled: attenuation, and fog that was already in the recorded water.

With ``<u:depthTopic>``, the newest depth image before each image gives the range of each pixel: its
depth times the length of the pixel's ray at a depth of 1 m, by the camera's parameters. Where the
depth is 0 or NaN, ``imageDepth`` holds.

A recorded image contains the noise of its camera, which fog would attenuate with the image.
``<u:noise>`` is the standard deviation :math:`\sigma` of that noise as a fraction of white. With it
each pixel receives the noise that is missing, N(0, :math:`\sigma^2 (1 - t^2)`), in each channel.

``<u:truth>`` names a CSV file with the ground truth of each image. Its column ``time`` is the time
since the first image of the recording [s]; the other columns are the numbers of the truth. The
numbers are interpolated linearly between lines and published with each image, for
``<groundTruth type="topic">``. The message has no numbers if a cell next to the time of the image
is empty, and before the first and after the last line.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.elementwise import exp
from ...base.numerics.linear import dot
from ...cameras.noise_words import draw_gaussians, frame_key, gaussian_quantiles
from ...errors import AssetError, AssetNotFound, BadSetting, RunFailed
from ...messages import CameraInfo, Float32MultiArray, Image, image, time_from_seconds
from ...messages.bag_camera import DecodedImage, RecordedFrame, Recording, camera_info
from ...schema import element
from ...world import Stage
from ..recorded_truth import TIME_TOLERANCE, RecordedTruth, RecordedTruthSpec
from .fog_sweep import FogSweepSpec
from .updater import SceneUpdater

ORIGINAL_COLOUR = (0.0, 0.05, 0.3)
"""The fog colour of the original UWSim, for the channels in their recorded order."""
ORIGINAL_FACTOR = 1.442695
"""The factor 1/ln 2, by which the exponent of the original UWSim is too large: its formula has
base e, but a constant for base 2."""
GREY = np.array([0.299, 0.587, 0.114])
"""The weights of red, green and blue in the brightness of grey images (ITU-R BT.601)."""


@dataclass(frozen=True, kw_only=True)
class BagFogUpdaterSpec(FogSweepSpec):
    """A ``<bagFogUpdater>`` element."""

    bag: str
    """The recording: a .bag, .mcap or .db3 file, or a folder of ROS 2 (rosbag2)."""
    image_topic: str
    """The topic of the images in the recording (sensor_msgs/Image or CompressedImage)."""
    info_topic: str
    """The topic of the camera parameters in the recording (sensor_msgs/CameraInfo)."""
    image_depth: float = element(exclusive_minimum=0.0)
    """The assumed distance of everything in the images [m]."""
    image_pub: str | None = element(default=None)
    """The topic on which images are published; None: the topic in the recording."""
    info_pub: str | None = element(default=None)
    """The topic on which camera parameters are published; None: the topic in the recording."""
    depth_topic: str = element(namespaced=True, default="")
    """The topic of depth images in the recording (sensor_msgs/Image, 32FC1 in m or 16UC1 in mm), by
    whose ranges the fog is added; empty: ``imageDepth`` holds for every pixel."""
    noise: float = element(namespaced=True, default=0.0, minimum=0.0, maximum=1.0)
    """The standard deviation of the noise of the recorded camera, as a fraction of white, which
    images in fog keep [1]."""
    truth: RecordedTruthSpec | None = element(namespaced=True, default=None)
    """The ground truth of the images."""
    path: str = field(default="", compare=False, metadata={"path": True})
    """The path of the benchmark file, in whose folder recordings are searched."""

    @property
    def topics(self) -> tuple[str, str]:
        """The topics on which images and camera parameters are published."""
        return self.image_pub or self.image_topic, self.info_pub or self.info_topic

    def find(self, stage: Stage) -> Path:
        """Return the path of the recording; raises AssetNotFound with every searched folder."""
        try:
            return stage.find(self.bag, named_by=self.path)
        except AssetNotFound as error:
            try:
                return stage.find(f"{self.bag}/metadata.yaml", named_by=self.path).parent
            except AssetNotFound:
                raise error from None

    def files(self, stage: Stage) -> Mapping[str, Path]:
        """Return the path of the recording by its name in the benchmark file."""
        return {self.bag: self.find(stage)}

    def times(self, path: Path) -> tuple[float, float]:
        """Return the times from the first image to the second, and to the recording's end [s].

        Raises:
            AssetError: the recording cannot be read, or a topic has the wrong type.
            UnknownName: a topic is not in the recording.
        """
        recording = self.open(path)
        recording.close()
        return recording.gap * 1e-9, recording.length * 1e-9

    def open(self, path: Path) -> Recording:
        """Open the recording; raises AssetError or UnknownName as `times` does."""
        return Recording(path, self.image_topic, self.info_topic, self.depth_topic)

    def bind(self, stage: Stage) -> BagFogUpdater:
        """Open the recording.

        Raises:
            AssetNotFound: the recording does not exist.
            AssetError: the recording cannot be read, or a topic has the wrong type.
            UnknownName: a topic is not in the recording.
            BadSetting: the scene publishes on one of the topics already.
        """
        path = self.find(stage)
        _, length = self.times(path)
        for tag, topic in zip(("imagePub", "infoPub"), self.topics, strict=True):
            if stage.bus.message_type(topic) is not None:
                raise BadSetting(
                    f"The scene publishes on {topic!r}; choose another topic in <{tag}>.",
                    name=topic,
                )
        truth = None
        if self.truth is not None:
            truth = self.truth.read(self.path)
            start, end = truth.span
            if end < -TIME_TOLERANCE or start > length + TIME_TOLERANCE:
                raise AssetError(
                    f"{self.truth.file}: its times, {start:.6g} s to {end:.6g} s, are outside the "
                    f"recording: 0 s to {length:.6g} s, from its first image on.",
                    name=self.truth.file,
                )
        return BagFogUpdater(stage, self, path, truth)


class BagFogUpdater(SceneUpdater):
    """An updater that replays recorded images in fog.

    The replay begins with the first level of a sequence, and continues from level to level; an
    independent level has a replay of its own. Before that, and in the prelude of an independent
    level, the first image is published repeatedly, with the time between the first two images as
    the period: a tracker takes its template from the image with which its level begins.

    Compatibility ``bag-fog``: the exponent is 1.44 times as large, the fog colour is (0, 0.05, 0.3)
    for the channels in their recorded order, and grey images do not change.
    """

    def __init__(
        self, stage: Stage, spec: BagFogUpdaterSpec, path: Path, truth: RecordedTruth | None = None
    ) -> None:
        self._stage, self._spec, self._path, self._truth = stage, spec, path, truth
        if truth is not None:
            stage.bus.hide_topic(truth.topic)
        self._has_original_fog = "bag-fog" in stage.world.compatibility
        self._image_topic, self._info_topic = spec.topics
        self._density = spec.density(spec.first_value)  # [1/m]
        self._rng = (
            stage.world.stream(f"{spec.image_topic}/fog/noise") if spec.noise > 0.0 else None
        )
        self._recording: Recording | None = None
        self._has_begun = False
        self._start_step = 0  # step at which the first image of the schedule was due
        self._schedule: Iterator[tuple[int, RecordedFrame]] = iter(())  # due times [ns], images
        self._next_frame: tuple[int, RecordedFrame] | None = None  # the step at which it is due
        self._n_frames = 0  # images published
        self._digest = hashlib.sha256()  # of the images published
        stage.create_timer(1.0 / stage.timestep, self._tick)

    def apply(self, value: float) -> None:
        """Set the fog, and start the replay in the first level."""
        self._density = self._spec.density(value)
        if not self._has_begun:
            self._has_begun = True
            self._start(self._replay())

    def ramp(self, value: float) -> None:
        """Set the fog, without starting the replay."""
        self._density = self._spec.density(value)

    @property
    def streams(self) -> tuple[tuple[str, int, str], ...]:
        """The topic, number and SHA-256 hash of the images published so far."""
        return ((self._image_topic, self._n_frames, self._digest.hexdigest()),)

    def close(self) -> None:
        """Close the recording."""
        if self._recording is not None:
            self._recording.close()
            self._recording = None

    def _open(self) -> Recording:
        if self._recording is None:
            self._recording = self._spec.open(self._path)
        return self._recording

    def _repeat_first(self) -> Iterator[tuple[int, RecordedFrame]]:
        """Yield the first image repeatedly, each time with the time at which it is due [ns]."""
        recording, n = self._open(), 0
        while True:
            yield n * recording.gap, recording.first_frame
            n += 1

    def _replay(self) -> Iterator[tuple[int, RecordedFrame]]:
        """Yield every image with the time at which it is due [ns], in an endless loop."""
        recording, loop_start = self._open(), 0
        while True:
            last_time, count = 0, 0
            for frame in recording.frames():
                last_time, count = frame.time, count + 1
                yield loop_start + last_time, frame
            loop_start += last_time + last_time // (count - 1)

    def _start(self, schedule: Iterator[tuple[int, RecordedFrame]]) -> None:
        self._start_step, self._schedule = self._stage.step, schedule
        self._advance()

    def _advance(self) -> None:
        time, frame = next(self._schedule)
        steps = math.ceil(time / (self._stage.timestep * 1e9) - 1e-9)
        self._next_frame = self._start_step + steps, frame

    def _tick(self) -> None:
        try:
            if self._next_frame is None:
                self._start(self._repeat_first())
            while self._next_frame is not None and self._stage.step >= self._next_frame[0]:
                self._publish(self._next_frame[1])
                self._advance()
        except AssetError as error:
            raise RunFailed(f"The recording broke off: {error}") from error

    def _publish(self, frame: RecordedFrame) -> None:
        if self._truth is not None:
            numbers = self._truth.find_values(frame.time * 1e-9)
            self._stage.bus.publisher(self._truth.topic, Float32MultiArray)(
                Float32MultiArray(data=numbers.astype(np.float32))
            )
        has_subscribers = self._stage.bus.has_subscribers(self._image_topic)
        if not has_subscribers and not self._stage.bus.has_subscribers(self._info_topic):
            return
        decoded_image, time = frame.decode(), self._stage.time
        stamp = time_from_seconds(time)
        info = camera_info(frame.info, stamp=stamp, frame_id=decoded_image.frame_id)
        self._stage.bus.publisher(self._info_topic, CameraInfo)(info)
        if has_subscribers:
            pixels = self._add_fog(decoded_image, frame)
            self._n_frames += 1
            self._digest.update(pixels.tobytes())
            self._stage.bus.publisher(self._image_topic, Image)(
                image(pixels, time=time, frame_id=decoded_image.frame_id)
            )

    def _add_fog(self, decoded_image: DecodedImage, frame: RecordedFrame) -> npt.NDArray[np.uint8]:
        depth = frame.decode_depth()
        if depth is not None and not self._has_original_fog:
            if depth.shape != decoded_image.pixels.shape[:2]:
                raise AssetError(
                    f"{frame.label} has {decoded_image.pixels.shape[1]}x"
                    f"{decoded_image.pixels.shape[0]} pixels, its depth image {depth.shape[1]}x"
                    f"{depth.shape[0]}."
                )
            ranges = find_ranges(depth, frame.info, self._spec.image_depth)
            return self._blend(decoded_image.pixels, ranges)
        if self._rng is not None and not self._has_original_fog:
            ranges = np.full(decoded_image.pixels.shape[:2], self._spec.image_depth)
            return self._blend(decoded_image.pixels, ranges)
        thickness = (self._density * self._spec.image_depth) ** 2
        if not self._has_original_fog:
            return add_fog(decoded_image.pixels, math.exp(-thickness), self._stage.fog_colour)
        if decoded_image.pixels.ndim == 2:
            return np.ascontiguousarray(decoded_image.pixels)
        r, g, b = ORIGINAL_COLOUR
        colour = (b, g, r) if decoded_image.is_blue_first else (r, g, b)
        return add_fog(decoded_image.pixels, math.exp(-ORIGINAL_FACTOR * thickness), colour)

    def _blend(self, pixels: npt.NDArray[np.uint8], ranges: Array) -> npt.NDArray[np.uint8]:
        """Return an image in the fog of the level, with the noise of its camera."""
        contrast = find_contrast(ranges, self._density)
        foggy_pixels = blend_fog(pixels, contrast, self._stage.fog_colour)
        if self._rng is not None:
            foggy_pixels += find_missing_noise(
                foggy_pixels.shape, contrast, self._spec.noise, frame_key(self._rng)
            )
        levels: npt.NDArray[np.uint8] = np.rint(foggy_pixels).clip(0.0, 255.0).astype(np.uint8)
        return levels


def add_fog(
    pixels: npt.NDArray[np.uint8], contrast: float, colour: tuple[float, float, float]
) -> npt.NDArray[np.uint8]:
    """Return ``pixels * contrast + colour * (1 - contrast)``, rounded to whole numbers.

    Args:
        pixels: a colour image (h, w, 3), red first, or a grey image (h, w), in which the fog has
            the brightness of ``colour``.
        contrast: the fraction of the contrast that remains, 0..1.
        colour: the red, green and blue of the fog, 0..1.
    """
    import cv2

    levels = np.arange(256.0)[:, None]
    fog_levels = 255.0 * np.array(colour)
    if pixels.ndim == 2:
        fog_levels = np.array([dot(fog_levels, GREY)])
    table = np.rint(contrast * levels + (1.0 - contrast) * fog_levels)  # (256, 3) or (256, 1)
    foggy_pixels = cv2.LUT(np.ascontiguousarray(pixels), table.astype(np.uint8)[None])
    return np.asarray(foggy_pixels, dtype=np.uint8).reshape(pixels.shape)


def find_ranges(depth: Array, info: Any, unknown_range: float) -> Array:
    """Return the ranges along the rays of the pixels of a depth image, (h, w) [m].

    Args:
        depth: the distances along the optical axis, (h, w) [m]; inf: unknown.
        info: the CameraInfo, of a class of rosbags.
        unknown_range: the range of pixels without a depth [m].
    """
    fx, _, cx, _, fy, cy = np.asarray(getattr(info, "k", getattr(info, "K", None)), float)[:6]
    is_calibrated = fx > 0.0 and fy > 0.0
    columns, rows = np.arange(depth.shape[1]), np.arange(depth.shape[0])[:, None]
    x, y = (columns - cx) / (fx if is_calibrated else 1.0), (rows - cy) / (fy or 1.0)
    lengths = np.sqrt(1.0 + x * x + y * y) if is_calibrated else np.ones(depth.shape)
    ranges: Array = np.where(np.isfinite(depth), depth * lengths, unknown_range)
    return ranges


def find_contrast(ranges: Array, density: float) -> Array:
    """Return the contrast that fog of a density [1/m] leaves at ranges [m], (h, w) from 0 to 1."""
    optical_depth = np.minimum(density * ranges, 1e3)
    return exp(-(optical_depth * optical_depth))


def blend_fog(
    pixels: npt.NDArray[np.uint8], contrast: Array, colour: tuple[float, float, float]
) -> Array:
    """Return the grey levels of pixels in fog, where a contrast (h, w) remains, as `add_fog`."""
    fog_levels = 255.0 * np.array(colour)
    if pixels.ndim == 2:
        return contrast * pixels + (1.0 - contrast) * dot(fog_levels, GREY)
    return contrast[..., None] * pixels + (1.0 - contrast[..., None]) * fog_levels


def find_missing_noise(shape: tuple[int, ...], contrast: Array, std: float, key: int) -> Array:
    """Return the noise that an image of a shape lacks in fog [grey levels].

    Args:
        shape: the shape of the image, (h, w, 3) or (h, w).
        contrast: the fraction of the recorded image, and of its noise, that remains, (h, w).
        std: the standard deviation of the recorded noise, as a fraction of white.
        key: the random key of the image.
    """
    deviations = draw_gaussians(np.uint64(key), contrast.size, gaussian_quantiles())
    levels = 255.0 * std * np.sqrt(1.0 - contrast * contrast)
    if len(shape) == 2:
        return levels * deviations[:, 0].reshape(shape)
    return levels[..., None] * deviations.reshape(shape)
