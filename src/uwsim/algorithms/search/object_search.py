"""``search``, ``search-camera``, ``search-sonar`` and ``search-truth``: find an orange object.

All keep an altitude, know their position by DVL, IMU and depth sensor, and report one place in
their navigation frame (`uwsim.algorithms.navigation`). Without a place to look at they sail
parallel tracks over the area.

``search`` notes the places of echoes of an imaging sonar, goes to the nearest, and looks with a
camera that looks down; a place that the camera does not confirm is left. ``search-camera`` has no
sonar. ``search-sonar`` has no camera: it reports the first echo that it reaches. ``search-truth``
knows the place and goes there: what the motion of the vehicle allows.
"""

from __future__ import annotations

import abc
import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ...base.geometry import Array, Pose
from ...bus import Node
from ...messages import (
    CameraInfo,
    Image,
    PointCloud2,
    ProjectedSonarImage,
    TFMessage,
    TwistStamped,
    pixels_of,
    point_cloud,
)
from ..grasp import ColourDetector, Pinhole, StationController, TrackingState, View
from ..grasp.variants import TrueNavigator
from ..inspection.hole_chart import HoleChart
from ..navigation import NavigationSpec, Navigator
from ..parametric import ParametricAlgorithm, start_benchmark, velocity_command
from ..survey.tracks import TrackGuidance, plan_tracks
from .echo_detector import EchoDetector

PERIOD = 0.1
"""The time between two commands [s]."""
ARRIVAL = 0.35
"""The horizontal distance from a place at which the vehicle is there [m]."""
TURN_DISTANCE = 1.0
"""The distance from a place within which the vehicle keeps its heading [m]."""
AREA_MARGIN = 1.0
"""The distance from the area within which echoes are noted [m]."""
BASE_FROM_CAMERA: Array = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
"""The rotation of a camera that looks down, the top of its image forward, (3, 3)."""


