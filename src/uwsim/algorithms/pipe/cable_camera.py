"""``cable-camera``: follows a cable with a camera, and remembers where it lies where it is buried.

It is ``pipe-camera`` for a thin cable. With ``memory`` above 0, the line that was seen last is
carried along by the velocity of a DVL and the turn rate of an IMU: over a buried stretch the
vehicle follows this line. A detected line far from the remembered one is taken for another one.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ...bus import Node
from ...messages import DVL, Imu
from .camera_line import PipeCamera
from .line_detector import DetectedLine
from .line_memory import LineMemory


class CableCamera(PipeCamera):
    """A guidance along a cable that is seen by a camera, and remembered where it is buried."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **PipeCamera.PARAMETERS,
        "altitude": 1.05,
        "width": 0.1,
        "pipe_height": 0.05,
        "memory": 6.0,
        "gate": 0.6,
        "dvl_topic": "/bluerov2/dvl",
        "imu_topic": "/bluerov2/imu",
    }
    """The parameters of ``pipe-camera``; the distance for which a line is remembered, ``memory``
    [m]; the greatest distance of a detected line from the remembered one, ``gate`` [m]; topics."""

    def start(self, node: Node) -> None:
        """Connect to the topics of the motion sensors, and start as ``pipe-camera`` does."""
        self._turn_rate = 0.0  # [rad/s]
        self._ping_time: float | None = None  # [s]
        super().start(node)
        self._memory = LineMemory(self._number("camera_x"))
        node.subscribe(str(self._parameters["imu_topic"]), Imu, self._on_imu)
        node.subscribe(str(self._parameters["dvl_topic"]), DVL, self._on_dvl)

    def choose_line(self, line: DetectedLine | None) -> DetectedLine | None:
        """Return the line to follow: the detected one, or else the remembered one."""
        remembered_line = self._memory.line
        if self._memory.distance >= self._number("memory"):
            remembered_line = None
        if line is not None and remembered_line is not None:
            is_other_line = abs(line.offset - remembered_line.offset) > self._number("gate")
            line = None if is_other_line else line
        if line is None:
            return remembered_line
        self._memory.see(line)
        return line

    def _on_imu(self, message: Imu) -> None:
        self._turn_rate = message.angular_velocity.z

    def _on_dvl(self, message: DVL) -> None:
        dt = 0.0 if self._ping_time is None else self._node.now - self._ping_time
        self._ping_time = self._node.now
        if message.bs_status == "A":
            velocity = message.bs_longitudinal, message.bs_transverse
            self._memory.move(velocity, self._turn_rate, dt)


class CableNoMemory(CableCamera):
    """``cable-camera`` without a memory: it moves straight on where it sees no cable."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**CableCamera.PARAMETERS, "memory": 0.0}
    """The parameters of ``cable-camera``."""
