"""``survey``, ``survey-truth`` and ``survey-no-dvl``: tracks over an area, and a map of its bottom.

All three sail the same tracks at a constant depth and publish the mean sounding of each cell of a
grid. ``survey`` knows its position from DVL, IMU and depth sensor (`uwsim.algorithms.navigation`).
``survey-truth`` is told its pose, and shows what the tracks allow. ``survey-no-dvl`` has no DVL: it
takes its velocity through the water for that over ground, and so does not notice a current.
"""

from __future__ import annotations

import abc
import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ...base.geometry import Array, Pose, rotation_from_quaternion
from ...base.numerics.linear import rotate, rotate_rows
from ...bus import Node
from ...messages import (
    Imu,
    LaserScan,
    Odometry,
    PointCloud2,
    Pressure,
    Twist,
    TwistStamped,
    Vector3,
    header,
    point_cloud,
)
from ..navigation import NavigationSpec, Navigator
from ..parametric import ParametricAlgorithm, start_benchmark
from .bottom_map import BottomMap
from .tracks import TrackGuidance, plan_tracks

MIN_RANGE = 0.3
"""The smallest range of a sounding [m]."""


class BottomSurvey(ParametricAlgorithm, abc.ABC):
    """A survey along parallel tracks; subclasses know where the vehicle is."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "length": 20.0,
        "width": 15.0,
        "spacing": 5.0,
        "margin": 2.5,
        "speed": 0.6,
        "look_ahead": 2.0,
        "depth": 11.0,
        "kz": 0.5,
        "turn_gain": 0.8,
        "limit": 1.0,
        "ki": 0.2,
        "cell": 0.5,
        "period": 5.0,
        "sonar_x": 0.1,
        "sonar_z": 0.12,
        "imu_topic": "/bluerov2/imu",
        "dvl_topic": "/bluerov2/dvl",
        "depth_topic": "/bluerov2/pressure",
        "odom_topic": "/bluerov2/odom",
        "sonar_topic": "/bluerov2/multibeam",
        "twist_topic": "/bluerov2/twist",
        "map_topic": "/map",
    }
    """The area and its tracks (`plan_tracks`) [m]; the ``speed`` [m/s]; ``look_ahead`` and
    ``depth`` [m]; the gains of depth and heading [1/s]; the greatest commanded velocity ``limit``
    [m/s]; the gain ``ki`` of the integral of the velocity error [1/s]; the ``cell`` of the map [m]
    and the ``period`` of its messages [s]; the place of the sonar in base axes [m]; the topics."""

    def start(self, node: Node) -> None:
        """Read the parameters, connect to topics, and start the benchmark."""
        self._read_parameters(node.parameters)
        self._node = node
        number = self._number
        length, width = number("length"), number("width")
        corners = plan_tracks(length, width, number("spacing"), number("margin"))
        self._guidance = TrackGuidance(corners, number("speed"), number("look_ahead"))
        self._map = BottomMap(length, width, number("cell"))
        self._integral = np.zeros(2)  # of the error of the velocity over ground, n and e [m]
        self._step_time: float | None = None
        self._map_time = node.now
        self._publish_twist = node.publisher(self._text("twist_topic"), TwistStamped)
        self._publish_map = node.publisher(self._text("map_topic"), PointCloud2)
        self._connect(node)
        node.subscribe(self._text("sonar_topic"), LaserScan, self._on_scan)
        start_benchmark(node)

    @abc.abstractmethod
    def _connect(self, node: Node) -> None:
        """Subscribe to the topics of navigation."""

    @abc.abstractmethod
    def _navigate(self, dt: float) -> tuple[Pose, Array | None] | None:
        """Return the pose in the navigation frame, and the velocity over ground; None if unknown.

        The velocity is horizontal, (2,) [m/s]; None if it is not measured.

        Args:
            dt: the time since the last call [s].
        """

    def _on_scan(self, message: LaserScan) -> None:
        dt = 0.0 if self._step_time is None else self._node.now - self._step_time
        self._step_time = self._node.now
        estimate = self._navigate(dt)
        if estimate is None:
            return
        pose, velocity = estimate
        self._map.add(self._soundings(message, pose))
        if self._node.now - self._map_time >= self._number("period"):
            self._map_time = self._node.now
            self._publish_map(point_cloud(self._map.points(), time=self._node.now))
        self._steer(pose, velocity, dt)

    def _soundings(self, scan: LaserScan, pose: Pose) -> Array:
        """Return the hits of a scan in the navigation frame, (n, 3) [m]."""
        ranges = np.asarray(scan.ranges, dtype=np.float64)
        angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
        is_hit = (ranges < 0.999 * scan.range_max) & (ranges > MIN_RANGE)
        ranges, angles = ranges[is_hit], angles[is_hit]
        base_points = np.stack(
            [
                np.full(len(ranges), self._number("sonar_x")),
                -ranges * np.sin(angles),
                ranges * np.cos(angles) + self._number("sonar_z"),
            ],
            axis=1,
        )
        points: Array = rotate_rows(pose.rotation, base_points) + pose.position
        return points

    def _steer(self, pose: Pose, velocity: Array | None, dt: float) -> None:
        desired_velocity = self._guidance.command(pose.position[:2])
        command = desired_velocity
        if velocity is not None:
            bound = self._number("limit")
            self._integral = np.clip(
                self._integral + self._number("ki") * dt * (desired_velocity - velocity),
                -bound,
                bound,
            )
            command = desired_velocity + self._integral
        heading = math.atan2(pose.rotation[1, 0], pose.rotation[0, 0])
        self.command_velocity = command  # north and east [m/s]
        cos, sin = math.cos(heading), math.sin(heading)
        x, y = cos * command[0] + sin * command[1], cos * command[1] - sin * command[0]
        limit = self._number("limit")
        x, y = (min(limit, max(-limit, value)) for value in (x, y))
        rise = self._number("kz") * (self._number("depth") - float(pose.position[2]))
        twist = Twist(
            linear=Vector3(x=x, y=y, z=min(0.4, max(-0.4, rise))),
            angular=Vector3(x=0.0, y=0.0, z=-self._number("turn_gain") * heading),
        )
        self._publish_twist(TwistStamped(header=header(self._node.now), twist=twist))


class Survey(BottomSurvey):
    """A survey whose position is dead reckoned by DVL, IMU and depth sensor."""

    def _connect(self, node: Node) -> None:
        topics = {name: self._text(name) for name in ("imu_topic", "dvl_topic", "depth_topic")}
        place = (-0.1, 0.0, 0.12)
        self._navigator = Navigator(node, topics, NavigationSpec(dvl_place=place))

    def _navigate(self, dt: float) -> tuple[Pose, Array | None] | None:
        if not self._navigator.is_ready:
            return None
        return self._navigator.pose, self._navigator.velocity[:2]


class SurveyTruth(BottomSurvey):
    """A survey that is told the pose of the vehicle: what the same tracks allow."""

    def _connect(self, node: Node) -> None:
        self._pose: Pose | None = None
        self._origin: Array | None = None
        self._velocity = np.zeros(2)
        node.subscribe(self._text("odom_topic"), Odometry, self._on_odometry)

    def _on_odometry(self, message: Odometry) -> None:
        p, q = message.pose.pose.position, message.pose.pose.orientation
        position = np.array([p.x, p.y, p.z])
        if self._origin is None:
            self._origin = np.array([p.x, p.y, 0.0])
        rotation = rotation_from_quaternion(np.array([q.w, q.x, q.y, q.z]))
        v = message.twist.twist.linear
        self._pose = Pose(position - self._origin, rotation)
        self._velocity = rotate(rotation, np.array([v.x, v.y, v.z]))[:2]

    def _navigate(self, dt: float) -> tuple[Pose, Array | None] | None:
        return None if self._pose is None else (self._pose, self._velocity)


class SurveyNoDvl(BottomSurvey):
    """A survey without a DVL, which takes its commanded velocity for that over ground."""

    def _connect(self, node: Node) -> None:
        self._rotation: Array | None = None
        self._position = np.zeros(3)
        self.command_velocity = np.zeros(2)
        node.subscribe(self._text("imu_topic"), Imu, self._on_imu)
        node.subscribe(self._text("depth_topic"), Pressure, self._on_depth)

    def _on_imu(self, message: Imu) -> None:
        q = message.orientation
        self._rotation = rotation_from_quaternion(np.array([q.w, q.x, q.y, q.z]))

    def _on_depth(self, message: Pressure) -> None:
        self._position[2] = message.pressure

    def _navigate(self, dt: float) -> tuple[Pose, Array | None] | None:
        if self._rotation is None:
            return None
        self._position[:2] += dt * self.command_velocity
        return Pose(self._position.copy(), self._rotation), None
