"""Missions of an autopilot of MAVLink: it holds a place, or drives along a path.

The autopilot is the algorithm under test; the mission only arms it and sends it setpoints, over the
topics of a ``<u:mavlink>`` (`uwsim.devices.mavlink`). All of it follows simulation time.
"""

from __future__ import annotations

import abc
import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import ClassVar

import numpy as np

from ..base.geometry import Array
from ..base.numerics.linear import length
from ..bus import Node
from ..errors import BadSetting, UnknownName
from ..messages import (
    Bool,
    Empty,
    Float64MultiArray,
    Point,
    Pose,
    PoseStamped,
    Quaternion,
    String,
    Twist,
    TwistStamped,
    Vector3,
    header,
)
from .tracker_node import merge_parameters

PERIOD = 0.1
"""The time between two setpoints [s]."""
RETRY_PERIOD = 1.0
"""The time between two commands of the mode, or of arming [s]."""
N_STICKS = 6
"""The number of sticks, all of which rest."""
MAX_POINTS = 1000
"""The greatest number of points of a path."""
MISSION_PARAMETERS: Mapping[str, float | str] = {
    "autopilot": "bluerov2/autopilot",
    "first_mode": "ALT_HOLD",
    "mode": "GUIDED",
    "settling_time": 5.0,
    "start": "startBench",
    "estimate_time": 60.0,
}
"""The parameters of all missions: the name of the ``<u:mavlink>``, the mode in which it is armed,
the mode of the mission, the time from then to the call of the services of ``start`` [s], and the
longest time for which the mission waits for the autopilot's estimate of its position [s]."""


class AutopilotMission(abc.ABC):
    """The base of missions: modes, arming, setpoints and the start of the benchmark.

    Nothing is commanded before the autopilot estimates its position, because it refuses modes and
    arming until then; without an estimate, they are tried after ``estimate_time``.

    The pilot's sticks are sent at rest from the first report on, because ArduSub's failsafe disarms
    a vehicle without a pilot. Modes and arming are commanded again every second until the autopilot
    reports them; if it disarms itself later, it is not armed again.
    """

    PARAMETERS: ClassVar[Mapping[str, float | str]] = MISSION_PARAMETERS
    """The parameters with their defaults."""

    def start(self, node: Node) -> None:
        """Subscribe to the reports of the autopilot, and start the timer."""
        self._node = node
        self.parameters = merge_parameters(self.PARAMETERS, node.parameters)
        name = str(self.parameters["autopilot"])
        self._mode, self._is_armed = "", False
        self._has_estimate = False
        self._command_time = -math.inf  # of the last mode or arming [s]
        self._begin_time = math.inf  # of the mission [s]
        self._publish_mode = node.publisher(f"{name}/mode", String)
        self._publish_arm = node.publisher(f"{name}/arm", Bool)
        self._publish_sticks = node.publisher(f"{name}/sticks", Float64MultiArray)
        self._publish_position = node.publisher(f"{name}/setpoint_position", PoseStamped)
        self._publish_velocity = node.publisher(f"{name}/setpoint_velocity", TwistStamped)
        node.subscribe(f"{name}/flight_mode", String, self._on_mode)
        node.subscribe(f"{name}/is_armed", Bool, self._on_armed)
        node.subscribe(f"{name}/estimate", PoseStamped, self._on_estimate)
        node.create_timer(PERIOD, self._on_timer)

    @abc.abstractmethod
    def setpoint(self, time: float) -> tuple[Array, Array, float]:
        """Return the setpoint at a time after the start of the benchmark [s].

        A position without a velocity would be a waypoint, for which ArduSub plans a new path from
        rest at every message.

        Returns:
            The position in L (3,) [m], the velocity in the axes of L (3,) [m/s], and the heading
            about the z axis of L [rad].
        """

    def _on_mode(self, message: String) -> None:
        self._mode = message.data

    def _on_armed(self, message: Bool) -> None:
        self._is_armed = bool(message.data)

    def _on_estimate(self, message: PoseStamped) -> None:
        self._has_estimate = True

    def _on_timer(self) -> None:
        now = self._node.now
        if self._begin_time == math.inf:
            is_ready = self._has_estimate or now > float(self.parameters["estimate_time"])
            if self._mode and now - self._command_time >= RETRY_PERIOD:
                self._command_time = now
                self._publish_sticks(Float64MultiArray(data=np.zeros(N_STICKS)))
                if is_ready:
                    self._prepare(now)
            if self._begin_time == math.inf:
                return
        time = now - self._begin_time - float(self.parameters["settling_time"])
        self._publish_setpoint(now, max(0.0, time))
        if time >= 0.0:
            for service in str(self.parameters["start"]).split():
                with suppress(UnknownName):  # the benchmark does not wait for it now
                    self._node.call(service, Empty())

    def _prepare(self, now: float) -> None:
        """Command the next of: first mode, arming, mode; begin when all of them are reported."""
        mode, first_mode = (str(self.parameters[key]).upper() for key in ("mode", "first_mode"))
        if not self._is_armed:
            if self._mode != first_mode:
                self._publish_mode(String(data=first_mode))
            else:
                self._publish_arm(Bool(data=True))
        elif self._mode != mode:
            self._publish_mode(String(data=mode))
        else:
            self._begin_time = now

    def _publish_setpoint(self, now: float, time: float) -> None:
        position, velocity, yaw = self.setpoint(time)
        twist = Twist(linear=Vector3(*velocity.tolist()), angular=Vector3(0.0, 0.0, 0.0))
        self._publish_velocity(TwistStamped(header=header(now), twist=twist))
        orientation = Quaternion(0.0, 0.0, math.sin(0.5 * yaw), math.cos(0.5 * yaw))
        pose = Pose(Point(*position.tolist()), orientation)
        self._publish_position(PoseStamped(header=header(now), pose=pose))