class ObjectSearch(ParametricAlgorithm, abc.ABC):
    """A search over an area; subclasses know which places to look at, and what to report."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "length": 16.0,
        "width": 12.0,
        "spacing": 6.0,
        "speed": 0.6,
        "altitude": 1.6,
        "kp": 0.5,
        "look_ahead": 2.0,
        "imu_topic": "/bluerov2/imu",
        "dvl_topic": "/bluerov2/dvl",
        "depth_topic": "/bluerov2/pressure",
        "twist_topic": "/bluerov2/twist",
        "report_topic": "/report",
    }
    """The extents of the area to the north and to the east of the start, and the ``spacing`` of the
    tracks [m]; the ``speed`` [m/s]; the ``altitude`` [m]; the gain of the position [1/s]; the
    ``look_ahead`` distance of the tracks [m]; the topics."""

    def start(self, node: Node) -> None:
        """Read the parameters, connect to topics, and start the benchmark."""
        self._read_parameters(node.parameters)
        self._node = node
        number = self._number
        spacing, speed = number("spacing"), number("speed")
        corners = plan_tracks(number("length"), number("width"), spacing, 0.5 * spacing)
        self._guidance = TrackGuidance(corners, speed, number("look_ahead"))
        self._law = StationController(kp=number("kp"), ki=0.0, feeds_forward=True, limit=speed)
        self._heading: float | None = None  # the heading that is kept [rad]
        self._has_reported = False
        self._publish_twist = node.publisher(self._text("twist_topic"), TwistStamped)
        self._publish_report = node.publisher(self._text("report_topic"), PointCloud2)
        self._navigator = self._navigation(node)
        self._connect(node)
        node.create_timer(PERIOD, self._command)
        start_benchmark(node)

    def _navigation(self, node: Node) -> Navigator:
        topics = {name: self._text(name) for name in ("imu_topic", "dvl_topic", "depth_topic")}
        return Navigator(node, topics, NavigationSpec(dvl_place=(-0.1, 0.0, 0.12)))

    @abc.abstractmethod
    def _connect(self, node: Node) -> None:
        """Subscribe to the topics of the sensors that search."""

    @abc.abstractmethod
    def _goal(self, position: Array) -> Array | None:
        """Return the place to go to, (2,) [m]; None to follow the tracks."""

    def _bottom_depth(self, position: Array) -> float:
        """Return the depth of the bottom; where it is unknown, that which keeps the depth [m]."""
        bottom = self._navigator.bottom
        if bottom.is_known:
            return bottom.depth_at(position)
        return float(position[2]) + self._number("altitude")

    def _report(self, place: Array) -> None:
        """Report a place in the navigation frame, (3,) [m]; only the first one is sent."""
        if not self._has_reported:
            self._has_reported = True
            self._publish_report(point_cloud(place[None], time=self._node.now))

    def _command(self) -> None:
        if not self._navigator.is_ready:
            return
        pose = self._navigator.pose
        position, heading = pose.position, heading_of(pose)
        goal = self._goal(position)
        if goal is None:
            error = self._guidance.command(position[:2]) / self._number("kp")
        else:
            error = goal - position[:2]
        if self._heading is None:
            self._heading = heading
        if math.hypot(*error.tolist()) > TURN_DISTANCE:
            self._heading = math.atan2(error[1], error[0])
        rise = self._bottom_depth(position) - self._number("altitude") - position[2]
        turn = self._heading - heading
        state = TrackingState(
            error=np.array([error[0], error[1], rise]),
            heading_error=math.atan2(math.sin(turn), math.cos(turn)),
            velocity=self._navigator.velocity,
            rotation=pose.rotation,
            goal_velocity=np.zeros(3),
        )
        velocity, turn_rate = self._law.step(state, PERIOD)
        self._publish_twist(velocity_command(velocity, turn_rate, time=self._node.now))


class SearchCamera(ObjectSearch):
    """A search by a camera along narrow tracks; it reports an orange object that it sees."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **ObjectSearch.PARAMETERS,
        "spacing": 2.0,
        "camera_x": 0.1,
        "camera_z": 0.12,
        "object_height": 0.07,
        "min_images": 3.0,
        "image_topic": "/bluerov2/camera",
        "info_topic": "/bluerov2/camera_info",
    }
    """The place of the camera in base axes, and the ``object_height`` of the middle of the
    object over the bottom [m]; the number of images with the object before a report."""

    def _connect(self, node: Node) -> None:
        self._pinhole: Pinhole | None = None
        self._detector = ColourDetector()
        self._sightings = HoleChart(0.5, round(self._number("min_images")))
        node.subscribe(self._text("info_topic"), CameraInfo, self._on_info)
        node.subscribe(self._text("image_topic"), Image, self._on_image)

    def _goal(self, position: Array) -> Array | None:
        return None

    def _on_info(self, message: CameraInfo) -> None:
        self._pinhole = Pinhole.from_info(message)

    def _on_image(self, message: Image) -> None:
        if self._pinhole is None or not self._navigator.is_ready:
            return
        pose = self._navigator.pose
        place = np.array([self._number("camera_x"), 0.0, self._number("camera_z")])
        bottom_depth = self._bottom_depth(pose.position)
        view = View(
            pinhole=self._pinhole,
            navigation_from_camera=pose @ Pose(place, BASE_FROM_CAMERA),
            seabed_depth=bottom_depth,
        )
        height = self._number("object_height")
        for outline in self._detector.detect(pixels_of(message), view)[:1]:
            point = view.intersect_plane(*outline.centre, bottom_depth - height)
            if point is not None:
                self._sightings.add(point)
        places = self._sightings.places()
        if len(places):
            self._report(places[0])


