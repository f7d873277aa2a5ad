"""``net-inspection`` and ``net-inspection-fixed``: along a net, looking for holes with a camera.

Both move sideways along the net at two depths, with the bow to it, and report the holes in their
navigation frame (`uwsim.algorithms.navigation`). ``net-inspection`` measures distance and direction
of the net with a sonar, keeps the distance, and turns its bow to the net. ``net-inspection-fixed``
assumes that the net is due north at the distance that it was told.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ...base.geometry import Array, Intrinsics, Pose
from ...base.numerics.linear import rotate_back
from ...bus import Node
from ...messages import (
    CameraInfo,
    Image,
    LaserScan,
    PointCloud2,
    Twist,
    TwistStamped,
    Vector3,
    header,
    pixels_of,
    point_cloud,
)
from ..navigation import NavigationSpec, Navigator
from ..parametric import ParametricAlgorithm, start_benchmark
from .hole_chart import HoleChart
from .hole_detector import HoleDetector
from .net_plane import NetPlane, fit_net

ARRIVAL = 0.2
"""The distance from the end of a track, or from its depth, at which the next begins [m]."""
MIN_RANGE = 0.3
"""The smallest range of a hit of the sonar [m]."""


class NetInspection(ParametricAlgorithm):
    """An inspection of a net at a distance that a sonar measures."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "width": 5.1,
        "first_depth": 2.3,
        "second_depth": 3.7,
        "distance": 1.6,
        "speed": 0.25,
        "mesh_side": 0.1,
        "threshold": 2.5,
        "min_radius": 0.085,
        "max_radius": 0.4,
        "merge_distance": 0.4,
        "min_sightings": 4.0,
        "kp": 0.5,
        "ki": 0.3,
        "turn_gain": 0.8,
        "limit": 0.6,
        "camera_x": 0.21,
        "sonar_x": 0.2,
        "image_topic": "/bluerov2/camera",
        "info_topic": "/bluerov2/camera_info",
        "sonar_topic": "/bluerov2/sonar",
        "imu_topic": "/bluerov2/imu",
        "dvl_topic": "/bluerov2/dvl",
        "depth_topic": "/bluerov2/pressure",
        "twist_topic": "/bluerov2/twist",
        "report_topic": "/holes",
    }
    """The length of the tracks and their two depths [m]; the ``distance`` of the base from the net
    [m]; the ``speed`` [m/s]; the numbers of `HoleDetector` and `HoleChart`; the gains of distance
    and depth ``kp`` [1/s], of the velocity error ``ki`` [1/s] and of the heading [1/s]; the
    greatest commanded velocity [m/s]; the places of camera and sonar forward of the base [m]; the
    topics."""

    def start(self, node: Node) -> None:
        """Read the parameters, connect to topics, and start the benchmark."""
        self._read_parameters(node.parameters)
        self._node = node
        self._detector: HoleDetector | None = None
        self._plane: NetPlane | None = None
        min_sightings = round(self._number("min_sightings"))
        self._chart = HoleChart(self._number("merge_distance"), min_sightings)
        width, depths = self._number("width"), ("first_depth", "second_depth")
        upper, lower = (self._number(name) for name in depths)
        self._goals = [(width, upper), (width, lower), (0.0, lower)]  # east, depth [m]
        self._integral = np.zeros(2)  # of the velocity error, base axes [m]
        self._time: float | None = None
        topics = {name: self._text(name) for name in ("imu_topic", "dvl_topic", "depth_topic")}
        self._navigator = Navigator(node, topics, NavigationSpec(dvl_place=(-0.1, 0.0, 0.12)))
        self._publish_twist = node.publisher(self._text("twist_topic"), TwistStamped)
        self._publish_report = node.publisher(self._text("report_topic"), PointCloud2)
        node.subscribe(self._text("info_topic"), CameraInfo, self._on_info)
        node.subscribe(self._text("image_topic"), Image, self._on_image)
        node.subscribe(self._text("sonar_topic"), LaserScan, self._on_scan)
        start_benchmark(node)

    def measure_net(self, scan: LaserScan) -> NetPlane | None:
        """Return the plane of the net from a scan; None if too few beams hit it."""
        ranges = np.asarray(scan.ranges, dtype=np.float64)
        angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
        is_hit = (ranges < 0.999 * scan.range_max) & (ranges > MIN_RANGE)
        ranges, angles = ranges[is_hit], angles[is_hit]
        forward = ranges * np.cos(angles) + self._number("sonar_x")
        return fit_net(np.stack([forward, ranges * np.sin(angles)], axis=1))

    def _on_info(self, message: CameraInfo) -> None:
        if self._detector is None:
            fx, skew, cx, _, fy, cy = np.asarray(message.k).ravel()[:6].tolist()
            names = ("mesh_side", "threshold", "min_radius", "max_radius")
            self._detector = HoleDetector(
                intrinsics=Intrinsics(
                    width=message.width,
                    height=message.height,
                    fx=fx,
                    fy=fy,
                    cx=cx,
                    cy=cy,
                    skew=skew,
                ),
                **{name: self._number(name) for name in names},
            )

    def _on_image(self, message: Image) -> None:
        if self._detector is None or self._plane is None or not self._navigator.is_ready:
            return
        distance = self._plane.distance - self._number("camera_x")
        for gap in self._detector.detect(pixels_of(message), max(0.3, distance)):
            self._chart.add(self._place_of(gap.u, gap.v, self._plane, self._navigator.pose))
        self._publish_report(point_cloud(self._chart.places(), time=self._node.now))

    def _place_of(self, u: float, v: float, plane: NetPlane, pose: Pose) -> Array:
        """Return the place on the net that a pixel sees, in the navigation frame, (3,) [m]."""
        assert self._detector is not None
        lens = self._detector.intrinsics
        right, down = (u - lens.cx) / lens.fx, (v - lens.cy) / lens.fy
        camera_x = self._number("camera_x")
        depth = (plane.distance - camera_x) / (1.0 - plane.slope * right)
        places = np.array([[camera_x + depth, depth * right, depth * down]])  # base axes
        place: Array = pose.transform(places)[0]
        return place

    def _on_scan(self, message: LaserScan) -> None:
        dt = 0.0 if self._time is None else self._node.now - self._time
        self._time = self._node.now
        self._plane = self.measure_net(message) or self._plane
        if self._navigator.is_ready and self._plane is not None:
            self._steer(self._navigator.pose, self._plane, dt)

    def _steer(self, pose: Pose, plane: NetPlane, dt: float) -> None:
        """Command the velocity towards the next goal, and along the net."""
        east, depth = float(pose.position[1]), float(pose.position[2])
        while self._goals and math.dist(self._goals[0], (east, depth)) < ARRIVAL:
            self._goals.pop(0)
        sideways, rise = 0.0, 0.0
        if self._goals:
            goal_east, goal_depth = self._goals[0]
            speed, kp = self._number("speed"), self._number("kp")
            sideways = min(speed, max(-speed, kp * (goal_east - east)))
            rise = min(speed, max(-speed, kp * (goal_depth - depth)))
        approach = self._number("kp") * (plane.distance - self._number("distance"))
        velocity = np.array([min(0.2, max(-0.2, approach)) + plane.slope * sideways, sideways])
        true_velocity = rotate_back(pose.rotation, self._navigator.velocity)[:2]
        limit = self._number("limit")
        self._integral += self._number("ki") * dt * (velocity - true_velocity)
        self._integral = np.clip(self._integral, -limit, limit)
        x, y = np.clip(velocity + self._integral, -limit, limit).tolist()
        turn = -self._number("turn_gain") * math.atan(plane.slope)
        twist = Twist(linear=Vector3(x=x, y=y, z=rise), angular=Vector3(x=0.0, y=0.0, z=turn))
        self._publish_twist(TwistStamped(header=header(self._node.now), twist=twist))


class NetInspectionFixed(NetInspection):
    """An inspection that assumes a net due north, at a distance that it does not measure."""

    def measure_net(self, scan: LaserScan) -> NetPlane | None:
        """Return the assumed plane, whose distance is that at the start less the way to north."""
        if not self._navigator.is_ready:
            return None
        pose = self._navigator.pose
        heading = math.atan2(pose.rotation[1, 0], pose.rotation[0, 0])
        distance = (self._number("distance") - float(pose.position[0])) / math.cos(heading)
        return NetPlane(distance, math.tan(heading))
