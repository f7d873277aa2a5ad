"""Transforms between chosen frames, as ``tf2_web_republisher`` publishes them.

Viewers in browsers ask for the transforms that they need by the service ``/republish_tfs``, and get
them on a topic of their own (``tf2_web_republisher/TFArray``, whose fields are those of
``tf2_msgs/TFMessage``); or by a goal of the action ``/tf2_web_republisher``, which is roslibjs's
default, and get them as its feedback. Transforms
follow the tree of ``/tf`` and ``/tf_static``; the newest of each frame counts, without
interpolation in time.
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
SOURCES = ("tf", "tf_static")
"""The topics that transforms are read from."""
ACTION = "tf2_web_republisher"
GOAL, CANCEL, FEEDBACK = (f"{ACTION}/{name}" for name in ("goal", "cancel", "feedback"))
"""Topics of the action."""
ACTION_TOPICS = frozenset({GOAL, CANCEL, FEEDBACK, f"{ACTION}/status", f"{ACTION}/result"})
PREFIX = f"{ACTION}/tf_repub_"
MAX_FRAMES = 200
"""Most frames of a request."""
MAX_REQUESTS = 200
"""Most requests at one time."""
MAX_DEPTH = 100
"""Most frames between a frame and the root of its tree."""
MIN_RATE, MAX_RATE = 0.1, 100.0
"""Limits of a requested rate [Hz]."""


@dataclass(eq=False)
class Republication:
    """One request: which transforms are published on which topic."""

    topic: str
    """Its topic, without a leading slash."""
    target: str
    """The frame in which poses are given."""
    sources: tuple[str, ...]
    """The frames whose poses are given."""
    period: float
    """Time between two messages [s]."""
    angle: float
    """Least rotation after which a pose is published again [rad]."""
    distance: float
    """Least translation after which a pose is published again [m]."""
    goal: str = ""
    """The id of its goal; empty if the service was called."""
    due: float = -math.inf
    """Time of the next message [s]."""
    sent: dict[str, Pose] = field(default_factory=dict)
    """Source frame -> the pose that was published last."""


class FrameRepublisher:
    """Keeps the newest transforms and makes the messages that are due."""

    def __init__(self) -> None:
        self._frames: dict[str, tuple[str, Pose]] = {}
        self._requests: dict[str, Republication] = {}
        self._n_requests = 0

    def request(self, arguments: Any, goal: str = "") -> Republication:
        """Accept a request; of an action with the id of its goal.

        Raises:
            BadMessage: a value is missing or out of range, or there are too many requests.
        """
        found = arguments if isinstance(arguments, dict) else {}
        sources, target = found.get("source_frames"), found.get("target_frame")
        if not isinstance(sources, list) or not all(isinstance(each, str) for each in sources):
            raise BadMessage("republish_tfs: source_frames is no list of names.")
        if not isinstance(target, str) or not target.strip("/ "):
            raise BadMessage("republish_tfs: target_frame is no name.")
        if len(sources) > MAX_FRAMES or len(self._requests) >= MAX_REQUESTS:
            raise BadMessage(
                f"republish_tfs: at most {MAX_FRAMES} frames and {MAX_REQUESTS} requests."
            )
        rate = read_number(found.get("rate")) or 10.0
        made = Republication(
            topic=f"{PREFIX}{self._n_requests}",
            goal=goal,
            target=_frame(target),
            sources=tuple(dict.fromkeys(map(_frame, sources))),
            period=1.0 / min(max(rate, MIN_RATE), MAX_RATE),
            angle=max(read_number(found.get("angular_thres")) or 0.0, 0.0),
            distance=max(read_number(found.get("trans_thres")) or 0.0, 0.0),
        )
        self._n_requests += 1
        self._requests = {**self._requests, made.topic: made}
        return made

    def withdraw(self, topic: str) -> None:
        """End a request."""
        self._requests = {name: one for name, one in self._requests.items() if name != topic}

    def goal_topic(self, goal: str) -> str | None:
        """Return the topic of the request with a goal; None if there is none."""
        return next((name for name, one in self._requests.items() if one.goal == goal), None)

    def take(self, message: TFMessage) -> None:
        """Take the transforms of a message of ``/tf`` or ``/tf_static``."""
        for each in message.transforms:
            position = read_position(each.transform.translation)
            quaternion = read_quaternion(each.transform.rotation)
            if position is not None and quaternion is not None:
                pose = Pose.from_quaternion(position, quaternion)
                self._frames[_frame(each.child_frame_id)] = _frame(each.header.frame_id), pose

    def due(self, time: float) -> list[tuple[Republication, TFMessage]]:
        """Return the requests that are due at a time [s], with their messages."""
        found = []
        for request in self._requests.values():
            if time < request.due:
                continue
            request.due = time + request.period
            transforms = [
                transform(request.target, source, pose, time)
                for source in request.sources
                if (pose := self._moved(request, source)) is not None
            ]
            if transforms:
                found.append((request, TFMessage(transforms=transforms)))
        return found

    def _moved(self, request: Republication, source: str) -> Pose | None:
        """The pose of a source frame in the target frame; None if unknown or not moved."""
        root_from_target, root_from_source = self._in_root(request.target), self._in_root(source)
        if root_from_target is None or root_from_source is None:
            return None
        if root_from_target[0] != root_from_source[0]:
            return None
        pose = root_from_target[1].inverse() @ root_from_source[1]
        last = request.sent.get(source)
        if last is not None and (request.angle > 0.0 or request.distance > 0.0):
            last_from_source = last.inverse()
            step = last_from_source @ pose
            turn = 2.0 * math.acos(min(1.0, abs(float(step.quaternion[0]))))
            if length(step.position) < request.distance and turn < request.angle:
                return None
        request.sent[source] = pose
        return pose

    def _in_root(self, frame: str) -> tuple[str, Pose] | None:
        """The root of a frame's tree and the frame's pose in it; None in a loop."""
        pose = Pose.identity()
        for _ in range(MAX_DEPTH):
            if frame not in self._frames:
                return frame, pose
            parent, parent_from_frame = self._frames[frame]
            frame, pose = parent, parent_from_frame @ pose
        return None


def feedback(goal: str) -> Callable[[dict[str, Any]], dict[str, Any]]:
    """Return a function that puts the fields of a TFMessage into the feedback for a goal."""
    status = {"goal_id": {"stamp": {"sec": 0, "nanosec": 0}, "id": goal}, "status": 1, "text": ""}
    return lambda fields: {"header": {}, "status": status, "feedback": fields}


def _frame(name: str) -> str:
    return name.strip().strip("/")
