"""``pipe-camera`` and ``pipe-camera-p``: follow a pipe that they see with a camera.

`line_detector` finds the pipe in each image, and the law of `guidance` follows it. Without a line
in the image, as over a buried stretch, the vehicle moves straight on. The altitude is that of a
range sensor that looks down.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ...base.geometry import Array, Intrinsics
from ...bus import Node
from ...messages import (
    CameraInfo,
    Image,
    Range,
    TwistStamped,
    pixels_of,
)
from ..parametric import ParametricAlgorithm, start_benchmark, velocity_command
from .guidance import GuidanceGains, LineGuidance
from .line_detector import DetectedLine, LineDetector
from .observed_line import GAINS

AHEAD_DISTANCE = 1.0
"""The distance ahead of the base to the point to which the bow turns [m]."""

STRAIGHT_ON = DetectedLine(0.0, 0.0, 0.0)
"""The line that is followed while none is in the image: ahead of the vehicle."""


class PipeCamera(ParametricAlgorithm):
    """A guidance along a pipe that is detected in camera images."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **GAINS,
        "altitude": 1.25,
        "tilt": 0.75,
        "width": 0.25,
        "threshold": 4.0,
        "min_share": 0.3,
        "tolerance": 0.12,
        "camera_x": 0.21,
        "camera_z": 0.02,
        "altimeter_z": 0.12,
        "pipe_height": 0.1,
        "image_topic": "/bluerov2/camera",
        "info_topic": "/bluerov2/camera_info",
        "altitude_topic": "/bluerov2/altitude",
        "twist_topic": "/bluerov2/twist",
    }
    """The gains, the desired ``altitude`` of the base [m], the numbers of the detector
    (`LineDetector`), the places of camera and altimeter in base axes [m], the height of the pipe's
    sides above the ground [m], and the topics."""

    def __init__(self) -> None:
        super().__init__()
        self._detector: LineDetector | None = None
        self._altitude: float | None = None  # of the base above the ground [m]
        self._time: float | None = None

    def start(self, node: Node) -> None:
        """Read the parameters, connect to topics, and start the benchmark."""
        self._read_parameters(node.parameters)
        self._node = node
        gains = GuidanceGains(**{name: self._number(name) for name in GAINS})
        self._guidance = LineGuidance(gains)
        self._publish = node.publisher(str(self._parameters["twist_topic"]), TwistStamped)
        node.subscribe(str(self._parameters["info_topic"]), CameraInfo, self._on_info)
        node.subscribe(str(self._parameters["altitude_topic"]), Range, self._on_altitude)
        node.subscribe(str(self._parameters["image_topic"]), Image, self._on_image)
        start_benchmark(node)

    def choose_line(self, line: DetectedLine | None) -> DetectedLine | None:
        """Return the line to follow: the detected one; None: straight on."""
        return line

    def _on_info(self, message: CameraInfo) -> None:
        if self._detector is None:
            fx, skew, cx, _, fy, cy = np.asarray(message.k).ravel()[:6].tolist()
            intrinsics = Intrinsics(
                width=message.width, height=message.height, fx=fx, fy=fy, cx=cx, cy=cy, skew=skew
            )
            names = ("tilt", "width", "threshold", "min_share", "tolerance")
            numbers = {name: self._number(name) for name in names}
            self._detector = LineDetector(intrinsics=intrinsics, **numbers)

    def _on_altitude(self, message: Range) -> None:
        if math.isfinite(message.range):
            self._altitude = message.range + self._number("altimeter_z")

    def _on_image(self, message: Image) -> None:
        dt = 0.0 if self._time is None else self._node.now - self._time
        self._time = self._node.now
        if self._detector is None or self._altitude is None:
            return
        height = self._altitude - self._number("camera_z") - self._number("pipe_height")
        line = self.choose_line(self._detector.detect(pixels_of(message), height))
        velocity, turn_rate = self._command(line or STRAIGHT_ON, dt)
        self._publish(velocity_command(velocity, turn_rate, time=self._node.now))

    def _command(self, line: DetectedLine, dt: float) -> tuple[Array, float]:
        """Return the velocity (3,) [m/s] and the turn rate [rad/s] towards a line."""
        assert self._altitude is not None
        offset = line.offset - line.slope * self._number("camera_x")  # abeam of the base
        square = 1.0 + line.slope * line.slope
        direction = np.array([1.0, line.slope, 0.0]) / math.sqrt(square)
        rise = self._altitude - self._number("altitude")
        error = np.array([-line.slope * offset / square, offset / square, rise])
        target = np.array([AHEAD_DISTANCE, offset + line.slope * AHEAD_DISTANCE, 0.0])
        return self._guidance.command(error, direction, target, dt)


class PipeCameraProportional(PipeCamera):
    """``pipe-camera`` without integral action: a current shifts the vehicle off the pipe."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**PipeCamera.PARAMETERS, "ki": 0.0}
    """The parameters of `PipeCamera`, with ``ki`` 0."""
