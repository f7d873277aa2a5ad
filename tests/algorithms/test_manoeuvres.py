"""Manoeuvring algorithms at a desk: what they order, and in which frames."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.algorithms.fake_node import FakeNode
from tests.physics.prestero import odometry_of
from uwsim.algorithms.manoeuvres import TurningCircleNode, ZigZagNode
from uwsim.algorithms.manoeuvres.programs import (
    CrashStop,
    Motion,
    PullOut,
    ReverseSpiral,
    Spiral,
    ZigZag,
)
from uwsim.errors import BadSetting
from uwsim.messages import Odometry

STEERING = {"wrench_topic": "/wrench", "fins_topic": "/fins", "ahead": 4.0, "approach": 1.0}
FINS = {"rudders": "-1 -1 0 0", "elevators": "0 0 -1 -1", "limit": 20.0}


def motion(
    time: float = 0.0, *, heading_change: float = 0.0, yaw_rate: float = 0.0, speed: float = 1.0
) -> Motion:
    return Motion(time=time, heading_change=heading_change, yaw_rate=yaw_rate, speed=speed)


def at(heading: float, *, z_up: bool = False, depth: float = 0.0, pitch: float = 0.0) -> Odometry:
    """Return odometry of a level vehicle; with ``z_up`` frame and vehicle are those of REP 103."""
    state = np.zeros(12)
    state[8], state[10], state[11] = depth, pitch, heading
    if z_up:
        state[8], state[10], state[11] = -depth, -pitch, -heading
    return odometry_of(state)


def run(node: TurningCircleNode, desk: FakeNode, messages: list[Odometry]) -> None:
    node.start(desk)  # type: ignore[arg-type]
    for message in messages:
        desk.readers["/odometry"](message)
        desk.now += 0.02


def test_a_zigzag_reverses_the_rudder_at_its_heading() -> None:
    program = ZigZag(0.2, 0.1)
    assert program.step(motion()).rudder == 0.2
    assert program.step(motion(1.0, heading_change=0.09)).rudder == 0.2
    assert program.step(motion(2.0, heading_change=0.11)).rudder == -0.2
    assert program.step(motion(3.0, heading_change=0.2)).rudder == -0.2
    assert program.step(motion(4.0, heading_change=-0.11)).rudder == 0.2


def test_a_spiral_counts_the_angles_that_it_has_held() -> None:
    program = Spiral([0.2, 0.0, -0.2], 10.0)
    assert program.step(motion(5.0)).rudder == 0.2
    assert program.step(motion(25.0)).rudder == -0.2
    assert [hold.end for hold in program.hold_intervals] == [10.0, 20.0]
    assert not program.is_finished
    program.step(motion(30.0))
    assert program.is_finished


def test_the_helmsman_of_a_reverse_spiral_finds_the_rudder_for_a_rate() -> None:
    program = ReverseSpiral([0.1], 60.0, gain=1.0, integral_time=2.0, limit=0.5)
    rate, rudder = 0.0, 0.0
    for k in range(2999):  # a vehicle with r' = (0.4 rudder - r) / 2
        rudder = program.step(motion(0.02 * k, yaw_rate=rate)).rudder
        rate += 0.02 * (0.4 * rudder - rate) / 2.0
    assert rate == pytest.approx(0.1, rel=1e-3)
    assert rudder == pytest.approx(0.25, rel=1e-2)


def test_a_pull_out_puts_the_rudder_to_its_neutral_angle() -> None:
    program = PullOut(0.3, 0.02, 20.0)
    assert program.step(motion(19.0)).rudder == 0.3
    assert program.step(motion(21.0)).rudder == 0.02


def test_a_crash_stop_ends_when_the_vehicle_goes_astern() -> None:
    program = CrashStop()
    assert program.step(motion(speed=1.5)).thrust == -1.0
    assert not program.is_finished
    program.step(motion(9.0, speed=-0.1))
    assert program.is_finished


@pytest.mark.parametrize("z_up", [False, True])
def test_a_rudder_to_starboard_turns_to_starboard_in_both_frames(z_up: bool) -> None:
    parameters = {**STEERING, "yaw_moment": 10.0, "z_down": 0.0 if z_up else 1.0, "approach": 0.0}
    desk, node = FakeNode(parameters=parameters), TurningCircleNode()
    run(node, desk, [at(0.0, z_up=z_up)] * 3)
    wrench = desk.messages("/wrench")[-1].wrench
    assert node.rudder == pytest.approx(math.radians(35.0))
    assert wrench.torque.z == pytest.approx((-1 if z_up else 1) * 10.0 * math.radians(35.0))
    assert wrench.force.x == 4.0


@pytest.mark.parametrize("z_up", [False, True])
def test_the_approach_holds_heading_and_depth_in_both_frames(z_up: bool) -> None:
    parameters = {**STEERING, **FINS, "z_down": 0.0 if z_up else 1.0, "heave_kp": 5.0}
    desk, node = FakeNode(parameters=parameters), TurningCircleNode()
    run(node, desk, [at(0.0, z_up=z_up)] * 3 + [at(0.1, z_up=z_up, depth=0.5)] * 3)
    assert node.rudder < 0.0, "the bow is to starboard of its course"
    assert node.begin_time is None
    fins = desk.messages("/fins")[-1].data
    assert fins[0] == fins[1] == pytest.approx(-node.rudder)
    assert fins[2] < 0.0, "too deep: the elevators pitch the bow up"
    up = -1.0 if not z_up else 1.0
    assert desk.messages("/wrench")[-1].wrench.force.z == pytest.approx(up * 2.5)


def test_a_heading_is_followed_through_180_degrees() -> None:
    parameters = {**STEERING, **FINS, "approach": 0.0}
    desk, node = FakeNode(parameters=parameters), ZigZagNode()
    headings = [math.pi - 0.1 + 0.01 * k for k in range(40)]
    run(node, desk, [at(heading) for heading in headings])
    assert node.rudder == pytest.approx(-math.radians(10.0)), "10 deg are reached beyond 180 deg"


@pytest.mark.parametrize(
    ("parameters", "text"),
    [
        ({"rudders": "1 x"}, "algorithm.rudders='1 x': expected up to 64 finite numbers"),
        ({"elevators": "inf"}, "algorithm.elevators"),
        ({"rudders": " ".join("1" * 65)}, "expected up to 64"),
        ({"approach": 1e9}, "expected a time from 0 to 3600 s"),
    ],
)
def test_invalid_parameters_are_reported(parameters: dict[str, float | str], text: str) -> None:
    with pytest.raises(BadSetting, match=text):
        TurningCircleNode.check_parameters(parameters)


def test_another_side_than_starboard_and_port_is_reported() -> None:
    desk = FakeNode(parameters={"side": "left"})
    with pytest.raises(BadSetting, match=r"algorithm.side='left': expected starboard or port"):
        TurningCircleNode().start(desk)  # type: ignore[arg-type]
