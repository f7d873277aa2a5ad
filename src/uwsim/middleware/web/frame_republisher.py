"""Transforms between chosen frames, as ``tf2_web_republisher`` publishes them.

A viewer in a browser requests transforms with the service ``/republish_tfs``, and receives them on
its own topic (type ``tf2_web_republisher/TFArray``, with the fields of ``tf2_msgs/TFMessage``). Or
it sends a goal of the action ``/tf2_web_republisher``, the default of roslibjs, and receives them
as feedback of the action. Transforms are computed along the tree of ``/tf`` and ``/tf_static`` from
the newest transform of each frame, without interpolation in time.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from ...base.external_values import read_number, read_position, read_quaternion
from ...base.geometry import Pose
from ...base.numerics.linear import length
from ...errors import BadMessage
from ...messages import TFMessage
from ...messages.build import transform

SERVICE = "republish_tfs"
"""The service by which clients request transforms."""
SOURCES = ("tf", "tf_static")
"""The topics from which transforms are read."""
ACTION = "tf2_web_republisher"
"""The action by which clients request transforms."""
GOAL, CANCEL, FEEDBACK = (f"{ACTION}/{name}" for name in ("goal", "cancel", "feedback"))
"""The topics of the action that are used."""
ACTION_TOPICS = frozenset({GOAL, CANCEL, FEEDBACK, f"{ACTION}/status", f"{ACTION}/result"})
"""All topics of the action."""
PREFIX = f"{ACTION}/tf_repub_"
"""The prefix of the topics on which transforms are published."""
MAX_FRAMES = 200
"""The maximum number of frames in a request."""
MAX_REQUESTS = 200
"""The maximum number of requests at one time."""
MAX_DEPTH = 100
"""The maximum number of frames on the path from a frame to the root of its tree, both included."""
MIN_RATE, MAX_RATE = 0.1, 100.0
"""The limits of a requested rate [Hz]."""


@dataclass(eq=False)
class Republication:
    """A client's request for transforms, which are published on a topic."""

    topic: str
    """The topic, without a leading slash."""
    target: str
    """The name of the frame in which poses are expressed."""
    sources: tuple[str, ...]
    """The names of the frames whose poses are published."""
    period: float
    """The time between two messages [s]."""
    angle: float
    """The minimum rotation after which a pose is published again [rad]; 0: always."""
    distance: float
    """The minimum translation after which a pose is published again [m]; 0: always."""
    goal: str = ""
    """The id of the goal; empty if the service was called."""
    next_time: float = -math.inf
    """The time of the next message [s]."""
    last_poses: dict[str, Pose] = field(default_factory=dict)
    """The pose that was published last, by source frame."""


class FrameRepublisher:
    """The newest transform of each frame, and the requests for transforms."""

    def __init__(self) -> None:
        self._frames: dict[str, tuple[str, Pose]] = {}
        self._requests: dict[str, Republication] = {}
        self._n_requests = 0

    def add_request(self, arguments: Any, goal: str = "") -> Republication:
        """Accept a request; ``goal`` is the id of an action's goal.

        Raises:
            BadMessage: ``source_frames`` or ``target_frame`` is missing or invalid, or there are
                too many frames or requests. A rate or threshold out of range is clipped.
        """
        values = arguments if isinstance(arguments, dict) else {}
        sources, target = values.get("source_frames"), values.get("target_frame")
        if not isinstance(sources, list) or not all(isinstance(name, str) for name in sources):
            raise BadMessage("republish_tfs: source_frames is not a list of names.")
        if not isinstance(target, str) or not target.strip("/ "):
            raise BadMessage("republish_tfs: target_frame is not a name.")
        if len(sources) > MAX_FRAMES or len(self._requests) >= MAX_REQUESTS:
            raise BadMessage(
                f"republish_tfs: at most {MAX_FRAMES} frames and {MAX_REQUESTS} requests."
            )
        rate = read_number(values.get("rate")) or 10.0
        republication = Republication(
            topic=f"{PREFIX}{self._n_requests}",
            goal=goal,
            target=_frame(target),
            sources=tuple(dict.fromkeys(map(_frame, sources))),
            period=1.0 / min(max(rate, MIN_RATE), MAX_RATE),
            angle=max(read_number(values.get("angular_thres")) or 0.0, 0.0),
            distance=max(read_number(values.get("trans_thres")) or 0.0, 0.0),
        )
        self._n_requests += 1
        self._requests = {**self._requests, republication.topic: republication}
        return republication

    def withdraw(self, topic: str) -> None:
        """End a request."""
        self._requests = {key: entry for key, entry in self._requests.items() if key != topic}

    def goal_topic(self, goal: str) -> str | None:
        """Return the topic of the request with a goal's id; None if there is none."""
        return next((key for key, entry in self._requests.items() if entry.goal == goal), None)

    def store(self, message: TFMessage) -> None:
        """Store the transforms of a message of ``/tf`` or ``/tf_static``."""
        for entry in message.transforms:
            position = read_position(entry.transform.translation)
            quaternion = read_quaternion(entry.transform.rotation)
            if position is not None and quaternion is not None:
                pose = Pose.from_quaternion(position, quaternion)
                self._frames[_frame(entry.child_frame_id)] = (_frame(entry.header.frame_id), pose)

    def due_messages(self, time: float) -> list[tuple[Republication, TFMessage]]:
        """Return the requests that are due at a time [s], with their messages."""
        messages = []
        for request in self._requests.values():
            if time < request.next_time:
                continue
            request.next_time = time + request.period
            transforms = [
                transform(request.target, source, pose, time)
                for source in request.sources
                if (pose := self._next_pose(request, source)) is not None
            ]
            if transforms:
                messages.append((request, TFMessage(transforms=transforms)))
        return messages

    def _next_pose(self, request: Republication, source: str) -> Pose | None:
        """Return the pose of a source frame in the target frame.

        Returns None if it is unknown, or if it has changed by less than both thresholds.
        """
        root_from_target = self._root_pose(request.target)
        root_from_source = self._root_pose(source)
        if root_from_target is None or root_from_source is None:
            return None
        if root_from_target[0] != root_from_source[0]:
            return None
        pose = root_from_target[1].inverse() @ root_from_source[1]
        last_pose = request.last_poses.get(source)
        if last_pose is not None and (request.angle > 0.0 or request.distance > 0.0):
            last_from_source = last_pose.inverse()
            step = last_from_source @ pose
            angle = 2.0 * math.acos(min(1.0, abs(float(step.quaternion[0]))))
            if length(step.position) < request.distance and angle < request.angle:
                return None
        request.last_poses[source] = pose
        return pose

    def _root_pose(self, frame: str) -> tuple[str, Pose] | None:
        """Return the root of a frame's tree, and the pose of the frame in the root.

        Returns None if the root is not among the first `MAX_DEPTH` frames, as in a loop.
        """
        pose = Pose.identity()
        for _ in range(MAX_DEPTH):
            if frame not in self._frames:
                return frame, pose
            parent, parent_from_frame = self._frames[frame]
            frame, pose = parent, parent_from_frame @ pose
        return None


def make_feedback_wrapper(goal: str) -> Callable[[dict[str, Any]], dict[str, Any]]:
    """Return a function that puts the fields of a TFMessage into the feedback for a goal."""
    status = {"goal_id": {"stamp": {"sec": 0, "nanosec": 0}, "id": goal}, "status": 1, "text": ""}
    return lambda fields: {"header": {}, "status": status, "feedback": fields}


def _frame(name: str) -> str:
    return name.strip().strip("/")