class Search(SearchCamera):
    """A search by sonar; a camera confirms the object at the places of the echoes."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **SearchCamera.PARAMETERS,
        "spacing": 6.0,
        "threshold": 3.5,
        "min_range": 3.5,
        "merge_distance": 1.0,
        "min_pings": 2.0,
        "look_time": 2.0,
        "sonar_x": 0.2,
        "sonar_topic": "/bluerov2/sonar",
    }
    """The numbers ``threshold`` and ``min_range`` of `EchoDetector`; the distance within which
    echoes are one place [m]; the number of pings with an echo before its place is visited; the time
    for which the camera looks at a place [s]; the place of the sonar forward of the base [m]."""

    def _connect(self, node: Node) -> None:
        super()._connect(node)
        self._detect_echoes(node)

    def _detect_echoes(self, node: Node) -> None:
        self._echo_detector = EchoDetector(
            threshold=self._number("threshold"), min_range=self._number("min_range")
        )
        self._echoes = HoleChart(self._number("merge_distance"), round(self._number("min_pings")))
        self._left_places: list[Array] = []  # (2,) each [m]
        self._arrival_time: float | None = None
        node.subscribe(self._text("sonar_topic"), ProjectedSonarImage, self._on_ping)

    def _on_ping(self, message: ProjectedSonarImage) -> None:
        """Note the places of the echoes, which are taken to be on the bottom."""
        if not self._navigator.is_ready:
            return
        pose = self._navigator.pose
        position, heading = pose.position, heading_of(pose)
        bottom_depth = self._bottom_depth(position)
        height = bottom_depth - float(position[2])
        ranges = np.asarray(message.ranges, dtype=np.float64)
        azimuths = np.array([math.atan2(d.y, d.z) for d in message.beam_directions])
        cells = np.asarray(message.image.data, dtype=np.uint8).view("<f4")
        amplitudes = cells.reshape(len(ranges), len(azimuths))
        for echo in self._echo_detector.detect(amplitudes, ranges, azimuths):
            distance = math.sqrt(max(0.0, echo.range * echo.range - height * height))
            x = self._number("sonar_x") + distance * math.cos(echo.azimuth)
            y = distance * math.sin(echo.azimuth)
            cos, sin = math.cos(heading), math.sin(heading)
            place = position[:2] + np.array([cos * x - sin * y, sin * x + cos * y])
            if self._is_in_area(place):
                self._echoes.add(np.array([place[0], place[1], bottom_depth]))

    def _is_in_area(self, place: Array) -> bool:
        extents = self._number("length"), self._number("width")
        return all(
            -AREA_MARGIN < coordinate < extent + AREA_MARGIN
            for coordinate, extent in zip(place.tolist(), extents, strict=True)
        )

    def _goal(self, position: Array) -> Array | None:
        """Return the nearest place of an echo that was not left; leave it after the look."""
        distances = [
            (math.dist(place, position[:2]), i)
            for i, place in enumerate(self._echoes.places()[:, :2].tolist())
            if all(
                math.dist(place, left) > self._number("merge_distance")
                for left in self._left_places
            )
        ]
        if not distances:
            return None
        distance, index = min(distances)
        place = self._echoes.places()[index]
        if distance > ARRIVAL:
            self._arrival_time = None
        elif self._arrival_time is None:
            self._arrival_time = self._node.now
        elif self._node.now - self._arrival_time >= self._number("look_time"):
            self._arrival_time = None
            self._left_places.append(place[:2])
        self._on_place(place, distance)
        goal: Array = place[:2]
        return goal

    def _on_place(self, place: Array, distance: float) -> None:
        """Handle the distance of the present place; the camera looks on its own."""


class SearchSonar(Search):
    """A search by sonar alone; it reports the first place of an echo that it reaches."""

    def _connect(self, node: Node) -> None:
        self._detect_echoes(node)

    def _on_place(self, place: Array, distance: float) -> None:
        if distance <= ARRIVAL:
            self._report(place)


class SearchTruth(ObjectSearch):
    """A search that knows the place of the object, goes there and reports it."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **ObjectSearch.PARAMETERS,
        "target": "recorder",
        "odom_topic": "/bluerov2/odom",
        "frames_topic": "/tf",
    }
    """The name of the object, and the topics of the true poses."""

    def _navigation(self, node: Node) -> Navigator:
        return TrueNavigator(node, self._text("odom_topic"))

    def _connect(self, node: Node) -> None:
        self._origin: Array | None = None  # the first position, in L (2,) [m]
        self._place: Array | None = None  # of the object, in L (3,) [m]
        node.subscribe(self._text("frames_topic"), TFMessage, self._on_frames)

    def _on_frames(self, message: TFMessage) -> None:
        for frame in message.transforms:
            if frame.child_frame_id.strip("/") == self._text("target"):
                t = frame.transform.translation
                self._place = np.array([t.x, t.y, t.z])
                self._navigator.bottom.set_depth(t.z)

    def _goal(self, position: Array) -> Array | None:
        if self._origin is None:
            self._origin = position[:2].copy()
        if self._place is None:
            goal: Array = position[:2]
            return goal
        if math.dist(self._place[:2], position[:2]) <= ARRIVAL:
            self._report(self._place - np.array([*self._origin.tolist(), 0.0]))
        goal = self._place[:2]
        return goal


def heading_of(pose: Pose) -> float:
    """Return the heading of a pose, from north towards east [rad]."""
    return math.atan2(pose.rotation[1, 0], pose.rotation[0, 0])
