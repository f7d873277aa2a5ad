"""A live view of one simulation: it reads the state between steps, and publishes copies.

The view depends on the wall clock, the simulation does not. The view changes the simulation only by
a reset that a viewer requests.
"""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Callable, Sequence
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from ...base.external_values import MAX_COORDINATE, read_number
from ...base.geometry import Pose, rotation_from_quaternion
from ...base.record import assign_fields, copy_fields
from ...benchmark.updaters import Level
from ...errors import BadSetting
from ...messages import Marker
from ...rendering.grey import grey_truncated
from ...runs.trial.level_row import LevelRow
from ...runs.trial.triggered_measure import TriggeredMeasure
from ...simulation import Simulation
from ...simulation.markers.lines import describe_markers, draw_markers
from ...simulation.tracked_state import TrackedState
from ...simulation.views import FIELD_OF_VIEW, view_from_pose
from ..pack import Blob, make_pack
from ..water import describe_medium
from .head import head_of
from .readings import Readings
from .server import LiveServer, Message
from .topic_monitor import TopicMonitor
from .viewer_requests import MAX_SIDE, ViewerRequests

RATE = 30.0
"""The rate of rows of poses and signals, in wall time [Hz]."""
INPUT_DELAY = 0.01
"""The wall time from a change of a pilot's input to the next row [s]."""
RESET_FIELDS = ("engine", "scenery", "devices", "vehicles")
"""The fields of the state that a reset restores."""
IMAGE_RATE = 10.0
"""The rate of camera images and views, in wall time [Hz]."""
READING_RATE = 5.0
"""The rate of readings, and the greatest rate of messages of a topic, in wall time [Hz]."""
SAMPLE_RATE = 2.0
"""The rate of batches of samples of measures, in wall time [Hz]."""
N_BATCHES = 600
"""The number of batches of samples that are stored for later viewers."""
JPEG_QUALITY = 85
"""The quality of JPEG images, 0..100."""
HEADER = struct.Struct("<BBHId")
"""The header of binary messages: kind, index, 0, step, simulation time [s]."""
ROW, IMAGE, VIEW, SAND, MEDIUM, SEDIMENT = 1, 2, 3, 4, 5, 6
"""The kinds of binary messages (`uwsim.viewer.head`)."""


