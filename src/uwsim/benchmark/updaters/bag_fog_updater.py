r"""bagFogUpdater: fog over recorded images, to test an algorithm on real footage.

.. code-block:: xml

    <bagFogUpdater>
      <initialValue>0</initialValue> <finalValue>1</finalValue> <step>0.1</step>
      <interval>20</interval>
      <bag>dive.bag</bag> <imageTopic>camera</imageTopic> <infoTopic>camera_info</infoTopic>
      <imageDepth>2.5</imageDepth>
      <imagePub>/foggy/image</imagePub> <infoPub>/foggy/camera_info</infoPub>
      <u:truth> <u:file>corners.csv</u:file> <u:topic>truth/corners</u:topic> </u:truth>
    </bagFogUpdater>

The bag is replayed in an endless loop, in simulation time and with the spacing recorded; from the
last image to the first of the next round it is the mean spacing. Everything in an image counts
as ``imageDepth`` away, so an image c in fog of density f and colour g becomes

.. math:: c' = c\, t + g\, (1 - t), \quad t = e^{-(f \cdot imageDepth)^2}

which is what the renderer does with fog (docs/rendering.md); g is the scene's fog colour. Images
are published as ``rgb8`` or ``mono8``, each with the camera's info, both stamped with the time of
publishing. Not modelled: attenuation, and fog that was in the water already.

``<u:truth>`` gives the truth of each image: a CSV file with a column ``time`` [s], which counts
from the first image of the recording, and a column for each number. Between two lines it is
interpolated linearly. It is published with each image, for ``<groundTruth type="topic">``. Where a
cell is empty on either side, before the first line and after the last, the message is empty.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ...base.numerics.linear import dot
from ...errors import AssetError, AssetNotFound, BadSetting, RunFailed
from ...messages import CameraInfo, Float32MultiArray, Image, image, time_from_seconds
from ...messages.bag_camera import DecodedImage, RecordedFrame, Recording, camera_info
from ...schema import element
from ...world import Stage
from ..recorded_truth import SAME_TIME, RecordedTruth, RecordedTruthSpec
from .fog_sweep import FogSweepSpec
from .updater import SceneUpdater

ORIGINAL_COLOUR = (0.0, 0.05, 0.3)
"""What the original puts on the three channels, whichever comes first."""
ORIGINAL_FACTOR = 1.442695
"""1/ln 2: the original has base e where the constant was made for base 2."""
GREY = np.array([0.299, 0.587, 0.114])
"""Weights of red, green and blue in grey (ITU-R BT.601)."""


@dataclass(frozen=True, kw_only=True)
class BagFogUpdaterSpec(FogSweepSpec):
    """A ``<bagFogUpdater>`` element."""

    bag: str
    """The recording: a .bag, .mcap or .db3 file, or a folder of ROS 2 (rosbag2)."""
    image_topic: str
    """Topic of the images in the recording (sensor_msgs/Image or CompressedImage)."""
    info_topic: str
    """Topic of the camera's info in the recording (sensor_msgs/CameraInfo)."""
    image_depth: float = element(above=0.0)
    """Assumed distance of everything in the images [m]."""
    image_pub: str | None = element(default=None)
    """Topic the images are published on; None: as in the recording."""
    info_pub: str | None = element(default=None)
    """Topic the camera's info is published on; None: as in the recording."""
    truth: RecordedTruthSpec | None = element(namespaced=True, default=None)
    """The truth of the images."""
    path: str = field(default="", compare=False, metadata={"path": True})
    """The benchmark file; recordings are searched next to it."""

    @property
    def topics(self) -> tuple[str, str]:
        """Where images and info are published."""
        return self.image_pub or self.image_topic, self.info_pub or self.info_topic

    def find(self, stage: Stage) -> Path:
        """Find the recording; AssetNotFound names every folder searched."""
        try:
            return stage.find(self.bag, named_by=self.path)
        except AssetNotFound as nowhere:
            try:
                return stage.find(f"{self.bag}/metadata.yaml", named_by=self.path).parent
            except AssetNotFound:
                raise nowhere from None

    def files(self, stage: Stage) -> Mapping[str, Path]:
        """Return the recording."""
        return {self.bag: self.find(stage)}

    def times(self, path: Path) -> tuple[float, float]:
        """Return the times from the first image to the next, and to the recording's end [s].

        Raises:
            AssetError: it cannot be read, or a topic has another type.
            UnknownName: a topic is not in it.
        """
        recording = Recording(path, self.image_topic, self.info_topic)
        recording.close()
        return recording.gap * 1e-9, recording.length * 1e-9

    def bind(self, stage: Stage) -> BagFogUpdater:
        """Look into the recording.

        Raises:
            AssetNotFound: it is nowhere.
            AssetError: it cannot be read, or a topic has another type.
            UnknownName: a topic is not in it.
            BadSetting: the scene publishes on such a topic already.
        """
        path = self.find(stage)
        _, length = self.times(path)
        for tag, topic in zip(("imagePub", "infoPub"), self.topics, strict=True):
            if stage.bus.message_type(topic) is not None:
                raise BadSetting(
                    f"Topic {topic!r} is the scene's already; name another in <{tag}>.", name=topic
                )
        truth = None
        if self.truth is not None:
            truth = self.truth.read(self.path)
            first, last = truth.span
            if last < -SAME_TIME or first > length + SAME_TIME:
                raise AssetError(
                    f"{self.truth.file}: its times, {first:.6g} s to {last:.6g} s, are none of the "
                    f"recording: 0 s to {length:.6g} s, from its first image on.",
                    name=self.truth.file,
                )
        return BagFogUpdater(stage, self, path, truth)


