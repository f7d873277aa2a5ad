"""A live view of one simulation: it looks between steps, and hands copies to the server.

What it shows depends on the wall clock; the simulation does not: nothing is written to it, unless
a viewer puts everything back where it began.
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
from ...simulation.markers.lines import described, looks_of
from ...simulation.tracked_state import TrackedState
from ...simulation.views import FIELD, view_from_pose
from .audience import MAX_SIDE, Audience
from .head import head_of
from .heard_topics import HeardTopics
from .readings import Readings
from .server import LiveServer, Message

RATE = 30.0
"""Rows a second of the wall clock [Hz]."""
PROMPT = 0.01
"""A row goes out so long after an input has changed, when its vehicle has begun to move [s]."""
MOVED = ("engine", "scenery", "devices", "vehicles")
"""What of a world goes back to its beginning at a reset."""
IMAGE_RATE = 10.0
"""Images a second of the wall clock [Hz]."""
READING_RATE = 5.0
"""Sets of readings, and messages of each topic, a second of the wall clock [Hz]."""
SAMPLE_RATE = 2.0
"""Batches of samples a second of the wall clock [Hz]."""
N_BATCHES = 600
"""Batches of samples that are kept for whoever comes later."""
QUALITY = 85
"""Of JPEG images, 0..100."""
HEADER = struct.Struct("<BBHId")
ROW, IMAGE, VIEW, SAND = 1, 2, 3, 4
"""Kinds of binary messages (`uwsim.viewer.head`)."""


class LiveView:
    """What viewers see of a simulation.

    Args:
        simulation: the one, at step 0.
        server: to whom it is handed.
        audience: what viewers have asked for.
        title: of the page.
        vehicle: number of the vehicle whose readings are shown.
        resets: whether viewers may put vehicles and objects back where they began.
        wall: returns the wall time [s].
    """

    def __init__(
        self,
        simulation: Simulation,
        server: LiveServer,
        audience: Audience,
        *,
        title: str,
        vehicle: int,
        resets: bool,
        wall: Callable[[], float],
    ) -> None:
        self._simulation, self._server, self._wall = simulation, server, wall
        self._audience = audience
        self._state = TrackedState(simulation.world)
        self._measures: Sequence[TriggeredMeasure] = ()
        self._taken: dict[str, int] = {}
        self._levels: list[dict[str, Any]] = []
        self._markers: dict[str, Marker] = {}  # those sent last
        self._sand = [heap.version for heap in simulation.world.scenery.heaps]  # sent last
        self._n_batches = 0
        self._due = {"row": 0.0, "images": 0.0, "samples": 0.0, "readings": 0.0}
        self._prompt = math.inf  # when a row that follows an input is due
        self._first = copy_fields(simulation.state, MOVED if resets else ())
        self._readings = Readings(simulation, vehicle)
        self._topics = HeardTopics(simulation.bus, lambda: simulation.time, wall)
        head = head_of(simulation, title, self._state)
        server.publish("head", HEADER.pack(0, 0, 0, 0, 0.0) + head)

    def begin_level(self, level: Level, measures: Sequence[TriggeredMeasure]) -> None:
        """A level is measured from now on."""
        self._measures, self._taken = measures, {}
        values = dict(level.values)
        label = ", ".join(f"{name} {value:g}" for name, value in values.items())
        now = self._simulation.time
        self._levels.append(
            {"label": label, "status": "running", "why": "", "start": now, "end": now}
            | {"values": values}
        )
        self._server.publish("levels", json.dumps({"type": "levels", "levels": self._levels}))

    def end_level(self, row: LevelRow) -> None:
        """A level is over."""
        self._send_samples()
        self._measures = ()
        why = row.missing.get("total", "")
        self._levels[-1] |= {"status": row.status, "why": why, "end": row.ended_at}
        self._server.publish("levels", json.dumps({"type": "levels", "levels": self._levels}))

    def reset(self) -> None:
        """Put vehicles, joints and objects back where they began, at rest; time goes on."""
        assign_fields(self._simulation.state, self._first)
        self._simulation.world.scenery.redraw()
        self.follow(0.0)

    def follow(self, delay: float = PROMPT) -> None:
        """Send a row soon, after ``delay`` [s of wall time]: an input has changed."""
        self._prompt = min(self._prompt, self._wall() + delay)

    def close(self) -> None:
        """Listen to nothing more; the simulation is about to be closed."""
        self._topics.close()

    def hand_over(self, *, is_paused: bool = False) -> None:
        """Hand over what is due at this wall time."""
        now = self._wall()
        if now >= self._prompt:
            self._prompt, self._due["row"] = math.inf, now
        if self._is_due("row", now, RATE):
            row = self._state.row().astype("<f4").tobytes()
            self._server.publish("row", self._header(ROW, 0) + row)
        if self._is_due("samples", now, SAMPLE_RATE):
            self._send_samples()
            self._send_markers()
            self._send_sand()
        if self._is_due("readings", now, READING_RATE):
            self._send_readings(now, is_paused=is_paused)
        if self._is_due("images", now, IMAGE_RATE):
            self._send_images()
            self._send_views()
            # where drawing takes long, the simulation goes on between one image and the next
            rest = self._wall() + 0.5 / IMAGE_RATE
            self._due["images"] = max(self._due["images"], rest)

    def _is_due(self, what: str, now: float, rate: float) -> bool:
        if now < self._due[what]:
            return False
        self._due[what] = max(self._due[what] + 1.0 / rate, now)
        return True

    def _header(self, kind: int, index: int) -> bytes:
        return HEADER.pack(
            kind, index, 0, self._simulation.step & 0xFFFFFFFF, self._simulation.time
        )

    def _send_samples(self) -> None:
        """Send the samples of all logs since the last time."""
        if not self._measures:
            return
        began = self._levels[-1]["start"]
        samples: list[tuple[str, str, float, float | None]] = []
        for triggered in self._measures:
            name, unit = triggered.spec.name, triggered.measure.unit
            first = self._taken.get(name, 0)
            samples += [
                (name, unit, began + (each[0] or 0.0), each[1]) for each in triggered.log[first:]
            ]
            self._taken[name] = len(triggered.log)
        if samples:
            text = json.dumps({"type": "samples", "samples": samples})
            self._server.publish(f"samples/{self._n_batches}", text)
            gone = f"samples/{self._n_batches - N_BATCHES}"
            self._server.forget(lambda channel: channel == gone)
            self._n_batches += 1

    def _send_readings(self, now: float, *, is_paused: bool) -> None:
        """Send the state of the piloted vehicle, and news of topics that pages ask for."""
        found = self._readings.take(now, is_paused=is_paused)
        message = {"type": "readings", "time": self._simulation.time, "readings": found}
        self._server.publish("readings", json.dumps(message))
        if (topics := self._topics.list_changed()) is not None:
            self._server.publish("topics", topics)
        for channel, news in self._topics.news(self._server.wanted()).items():
            self._server.publish(channel, news)

    def _send_markers(self) -> None:
        """Send the markers that programs have spawned, when they have changed."""
        world = self._simulation.world
        shown = world.markers.shown
        if list(map(id, shown.values())) == list(map(id, self._markers.values())):
            return
        self._markers = shown
        markers = described(looks_of(shown, world.model.scene.world_from_localized))
        self._server.publish("markers", json.dumps({"type": "markers", "markers": markers}))

    def _send_sand(self) -> None:
        """Send the heaps of sand that have changed."""
        for number, heap in enumerate(self._simulation.world.scenery.heaps):
            if heap.version != self._sand[number]:
                self._sand[number] = heap.version
                content = self._header(SAND, number) + heap.heights.astype("<f4").tobytes()
                self._server.publish(f"sand/{number}", content)

    def _send_images(self) -> None:
        """Send what cameras have published; of those that nobody reads what they would see."""
        wanted = self._server.wanted()
        world = self._simulation.world
        for index, name in enumerate(world.sensors.cameras):
            if (channel := f"?image/{name}") in wanted:
                image = self._image(name, self._audience.width)
                self._server.publish(channel, self._header(IMAGE, index) + jpeg(image))

    def _image(self, camera: str, width: int = MAX_SIDE) -> npt.NDArray[np.uint8]:
        """Return what a camera sees, ``width`` wide at most."""
        world = self._simulation.world
        view = world.sensors.camera(camera)
        lens = view.intrinsics
        size = width, max(1, round(width * lens.height / lens.width))
        is_smaller = width < lens.width
        for images in self._simulation.world.images.values():
            if images.camera.name == camera and images.last_pixels is not None:
                seen = images.last_pixels
                if is_smaller:
                    seen = cv2.resize(seen, size, interpolation=cv2.INTER_AREA).astype(np.uint8)
                return seen
        if is_smaller:  # what nobody will see is not drawn
            lens = lens.with_size(*size)
        colour = world.scenery.render_clean(
            view.world_from_camera, lens, targets={"colour"}, is_polished=view.is_polished
        ).colour
        assert colour is not None
        pixels = colour.view(np.uint8)
        return grey_truncated(pixels) if view.is_grey else pixels

    def _send_views(self) -> None:
        """Draw the newest view that a page without WebGL asks for."""
        asked = self._audience.view
        if asked is None:
            return
        camera = asked.get("camera")
        if isinstance(camera, str) and camera in self._simulation.world.sensors.cameras:
            image = self._image(camera)
        else:
            try:
                view = view_from_pose(*_asked_for(asked))
            except BadSetting:
                return
            scenery = self._simulation.world.scenery
            colour = scenery.render_view(
                view.world_from_camera, view.intrinsics, targets={"colour"}, fog=0.0
            ).colour
            assert colour is not None
            image = colour.view(np.uint8)
        self._server.publish("view", self._header(VIEW, 0) + jpeg(image))


def jpeg(image: npt.NDArray[np.uint8]) -> bytes:
    """Return an image, (h, w, 3) or (h, w), as JPEG."""
    ordered = image if image.ndim == 2 else image[..., ::-1]
    _, packed = cv2.imencode(
        ".jpg", np.ascontiguousarray(ordered), [cv2.IMWRITE_JPEG_QUALITY, QUALITY]
    )
    return bytes(packed.tobytes())


def _asked_for(message: Message) -> tuple[Pose, tuple[int, int], float]:
    """Read pose, size and vertical field of a view; raises BadSetting where they are none."""
    pose, size = message.get("pose"), (message.get("width"), message.get("height"))
    field = message.get("fovy", FIELD)
    values = [*pose, *size, field] if isinstance(pose, list) and len(pose) == 7 else []
    numbers = [number for value in values if (number := read_number(value)) is not None]
    if len(numbers) != 10:
        raise BadSetting("The view has no pose of seven finite numbers, width, height and fovy.")
    rows = np.clip(np.array(numbers[:7]), -MAX_COORDINATE, MAX_COORDINATE)
    width, height, fovy = numbers[7:]
    is_valid = 16 <= width <= MAX_SIDE and 16 <= height <= MAX_SIDE and 0.01 <= fovy <= 3.1
    if not is_valid or np.linalg.norm(rows[3:]) < 1e-3:
        raise BadSetting("The size, the field or the orientation of the view is out of range.")
    where = Pose(rows[:3], rotation_from_quaternion(rows[3:]))
    return where, (int(width), int(height)), fovy