class LiveView:
    """The view of one simulation.

    Args:
        simulation: the simulation, at step 0.
        server: the server of the pages.
        requests: the requests of viewers.
        title: the title of the page.
        vehicle: the index of the vehicle whose readings are shown.
        allows_reset: True if viewers may reset vehicles and objects.
        wall: the function that returns the wall time [s].
    """

    def __init__(
        self,
        simulation: Simulation,
        server: LiveServer,
        requests: ViewerRequests,
        *,
        title: str,
        vehicle: int,
        allows_reset: bool,
        wall: Callable[[], float],
    ) -> None:
        self._simulation, self._server, self._wall = simulation, server, wall
        self._requests = requests
        self._state = TrackedState(simulation.world)
        self._measures: Sequence[TriggeredMeasure] = ()
        self._n_sent: dict[str, int] = {}  # number of samples that were sent, by measure
        self._levels: list[dict[str, Any]] = []
        self._markers: dict[str, Marker] = {}  # the markers that were sent last
        self._sand_versions = [heap.version for heap in simulation.world.scenery.heaps]
        optics = simulation.world.scenery.state.water.physical_water
        self._medium = None if optics is None else optics.medium  # the medium that was sent last
        self._sediment_key: tuple[float, int] = (0.0, 0)  # time and births of the puffs sent last
        self._n_batches = 0
        # the wall time at which each kind of content is due [s]
        self._due = {"row": 0.0, "images": 0.0, "samples": 0.0, "readings": 0.0}
        self._early_row_time = math.inf  # the wall time of a row after an input [s]
        self._initial_state = copy_fields(simulation.state, RESET_FIELDS if allows_reset else ())
        self._readings = Readings(simulation, vehicle)
        self._topics = TopicMonitor(simulation.bus, lambda: simulation.time, wall)
        head = head_of(simulation, title, self._state)
        server.publish("head", HEADER.pack(0, 0, 0, 0, 0.0) + head)

    def begin_level(self, level: Level, measures: Sequence[TriggeredMeasure]) -> None:
        """Publish that the measurement of a level begins."""
        self._measures, self._n_sent = measures, {}
        values = dict(level.values)
        label = ", ".join(f"{name} {value:g}" for name, value in values.items())
        now = self._simulation.time
        self._levels.append(
            {"label": label, "status": "running", "why": "", "start": now, "end": now}
            | {"values": values}
        )
        self._server.publish("levels", json.dumps({"type": "levels", "levels": self._levels}))

    def end_level(self, row: LevelRow) -> None:
        """Publish that a level has ended."""
        self._send_samples()
        self._measures = ()
        reason = row.missing_reasons.get("total", "")
        self._levels[-1] |= {"status": row.status, "why": reason, "end": row.ended_at}
        self._server.publish("levels", json.dumps({"type": "levels", "levels": self._levels}))

    def reset(self) -> None:
        """Restore the initial state of vehicles, joints and objects, but not the time."""
        assign_fields(self._simulation.state, self._initial_state)
        self._simulation.world.scenery.redraw()
        self.request_row(0.0)

    def request_row(self, delay: float = INPUT_DELAY) -> None:
        """Send a row after ``delay`` [s of wall time], for example because an input has changed."""
        self._early_row_time = min(self._early_row_time, self._wall() + delay)

    def close(self) -> None:
        """End all subscriptions; the simulation is closed next."""
        self._topics.close()

    def publish_due(self, *, is_paused: bool = False) -> None:
        """Publish the contents that are due at this wall time."""
        now = self._wall()
        if now >= self._early_row_time:
            self._early_row_time, self._due["row"] = math.inf, now
        if self._is_due("row", now, RATE):
            row = self._state.row().astype("<f4").tobytes()
            self._server.publish("row", self._header(ROW, 0) + row)
            self._send_sediment()
        if self._is_due("samples", now, SAMPLE_RATE):
            self._send_samples()
            self._send_markers()
            self._send_sand()
            self._send_medium()
        if self._is_due("readings", now, READING_RATE):
            self._send_readings(now, is_paused=is_paused)
        if self._is_due("images", now, IMAGE_RATE):
            self._send_images()
            self._send_views()
            # so that the simulation proceeds between two images if rendering is slow
            earliest_time = self._wall() + 0.5 / IMAGE_RATE
            self._due["images"] = max(self._due["images"], earliest_time)

    def _is_due(self, content: str, now: float, rate: float) -> bool:
        """Return whether a kind of content is due at a wall time [s]; then schedule the next one.

        ``rate`` is the rate of this kind of content [Hz].
        """
        if now < self._due[content]:
            return False
        self._due[content] = max(self._due[content] + 1.0 / rate, now)
        return True

    def _header(self, kind: int, index: int) -> bytes:
        return HEADER.pack(
            kind, index, 0, self._simulation.step & 0xFFFFFFFF, self._simulation.time
        )

    def _send_samples(self) -> None:
        if not self._measures:
            return
        start = self._levels[-1]["start"]
        samples: list[tuple[str, str, float, float | None]] = []
        for measure in self._measures:
            name, unit = measure.spec.name, measure.measure.unit
            n_sent = self._n_sent.get(name, 0)
            samples += [(name, unit, start + (s[0] or 0.0), s[1]) for s in measure.log[n_sent:]]
            self._n_sent[name] = len(measure.log)
        if samples:
            text = json.dumps({"type": "samples", "samples": samples})
            self._server.publish(f"samples/{self._n_batches}", text)
            old_channel = f"samples/{self._n_batches - N_BATCHES}"
            self._server.remove_channels(lambda channel: channel == old_channel)
            self._n_batches += 1

    def _send_readings(self, now: float, *, is_paused: bool) -> None:
        """Send the readings of the piloted vehicle, and new messages of the requested topics."""
        readings = self._readings.read(now, is_paused=is_paused)
        message = {"type": "readings", "time": self._simulation.time, "readings": readings}
        self._server.publish("readings", json.dumps(message))
        if (topics := self._topics.changed_list()) is not None:
            self._server.publish("topics", topics)
        for channel, text in self._topics.new_messages(self._server.channels()).items():
            self._server.publish(channel, text)

    def _send_markers(self) -> None:
        world = self._simulation.world
        active_markers = world.markers.active_markers
        if list(map(id, active_markers.values())) == list(map(id, self._markers.values())):
            return
        self._markers = active_markers
        markers = describe_markers(
            draw_markers(active_markers, world.model.scene.world_from_localized)
        )
        self._server.publish("markers", json.dumps({"type": "markers", "markers": markers}))

    def _send_sand(self) -> None:
        for index, heap in enumerate(self._simulation.world.scenery.heaps):
            if heap.version != self._sand_versions[index]:
                self._sand_versions[index] = heap.version
                content = self._header(SAND, index) + heap.heights.astype("<f4").tobytes()
                self._server.publish(f"sand/{index}", content)

    def _send_sediment(self) -> None:
        """Send the puffs of sediment, if they have moved or changed."""
        particles = self._simulation.world.scenery.particles
        if particles is None or particles.sediment is None:
            return
        state = particles.sediment.puffs.state
        key = state.time, state.n_born
        if key == self._sediment_key or not (state.n_born or self._sediment_key[1]):
            return
        self._sediment_key = key
        numbers = np.concatenate([[state.time], state.puffs[: state.n_puffs].ravel()])
        content = self._header(SEDIMENT, 0) + numbers.astype("<f8").tobytes()
        self._server.publish("sediment", content)

    def _send_medium(self) -> None:
        """Send the numbers of the medium of physical water, if it is new."""
        optics = self._simulation.world.scenery.state.water.physical_water
        if optics is None or optics.medium == self._medium:
            return
        self._medium, blob = optics.medium, Blob()
        entry = describe_medium(self._simulation.world, optics.medium, blob)
        content = self._header(MEDIUM, 0) + make_pack({"optics": entry}, blob)
        self._server.publish("medium", content)

    def _send_images(self) -> None:
        """Send the requested camera images; render the images of cameras without a subscriber."""
        channels = self._server.channels()
        world = self._simulation.world
        for index, name in enumerate(world.sensors.cameras):
            if (channel := f"?image/{name}") in channels:
                image = self._image(name, self._requests.width)
                self._server.publish(channel, self._header(IMAGE, index) + encode_jpeg(image))

    def _image(self, camera: str, width: int = MAX_SIDE) -> npt.NDArray[np.uint8]:
        """Return the image of a camera with a width of at most ``width`` [px]."""
        world = self._simulation.world
        view = world.sensors.camera(camera)
        intrinsics = view.intrinsics
        size = width, max(1, round(width * intrinsics.height / intrinsics.width))
        is_smaller = width < intrinsics.width
        for images in self._simulation.world.images.values():
            if images.camera.name == camera and images.last_pixels is not None:
                image = images.last_pixels
                if is_smaller:
                    image = cv2.resize(image, size, interpolation=cv2.INTER_AREA).astype(np.uint8)
                return image
        if is_smaller:  # no more pixels than the page shows
            intrinsics = intrinsics.with_size(*size)
        colour = world.scenery.render_clean(
            view.world_from_camera, intrinsics, targets={"colour"}, is_polished=view.is_polished
        ).colour
        assert colour is not None
        pixels = colour.view(np.uint8)
        return grey_truncated(pixels) if view.is_grey else pixels

    def _send_views(self) -> None:
        """Draw and send the newest view that a page without WebGL requests."""
        request = self._requests.view
        if request is None:
            return
        camera = request.get("camera")
        if isinstance(camera, str) and camera in self._simulation.world.sensors.cameras:
            image = self._image(camera)
        else:
            try:
                view = view_from_pose(*_parse_view(request))
            except BadSetting:
                return
            scenery = self._simulation.world.scenery
            colour = scenery.render_view(
                view.world_from_camera, view.intrinsics, targets={"colour"}, fog=0.0
            ).colour
            assert colour is not None
            image = colour.view(np.uint8)
        self._server.publish("view", self._header(VIEW, 0) + encode_jpeg(image))


