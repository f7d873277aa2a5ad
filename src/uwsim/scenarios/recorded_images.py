"""The recording of a scenario: images of the mission, depth images, and the truth of each image.

Depth and truth are computed from the base scene at the pose of the vehicle at each image's time, so
the fog of a level has the range of each pixel, and trackers are scored on real images. Not
modelled: motion of objects, and errors of the poses, of the camera's place and of the base scene.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..base.terminal import warn
from ..benchmark.ground_truth import CORNERS, CornersFromCameraSpec
from ..errors import AssetError, BadSetting, UnknownName
from ..messages import CameraInfo, CompressedImage, Image
from ..messages.build import NANOSECONDS, label_image, time_from_seconds
from ..middleware.recording import BagReader
from ..middleware.recording.mcap_file import McapFile
from ..middleware.types import wire_type
from ..physics.compile_scene import compile_scene
from ..scene.spec import SceneSpec
from ..simulation import Simulation
from ..virtual_sensors import follow_log, make_followed_scene
from ..virtual_sensors.received_images import decode_image
from .mission import Mission
from .request import ScenarioRequest
from .scenario_scene import IMAGE_TOPIC, INFO_TOPIC

RECORDING_FILE, TRUTH_FILE = "recording.mcap", "truth.csv"
"""The names of the recording and of the table of truths."""
DEPTH_TOPIC = "/depth"
"""The topic of the depth images in the recording."""
TRUTH_TOPIC = "truth/corners"
"""The topic on which the truth is published."""
MAX_IMAGES = 36_000
"""The greatest number of images."""
MAX_BYTES = 4 * 2**30
"""The greatest size of all images before compression [bytes]."""
IMAGE_DELAY = 1_000_000
"""The time by which an image follows its depth and CameraInfo in the recording [ns]."""
MAX_DEPTH = 65.0
"""The greatest depth that depth images store [m]."""
FOCAL_TOLERANCE = 0.01
"""The difference of focal lengths above which a warning is printed, relative [1]."""


@dataclass(frozen=True, kw_only=True)
class RecordedImages:
    """The images of a recording between two times."""

    topic: str
    """The topic of the images."""
    info_topic: str
    """The topic of the CameraInfo; empty: the recording has none."""
    times: tuple[float, ...]
    """The times of the images in the log [s]."""


def find_images(request: ScenarioRequest) -> RecordedImages:
    """Return the images of a log within the mission.

    Raises:
        UnknownName: the log has no such topic.
        BadSetting: the topic carries no images, or has too few or too many.
        AssetError: the log is no recording.
    """
    end = math.inf if request.end is None else request.end
    topic = f"/{request.images.strip('/')}"
    with BagReader(request.log) as reader:
        if topic not in reader.topics:
            raise UnknownName(f"topic in {request.log.name}", topic, reader.topics)
        if reader.topics[topic] not in (Image, CompressedImage):
            raise BadSetting(f"--images {topic}: the topic carries no images.")
        infos = [name for name, kind in reader.topics.items() if kind is CameraInfo]
        times: list[float] = []
        n_bytes = 0
        for time, _, message in reader.messages([topic]):
            if not request.start <= time <= end:
                continue
            times.append(time)
            n_bytes += len(message.data)
            if len(times) > MAX_IMAGES or n_bytes > MAX_BYTES:
                raise BadSetting(
                    f"--images {topic}: more than {MAX_IMAGES} images or "
                    f"{MAX_BYTES / 2**30:g} GiB; --from and --to choose a part of the log."
                )
    if len(times) < 2 or times[-1] <= times[0]:
        raise BadSetting(
            f"--images {topic}: {len(times)} images are in the mission; expected two or more at "
            "different times."
        )
    return RecordedImages(topic=topic, info_topic=_choose_info(topic, infos), times=tuple(times))


def _choose_info(topic: str, infos: list[str]) -> str:
    """Return the topic of CameraInfo beside a topic of images; empty if it is not clear."""
    name = topic.removesuffix("/compressed")
    candidates = (f"{name}_info", f"{name.rpartition('/')[0]}/camera_info", f"{name}/camera_info")
    for candidate in candidates:
        if candidate in infos:
            return candidate
    return infos[0] if len(infos) == 1 else ""


def write_recording(
    folder: Path,
    request: ScenarioRequest,
    scene: SceneSpec,
    images: RecordedImages,
    mission: Mission,
    *,
    vehicle: str,
    camera: str,
) -> float:
    """Write the recording, and the truth if there is a target.

    Args:
        folder: the folder of the scenario.
        request: the request.
        scene: the base scene with its drawn variations.
        images: the images.
        mission: the motion of the vehicle.
        vehicle: the name of the vehicle.
        camera: the name of the camera.

    Returns:
        The median range of the surfaces in the images [m].
    """
    model = compile_scene(
        make_followed_scene(scene, vehicle), seed=request.seed, data_path=request.folders
    )
    with Simulation(model) as simulation:
        writer = _Writer(simulation, folder, images, mission, camera, request)
        try:
            writer.write(vehicle)
        except BaseException:
            writer.file.discard()
            raise
        writer.file.close()
    if request.target is not None:
        text = "\n".join([f"time [s],{','.join(f'{name} [px]' for name in CORNERS)}", *writer.rows])
        (folder / TRUTH_FILE).write_text(text + "\n", encoding="utf-8")
    return float(np.median(writer.ranges)) if writer.ranges else 1.0


class _Writer:
    """The writer of the recording of a scenario."""

    def __init__(
        self,
        simulation: Simulation,
        folder: Path,
        images: RecordedImages,
        mission: Mission,
        camera: str,
        request: ScenarioRequest,
    ) -> None:
        world = simulation.world
        self._simulation, self._images, self._mission = simulation, images, mission
        self._request = request
        self._camera, self._scenery = world.sensors.camera(camera), world.scenery
        self._truth = None
        if request.target is not None:
            truth_spec = CornersFromCameraSpec(camera=camera, target=request.target)
            self._truth = truth_spec.bind(world.measure_view, truth="face")
        self.file = McapFile(folder / RECORDING_FILE)
        self.rows: list[str] = []
        self.ranges: list[float] = []
        self._has_checked_info = False

    def write(self, vehicle: str) -> None:
        """Write all images with their depth and CameraInfo."""
        track = self._mission.make_track(self._request)
        follow_log(self._simulation, vehicle, track)
        device = next(d for d in self._simulation.world.devices if hasattr(d, "follow"))
        first_time = self._images.times[0]
        for time, info, message in self._read_frames():
            device.animate(time - self._mission.start)
            since_first = time - first_time
            self._write_frame(round(since_first * NANOSECONDS), time, info, message)
            if self._truth is not None:
                corners = self._truth.read()
                cells = [""] * len(CORNERS) if corners is None else map(repr, corners.tolist())
                self.rows.append(",".join([repr(since_first), *cells]))

    def _read_frames(self) -> Iterator[tuple[float, CameraInfo | None, Any]]:
        """Yield the time, the newest CameraInfo and the message of each image."""
        images, info = self._images, None
        topics = [images.topic, *([images.info_topic] if images.info_topic else [])]
        last_time = -math.inf
        with BagReader(self._request.log) as reader:
            for time, topic, message in reader.messages(topics):
                if topic == images.info_topic:
                    info = message
                    self._check_info(message)
                elif images.times[0] <= time <= images.times[-1] and time > last_time:
                    last_time = time
                    yield time, info, message

    def _check_info(self, info: CameraInfo) -> None:
        """Warn once if the focal length of the real camera is not that of the scene."""
        if self._has_checked_info:
            return
        self._has_checked_info = True
        focal_length, expected = float(info.k[0]), self._camera.intrinsics.fx
        if abs(focal_length / expected - 1.0) > FOCAL_TOLERANCE:
            warn(
                f"the recorded camera has fx = {focal_length:.1f} px, {self._camera.name} of the "
                f"scene {expected:.1f} px; depth and truth are those of the scene"
            )

    def _write_frame(self, start: int, time: float, info: CameraInfo | None, message: Any) -> None:
        lens = self._camera.intrinsics
        pixels = decode_image(message)
        if pixels.shape[:2] != (lens.height, lens.width):
            raise BadSetting(
                f"An image has {pixels.shape[1]}x{pixels.shape[0]} pixels; {self._camera.name} of "
                f"the scene has {lens.width}x{lens.height}."
            )
        depth = self._scenery.depth(self._camera.world_from_camera, lens)
        is_known = depth <= MAX_DEPTH
        millimetres = np.rint(np.where(is_known, depth, 0.0) * 1000.0).astype(np.uint16)
        if is_known.any():
            self.ranges.append(float(np.median((depth * lens.ray_lengths)[is_known])))
        stamp = start / NANOSECONDS
        self._write(DEPTH_TOPIC, start, label_image(millimetres, time=stamp))
        if info is None:
            info = self._camera.info(stamp)
        header = replace(message.header, stamp=time_from_seconds(stamp))
        self._write(
            INFO_TOPIC, start, replace(info, header=replace(info.header, stamp=header.stamp))
        )
        self._write(IMAGE_TOPIC, start + IMAGE_DELAY, replace(message, header=header))

    def _write(self, topic: str, time: int, message: object) -> None:
        message_type: type = type(message)
        kind = wire_type(message_type)
        if kind is None:
            raise AssetError(f"{topic}: its messages have no definition.")
        self.file.write(topic, kind, time, message)
