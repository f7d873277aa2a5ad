"""The detection of echoes, and the state machine of the search."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from tests.algorithms.fake_node import FakeNode
from uwsim.algorithms.grasp.variants import TrueNavigator
from uwsim.algorithms.search import SearchSonar, SearchTruth
from uwsim.algorithms.search.echo_detector import EchoDetector
from uwsim.base.geometry import Array
from uwsim.base.rng import stream
from uwsim.messages import (
    Odometry,
    Point,
    PointCloud2,
    ProjectedSonarImage,
    Quaternion,
    TFMessage,
    Transform,
    TransformStamped,
    TwistStamped,
    Vector3,
    points,
)
from uwsim.sensors.sonar.imaging_sonar import ImagingSonarSpec
from uwsim.sensors.sonar.message import level_directions, sonar_image

RANGES, AZIMUTHS = np.linspace(2.0, 12.0, 201), np.radians(np.linspace(-45.0, 45.0, 91))
DETECTOR = EchoDetector(threshold=3.5, min_range=3.5)


def draw_ping(*echoes: tuple[float, float]) -> Array:
    """Draw speckle that fades with the range, with echoes at ranges [m] and azimuths [deg]."""
    shape = len(RANGES), len(AZIMUTHS)
    amplitudes = stream(0, "ping").rayleigh(size=shape) / RANGES[:, None] ** 2
    for distance, azimuth in echoes:
        i, j = np.searchsorted(RANGES, distance - 1e-9), round(azimuth) + 45
        amplitudes[i - 1 : i + 2, j - 1 : j + 2] *= 8.0
    ping: Array = amplitudes
    return ping


def test_speckle_has_no_echo() -> None:
    assert DETECTOR.detect(draw_ping(), RANGES, AZIMUTHS) == []


def test_an_echo_is_found_at_its_range_and_azimuth() -> None:
    echoes = DETECTOR.detect(draw_ping((8.0, 20.0), (5.0, -10.0)), RANGES, AZIMUTHS)
    found = sorted((echo.range, math.degrees(echo.azimuth)) for echo in echoes)
    assert np.array(found) == pytest.approx(np.array([[5.0, -10.0], [8.0, 20.0]]), abs=1.01)


def test_an_echo_below_the_least_range_is_left_out() -> None:
    assert DETECTOR.detect(draw_ping((2.8, 0.0)), RANGES, AZIMUTHS) == []


class TimedNode(FakeNode):
    """A node whose timers a test calls."""

    def create_timer(self, period_s: float, callback: Any) -> None:
        self.tick = callback


def place_vehicle(node: TimedNode, north: float, east: float) -> None:
    """Publish the true pose of a vehicle that heads north, and call the timer."""
    odometry = Odometry()
    odometry.pose.pose.position = Point(x=north, y=east, z=6.0)
    odometry.pose.pose.orientation = Quaternion(w=1.0, x=0.0, y=0.0, z=0.0)
    node.readers["/bluerov2/odom"](odometry)
    node.now += 0.1
    node.tick()


def reports(node: FakeNode) -> list[Array]:
    """Return the reported places."""
    return [points(m) for _, m in node.published if isinstance(m, PointCloud2)]


def test_the_expert_reports_the_place_relative_to_its_start_when_it_is_there() -> None:
    node, search = TimedNode(), SearchTruth()
    search.start(node)
    place_vehicle(node, -8.0, -6.0)
    transform = Transform(translation=Vector3(x=2.0, y=1.0, z=7.9))
    frame = TransformStamped(child_frame_id="recorder", transform=transform)
    node.readers["/tf"](TFMessage(transforms=[frame]))
    place_vehicle(node, -8.0, -6.0)
    assert reports(node) == []
    twist = next(m.twist for _, m in reversed(node.published) if isinstance(m, TwistStamped))
    assert twist.linear.x == pytest.approx(0.6 * 10.0 / math.hypot(10.0, 7.0, 0.6), abs=0.02)
    for _ in range(2):
        place_vehicle(node, 1.8, 1.1)
    (places,) = reports(node)
    assert places == pytest.approx(np.array([[10.0, 7.0, 7.9]]))


class SearchWithTruePose(SearchSonar):
    """A search by sonar whose navigator reads the true pose."""

    def _navigation(self, node: Any) -> Any:
        return TrueNavigator(node, "/bluerov2/odom")


def ping_message(*echoes: tuple[float, float]) -> ProjectedSonarImage:
    """Return a ping as the imaging sonar publishes it."""
    spec = ImagingSonarSpec(name="sonar", relative_to="base_link", bins=201, beams=91)
    return sonar_image(
        draw_ping(*echoes).astype(np.float32), spec, time=0.0, sound_speed=1500.0,
        directions=level_directions(-AZIMUTHS), ranges=RANGES,
    )  # fmt: skip


def test_the_place_of_an_echo_is_visited_and_reported() -> None:
    node, search = TimedNode(parameters={"sonar_x": 0.0, "altitude": 1.5}), SearchWithTruePose()
    search.start(node)
    place_vehicle(node, 0.0, 0.0)
    for _ in range(2):
        node.readers["/bluerov2/sonar"](ping_message((8.0, 30.0)))
    place_vehicle(node, 0.0, 0.0)
    assert reports(node) == []
    distance = math.sqrt(8.0**2 - 1.5**2)
    goal = distance * np.array([math.cos(math.pi / 6.0), math.sin(math.pi / 6.0)])
    place_vehicle(node, *goal.tolist())
    (places,) = reports(node)
    assert places[0] == pytest.approx([*goal, 7.5], abs=0.2)


def test_a_place_that_is_not_confirmed_is_left_after_the_look() -> None:
    class Looking(SearchWithTruePose):
        def _on_place(self, place: Array, distance: float) -> None:
            """Do not report."""

    node, search = TimedNode(parameters={"look_time": 1.0}), Looking()
    search.start(node)
    place_vehicle(node, 0.0, 0.0)
    for _ in range(2):
        node.readers["/bluerov2/sonar"](ping_message((5.0, 10.0), (9.0, 20.0)))
    near, far = sorted(search._echoes.places()[:, :2].tolist(), key=lambda place: place[0])
    for _ in range(8):
        place_vehicle(node, *near)
    assert search._goal(np.array([*near, 6.0])) == pytest.approx(near)
    for _ in range(4):
        place_vehicle(node, *near)
    assert search._goal(np.array([*near, 6.0])) == pytest.approx(far)


def test_a_search_without_echoes_follows_its_tracks() -> None:
    node, search = TimedNode(), SearchWithTruePose()
    search.start(node)
    place_vehicle(node, 0.0, 0.0)
    twist = next(m.twist for _, m in node.published if isinstance(m, TwistStamped))
    assert twist.linear.y == pytest.approx(0.6)  # east, to the first track