def encode_jpeg(image: npt.NDArray[np.uint8]) -> bytes:
    """Encode an image, (h, w, 3) or (h, w), as JPEG."""
    bgr = image if image.ndim == 2 else image[..., ::-1]
    _, buffer = cv2.imencode(
        ".jpg", np.ascontiguousarray(bgr), [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY]
    )
    return bytes(buffer.tobytes())


def _parse_view(message: Message) -> tuple[Pose, tuple[int, int], float]:
    """Return pose in W, width and height [px], vertical field of view [rad]; raise BadSetting."""
    pose, size = message.get("pose"), (message.get("width"), message.get("height"))
    fovy = message.get("fovy", FIELD_OF_VIEW)
    values = [*pose, *size, fovy] if isinstance(pose, list) and len(pose) == 7 else []
    numbers = [number for value in values if (number := read_number(value)) is not None]
    if len(numbers) != 10:
        raise BadSetting("The view has no pose of seven finite numbers, width, height and fovy.")
    rows = np.clip(np.array(numbers[:7]), -MAX_COORDINATE, MAX_COORDINATE)
    width, height, fovy = numbers[7:]
    is_valid = 16 <= width <= MAX_SIDE and 16 <= height <= MAX_SIDE and 0.01 <= fovy <= 3.1
    if not is_valid or np.linalg.norm(rows[3:]) < 1e-3:
        raise BadSetting("The size, field of view or orientation of the view is out of range.")
    world_from_camera = Pose(rows[:3], rotation_from_quaternion(rows[3:]))
    return world_from_camera, (int(width), int(height)), fovy