class AutopilotStation(AutopilotMission):
    """An autopilot that holds a place: GUIDED with one position, armed by the mission.

    ``position`` is the place in L, x y z [m], and ``yaw`` the heading about the z axis of L [rad].
    """

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **MISSION_PARAMETERS,
        "position": "0 0 1.5",
        "yaw": "0",
    }
    """The parameters with their defaults."""

    @classmethod
    def check_parameters(cls, parameters: Mapping[str, float | str]) -> None:
        """Raise BadSetting for a position that is not three numbers, or a yaw that is none."""
        settings = {**cls.PARAMETERS, **parameters}
        read_numbers("position", str(settings["position"]), 3)
        read_numbers("yaw", str(settings["yaw"]), 1)

    def start(self, node: Node) -> None:
        """Read the place, and prepare the autopilot."""
        super().start(node)
        self._position = read_numbers("position", str(self.parameters["position"]), 3)
        self._yaw = float(read_numbers("yaw", str(self.parameters["yaw"]), 1)[0])

    def setpoint(self, time: float) -> tuple[Array, Array, float]:
        """Return the place, with no velocity."""
        return self._position, np.zeros(3), self._yaw


class AutopilotPath(AutopilotMission):
    """An autopilot that drives along a closed path at a constant speed, by default a square of 1 m.

    ``path`` is a list of points in L, x y z [m]. The setpoint moves along it at ``speed`` [m/s],
    with its velocity, ``laps`` times from its first to its last point, where it stays. ``yaw`` is
    the heading about the z axis of L [rad].
    """

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **MISSION_PARAMETERS,
        "path": "0 0 1.5 1 0 1.5 1 1 1.5 0 1 1.5 0 0 1.5",
        "speed": 0.15,
        "laps": 1.0,
        "yaw": "0",
    }
    """The parameters with their defaults."""

    @classmethod
    def check_parameters(cls, parameters: Mapping[str, float | str]) -> None:
        """Raise BadSetting for a path without two points, or a yaw that is no number."""
        settings = {**cls.PARAMETERS, **parameters}
        read_path(str(settings["path"]))
        read_numbers("yaw", str(settings["yaw"]), 1)

    def start(self, node: Node) -> None:
        """Read the path, and prepare the autopilot."""
        super().start(node)
        self._points = read_path(str(self.parameters["path"]))
        self._lengths = [length(edge) for edge in np.diff(self._points, axis=0)]
        self._yaw = float(read_numbers("yaw", str(self.parameters["yaw"]), 1)[0])

    def setpoint(self, time: float) -> tuple[Array, Array, float]:
        """Return the point that moves along the path, or its last point after the last lap."""
        speed = float(self.parameters["speed"])
        distance = speed * time
        if distance >= float(self.parameters["laps"]) * sum(self._lengths):
            return self._points[-1], np.zeros(3), self._yaw
        distance %= sum(self._lengths)
        for k, edge_length in enumerate(self._lengths):
            if distance < edge_length or k == len(self._lengths) - 1:
                break
            distance -= edge_length
        direction = (self._points[k + 1] - self._points[k]) / self._lengths[k]
        velocity = (speed if time > 0.0 else 0.0) * direction
        return self._points[k] + distance * direction, velocity, self._yaw


def read_numbers(name: str, text: str, count: int) -> Array:
    """Return the finite numbers of a text, (count,); raise BadSetting if it has others."""
    try:
        values = np.array([float(word) for word in text.split()])
    except ValueError:
        values = np.full(1, math.nan)
    if len(values) != count or not np.isfinite(values).all():
        kind = "a number" if count == 1 else f"{count} numbers"
        raise BadSetting(f"Parameter {name!r} is {text[:60]!r}; expected {kind}.")
    return values


def read_path(text: str) -> Array:
    """Return the points of a path, (n, 3) [m]; raise BadSetting if it is invalid.

    Neighbouring points must differ.
    """
    count = len(text.split())
    if count % 3 or not 2 <= count // 3 <= MAX_POINTS:
        raise BadSetting(f"Parameter 'path' has {count} numbers; expected x y z, 2 points or more.")
    points = read_numbers("path", text, count).reshape(-1, 3)
    edges: Sequence[float] = [length(edge) for edge in np.diff(points, axis=0)]
    if min(edges) < 1e-6:
        raise BadSetting("Parameter 'path' has two equal points that follow each other.")
    return points
