"""The memory of a line that is out of sight."""

from __future__ import annotations

import math

import pytest

from tests.algorithms.fake_node import FakeNode
from uwsim.algorithms.pipe.cable_camera import CableCamera, CableNoMemory
from uwsim.algorithms.pipe.line_detector import DetectedLine
from uwsim.algorithms.pipe.line_memory import LineMemory
from uwsim.messages import DVL, Imu, Vector3

PLACE = 0.2
"""The place of the camera forward of the base [m]."""


def test_a_line_passes_as_the_vehicle_moves() -> None:
    memory = LineMemory(PLACE)
    memory.see(DetectedLine(0.5, 0.25, 0.9))
    memory.move((0.4, 0.1), 0.0, 2.0)  # 0.8 m forward, 0.2 m to starboard
    line = memory.line
    assert line is not None
    assert line.slope == pytest.approx(0.25)
    assert line.offset == pytest.approx(0.5 + 0.8 * 0.25 - 0.2)
    assert memory.distance == pytest.approx(math.hypot(0.8, 0.2))


def test_a_turn_to_starboard_turns_the_line_to_port() -> None:
    memory = LineMemory(0.0)
    memory.see(DetectedLine(0.0, 0.0, 0.9))
    for _ in range(10):
        memory.move((0.0, 0.0), 0.3, 0.1)
    line = memory.line
    assert line is not None
    assert line.slope == pytest.approx(math.tan(-0.3))


def test_a_line_abeam_is_no_line_to_follow() -> None:
    memory = LineMemory(PLACE)
    assert memory.line is None
    memory.see(DetectedLine(0.0, 0.0, 0.9))
    memory.move((0.0, 0.0), math.pi / 2.0, 1.0)
    assert memory.line is None


def started(algorithm: type[CableCamera]) -> tuple[CableCamera, FakeNode]:
    cable, node = algorithm(), FakeNode()
    cable.start(node)  # type: ignore[arg-type]
    return cable, node


def sail(node: FakeNode, metres: float) -> None:
    """Report a straight motion to the algorithm, at 0.5 m/s."""
    node.readers["/bluerov2/imu"](Imu(angular_velocity=Vector3(x=0.0, y=0.0, z=0.0)))
    for _ in range(round(metres / 0.05) + 1):
        node.now += 0.1
        node.readers["/bluerov2/dvl"](DVL(bs_longitudinal=0.5, bs_transverse=0.0, bs_status="A"))


def test_over_a_buried_stretch_the_remembered_line_is_followed_up_to_its_distance() -> None:
    cable, node = started(CableCamera)
    seen_line = DetectedLine(0.3, 0.0, 0.9)
    assert cable.choose_line(seen_line) == seen_line
    sail(node, 3.0)
    line = cable.choose_line(None)
    assert line is not None
    assert line.offset == pytest.approx(0.3)
    sail(node, 4.0)
    assert cable.choose_line(None) is None


def test_a_line_far_from_the_remembered_one_is_another_one() -> None:
    cable, _ = started(CableCamera)
    cable.choose_line(DetectedLine(0.3, 0.0, 0.9))
    line = cable.choose_line(DetectedLine(-0.6, 0.0, 0.9))
    assert line is not None
    assert line.offset == pytest.approx(0.3)


def test_without_memory_the_vehicle_moves_straight_on() -> None:
    cable, _ = started(CableNoMemory)
    cable.choose_line(DetectedLine(0.3, 0.0, 0.9))
    assert cable.choose_line(None) is None