class BagFogUpdater(SceneUpdater):
    """Replays a recording in fog.

    Until the benchmark has begun, and in the prelude of an independent level, the first image
    stands, published at the spacing of the first two: a tracker takes its template from the very
    image that its level begins with. With level 1 of a sequence, or with any independent level,
    the replay begins; in a sequence it lives on from level to level.

    Compatibility ``bag-fog``: the exponent is 1.44 times as great, the colour is (0, 0.05, 0.3) on
    the channels as they were recorded, and grey images stay as they are.
    """

    def __init__(
        self, stage: Stage, spec: BagFogUpdaterSpec, path: Path, truth: RecordedTruth | None = None
    ) -> None:
        self._stage, self._spec, self._path, self._truth = stage, spec, path, truth
        if truth is not None:
            stage.bus.hide_topic(truth.topic)
        self._is_original = "bag-fog" in stage.world.compatibility
        self._image_topic, self._info_topic = spec.topics
        self._density = spec.density(spec.initial)  # [1/m]
        self._recording: Recording | None = None
        self._has_begun = False
        self._since = 0  # step at which the first image was due
        self._schedule: Iterator[tuple[int, RecordedFrame]] = iter(())
        self._next: tuple[int, RecordedFrame] | None = None  # step at which it is due, and what
        self._n_frames = 0
        self._digest = hashlib.sha256()
        stage.create_timer(1.0 / stage.timestep, self._tick)

    def apply(self, value: float) -> None:
        """Set the fog; with the first level the replay begins."""
        self._density = self._spec.density(value)
        if not self._has_begun:
            self._has_begun = True
            self._start(self._replay())

    def ramp(self, value: float) -> None:
        """Set the fog alone."""
        self._density = self._spec.density(value)

    @property
    def streams(self) -> tuple[tuple[str, int, str], ...]:
        """The images published so far."""
        return ((self._image_topic, self._n_frames, self._digest.hexdigest()),)

    def close(self) -> None:
        """Close the recording."""
        if self._recording is not None:
            self._recording.close()
            self._recording = None

    def _open(self) -> Recording:
        if self._recording is None:
            self._recording = Recording(self._path, self._spec.image_topic, self._spec.info_topic)
        return self._recording

    def _still(self) -> Iterator[tuple[int, RecordedFrame]]:
        """Yield the first image over and over, each time with when it is due [ns]."""
        recording, n = self._open(), 0
        while True:
            yield n * recording.gap, recording.first_frame
            n += 1

    def _replay(self) -> Iterator[tuple[int, RecordedFrame]]:
        """Yield every image with when it is due [ns], round after round."""
        recording, began = self._open(), 0
        while True:
            last, count = 0, 0
            for frame in recording.frames():
                last, count = frame.time, count + 1
                yield began + last, frame
            began += last + last // (count - 1)

    def _start(self, schedule: Iterator[tuple[int, RecordedFrame]]) -> None:
        self._since, self._schedule = self._stage.step, schedule
        self._advance()

    def _advance(self) -> None:
        time, frame = next(self._schedule)
        steps = math.ceil(time / (self._stage.timestep * 1e9) - 1e-9)
        self._next = self._since + steps, frame

    def _tick(self) -> None:
        try:
            if self._next is None:
                self._start(self._still())
            while self._next is not None and self._stage.step >= self._next[0]:
                self._publish(self._next[1])
                self._advance()
        except AssetError as error:
            raise RunFailed(f"The recording broke off: {error}") from error

    def _publish(self, frame: RecordedFrame) -> None:
        if self._truth is not None:
            numbers = self._truth.at(frame.time * 1e-9)
            self._stage.bus.publisher(self._truth.topic, Float32MultiArray)(
                Float32MultiArray(data=numbers.astype(np.float32))
            )
        is_seen = self._stage.bus.has_subscribers(self._image_topic)
        if not is_seen and not self._stage.bus.has_subscribers(self._info_topic):
            return
        decoded, time = frame.decode(), self._stage.time
        stamp = time_from_seconds(time)
        info = camera_info(frame.info, stamp=stamp, frame_id=decoded.frame_id)
        self._stage.bus.publisher(self._info_topic, CameraInfo)(info)
        if is_seen:
            pixels = self._fogged(decoded)
            self._n_frames += 1
            self._digest.update(pixels.tobytes())
            self._stage.bus.publisher(self._image_topic, Image)(
                image(pixels, time=time, frame_id=decoded.frame_id)
            )

    def _fogged(self, decoded: DecodedImage) -> npt.NDArray[np.uint8]:
        """Add the fog of now to an image."""
        thickness = (self._density * self._spec.image_depth) ** 2
        if not self._is_original:
            return fogged(decoded.pixels, math.exp(-thickness), self._stage.fog_colour)
        if decoded.pixels.ndim == 2:
            return np.ascontiguousarray(decoded.pixels)
        r, g, b = ORIGINAL_COLOUR
        colour = (b, g, r) if decoded.is_blue_first else (r, g, b)
        return fogged(decoded.pixels, math.exp(-ORIGINAL_FACTOR * thickness), colour)


def fogged(
    pixels: npt.NDArray[np.uint8], seen: float, colour: tuple[float, float, float]
) -> npt.NDArray[np.uint8]:
    """Return ``pixels * seen + colour * (1 - seen)``, rounded to whole numbers.

    Args:
        pixels: (h, w, 3), red first; or (h, w), whose fog is as grey as the colour.
        seen: what is left of the contrast, 0..1.
        colour: red, green and blue of the fog, 0..1.
    """
    import cv2

    stored = np.arange(256.0)[:, None]
    end = 255.0 * np.array(colour)
    if pixels.ndim == 2:
        end = np.array([dot(end, GREY)])
    table = np.rint(seen * stored + (1.0 - seen) * end).astype(np.uint8)  # (256, 3) or (256, 1)
    changed = cv2.LUT(np.ascontiguousarray(pixels), table[None])
    return np.asarray(changed, dtype=np.uint8).reshape(pixels.shape)
