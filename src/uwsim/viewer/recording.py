"""A recorded trial as an MCAP file of ROS 2 messages, with bodies that 3-D panels show.

``/tf`` has every body of the motion track in ``world`` (W, z up), 30 times a second; ``/scene`` the
shapes, once: markers that are locked to these frames; ``/robot_description`` the first vehicle's
URDF file, once; ``/measures/NAME`` the samples of each log; ``/level`` the label of each level.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from ..base.geometry import Array, Pose, rotation_from_quaternion
from ..errors import BadSetting, name_file_in_errors
from ..messages import Float64, MarkerArray, String, TFMessage
from ..messages.build import NANOSECONDS, transform
from ..middleware.recording.mcap_file import McapFile
from ..middleware.types import wire_type
from ..model.parts import Part
from ..simulation import Simulation
from ..simulation.tracked_bodies import TrackedBodies
from .film.puppets import Puppets
from .recorded import RecordedTrial
from .shapes import SCENE, shapes

SUFFIX = ".mcap"
WORLD = "world"
"""Frame of W."""
Message = tuple[float, str, Any]
"""Time [s], topic, message."""


def check_recording_path(path: Path, *, overwrite: bool) -> None:
    """Refuse a path that cannot be written; raises BadSetting."""
    if path.is_dir():
        raise BadSetting(f"-o {path}: is a folder.")
    if path.exists() and not overwrite:
        raise BadSetting(f"-o {path}: exists; --overwrite replaces it.")


def write_recording(
    trial: RecordedTrial, path: Path, on_frame: Callable[[], object] = lambda: None
) -> int:
    """Write a trial as an MCAP file, with the same bytes for the same trial.

    Args:
        trial: the one.
        path: of the file.
        on_frame: called after each row of the motion track.

    Returns:
        The number of messages.
    """
    puppets = Puppets(trial)
    try:
        n = 0
        puppets.put(0.0)
        file = McapFile(path)
        with name_file_in_errors(path), whole_or_nothing(file):
            messages = [
                (0.0, f"/{SCENE}", _shapes(puppets.simulation)),
                *_about(trial, puppets.simulation),
            ]
            waiting = deque(sorted(messages, key=lambda each: each[0]))
            for time, message in _transforms(trial):
                while waiting and waiting[0][0] <= time:
                    n += _write(file, *waiting.popleft())
                n += _write(file, time, "/tf", message)
                on_frame()
            for each in waiting:
                n += _write(file, *each)
        return n
    finally:
        puppets.close()


@contextmanager
def whole_or_nothing(file: McapFile) -> Iterator[None]:
    """Finish a file, or leave nothing of it after an error."""
    try:
        yield
        file.close()
    except BaseException:
        file.discard()
        raise


def _write(file: McapFile, time: float, topic: str, message: Any) -> int:
    own: type = type(message)
    kind = wire_type(own)
    assert kind is not None
    file.write(topic, kind, round(time * NANOSECONDS), message)
    return 1


def _transforms(trial: RecordedTrial) -> Iterator[tuple[float, TFMessage]]:
    track = trial.track
    for frame in range(track.n_frames):
        time = frame / track.rate
        poses = [Pose(row[:3], rotation_from_quaternion(row[3:])) for row in track.poses[frame]]
        names = zip(track.bodies, poses, strict=True)
        yield (
            time,
            TFMessage(transforms=[transform(WORLD, name, pose, time) for name, pose in names]),
        )


def _about(trial: RecordedTrial, simulation: Simulation) -> Iterator[Message]:
    """What is not motion: the robot, the levels, the measures."""
    robots = simulation.world.model.robots
    if robots and (file := Path(robots[0].path)).is_file():
        yield 0.0, "/robot_description", String(data=file.read_text(encoding="utf-8"))
    for level in trial.levels:
        yield level.began, "/level", String(data=level.label)
        for curve in level.curves:
            for time, value in zip(curve.times.tolist(), curve.values.tolist(), strict=True):
                if np.isfinite(value):
                    yield time, f"/measures/{curve.measure}", Float64(data=value)


def _shapes(simulation: Simulation) -> MarkerArray:
    """The shapes in the frames of their bodies; what stands still in W."""
    bodies = TrackedBodies(simulation.world)
    rows = bodies.rows()

    def frame_of(part: Part) -> tuple[str, Array]:
        body = bodies.body_of(part)
        if body is None:
            return WORLD, np.eye(4)
        here = Pose(rows[body, :3], rotation_from_quaternion(rows[body, 3:]))
        return bodies.names[body], here.inverse().matrix

    return shapes(simulation, frame_of)
