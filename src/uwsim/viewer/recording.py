"""A recorded trial as an MCAP file of ROS 2 messages, with shapes for 3-D panels.

The topics of the file:

* ``/tf``: the pose of every body of the motion track in the frame ``world`` (W, z up), at 30 Hz
* ``/scene``: the shapes of all bodies as markers that are locked to these frames, once
* ``/robot_description``: the URDF file of the first vehicle, once
* ``/measures/NAME``: the samples of the measure's log
* ``/level``: the label of each level at its beginning
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
from .film.trial_scene import TrialScene
from .recorded import RecordedTrial
from .shapes import SCENE_TOPIC, shape_markers

SUFFIX = ".mcap"
WORLD = "world"
"""The name of the world frame W."""
Message = tuple[float, str, Any]
"""A message: time [s], topic, content."""


def check_recording_path(path: Path, *, overwrite: bool) -> None:
    """Reject a path that cannot be written; raise BadSetting."""
    if path.is_dir():
        raise BadSetting(f"-o {path}: the path is a folder; expected a file.")
    if path.exists() and not overwrite:
        raise BadSetting(f"-o {path}: the file exists; --overwrite replaces it.")


def write_recording(
    trial: RecordedTrial, path: Path, on_frame: Callable[[], object] = lambda: None
) -> int:
    """Write a trial as an MCAP file; equal trials give equal bytes.

    Args:
        trial: the trial.
        path: the path of the file.
        on_frame: the callback after each row of the motion track.

    Returns:
        The number of messages.
    """
    scene = TrialScene(trial)
    try:
        n = 0
        scene.show_time(0.0)
        file = McapFile(path)
        with name_file_in_errors(path), finish_or_discard(file):
            messages = [
                (0.0, f"/{SCENE_TOPIC}", _shapes(scene.simulation)),
                *_other_messages(trial, scene.simulation),
            ]
            queue = deque(sorted(messages, key=lambda message_row: message_row[0]))
            for time, message in _transforms(trial):
                while queue and queue[0][0] <= time:
                    n += _write_message(file, *queue.popleft())
                n += _write_message(file, time, "/tf", message)
                on_frame()
            for message_row in queue:
                n += _write_message(file, *message_row)
        return n
    finally:
        scene.close()


@contextmanager
def finish_or_discard(file: McapFile) -> Iterator[None]:
    """Finish a file, or discard it after an error."""
    try:
        yield
        file.close()
    except BaseException:
        file.discard()
        raise


def _write_message(file: McapFile, time: float, topic: str, message: Any) -> int:
    message_type: type = type(message)
    ros_type = wire_type(message_type)
    assert ros_type is not None
    file.write(topic, ros_type, round(time * NANOSECONDS), message)
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


def _other_messages(trial: RecordedTrial, simulation: Simulation) -> Iterator[Message]:
    robots = simulation.world.model.robots
    if robots and (file := Path(robots[0].path)).is_file():
        yield 0.0, "/robot_description", String(data=file.read_text(encoding="utf-8"))
    for level in trial.levels:
        yield level.start_time, "/level", String(data=level.label)
        for curve in level.curves:
            for time, value in zip(curve.times.tolist(), curve.values.tolist(), strict=True):
                if np.isfinite(value):
                    yield time, f"/measures/{curve.measure}", Float64(data=value)


def _shapes(simulation: Simulation) -> MarkerArray:
    """Return the shapes of moving bodies in the bodies' frames, and other shapes in W."""
    bodies = TrackedBodies(simulation.world)
    rows = bodies.rows()

    def frame_of(part: Part) -> tuple[str, Array]:
        body = bodies.body_number(part)
        if body is None:
            return WORLD, np.eye(4)
        world_from_body = Pose(rows[body, :3], rotation_from_quaternion(rows[body, 3:]))
        return bodies.names[body], world_from_body.inverse().matrix

    return shape_markers(simulation, frame_of)
