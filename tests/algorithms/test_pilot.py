"""A pilot's inputs become twists, commands of thrusters and speeds of joints."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from tests.algorithms.fake_node import FakeNode
from uwsim.algorithms.pilot import AXES, N_THRUSTERS, PERIOD, TOPIC, Pilot
from uwsim.messages import Bool, Float64MultiArray, MultiArrayLayout, String

LAYOUT = MultiArrayLayout(dim=[], data_offset=0)


class TimedNode(FakeNode):
    """A node whose one timer is called by hand."""

    def create_timer(self, period_s: float, callback: Callable[[], None]) -> None:
        assert period_s == PERIOD
        self.tick = callback


def flown(**parameters: float | str) -> TimedNode:
    """A node whose pilot is as fast as its inputs."""
    node = TimedNode(parameters={"start": "", "rate": 1000.0, **parameters})
    Pilot().start(node)
    return node


def move(node: TimedNode, **axes: float) -> list[tuple[str, object]]:
    """Hand over an input and return what is commanded from it."""
    values = np.array([axes.get(axis, 0.0) for axis in AXES])
    node.readers[TOPIC](Float64MultiArray(layout=LAYOUT, data=values))
    node.published.clear()
    wait(node)
    return list(node.published)


def wait(node: TimedNode, seconds: float = PERIOD) -> None:
    """Let time pass, and the timer go off."""
    node.now += seconds
    node.tick()


def commands(published: list[tuple[str, object]]) -> list[float]:
    """Return what thrusters are told, where nothing else is told."""
    ((topic, message),) = published
    assert topic == "/t"
    assert isinstance(message, Float64MultiArray)
    values: list[float] = message.data.tolist()
    return values


def test_single_thrusters_get_their_axes_in_the_order_of_the_vehicle() -> None:
    node = flown(thrusters_topic="/t", n_thrusters=3.0)
    assert commands(move(node, thruster1=1.0, thruster3=-0.5)) == [1.0, 0.0, -0.5]
    assert commands(move(node)) == [0.0, 0.0, 0.0]


def test_thrust_scales_commands_and_their_rate_is_limited() -> None:
    node = flown(thrusters_topic="/t", n_thrusters=1.0, thrust=0.5, rate=2.0)
    assert commands(move(node, thruster1=1.0)) == pytest.approx([0.1])  # one more at once
    assert commands(move(node, thruster1=1.0)) == pytest.approx([0.15])


def test_an_input_that_changes_is_followed_at_once_and_no_faster_than_the_rate() -> None:
    node = flown(thrusters_topic="/t", n_thrusters=1.0, rate=2.0)
    full = Float64MultiArray(layout=LAYOUT, data=np.eye(len(AXES))[AXES.index("thruster1")])
    wait(node, 0.013)
    assert node.published == []
    node.readers[TOPIC](full)
    assert commands(node.published) == pytest.approx([2.0 * PERIOD])
    node.published.clear()
    node.readers[TOPIC](full)  # the same again is no news
    assert node.published == []
    wait(node, 0.004)
    assert commands(node.published) == pytest.approx([2.0 * (PERIOD + 0.004)])


def test_thrusters_beyond_the_last_axis_stand_still() -> None:
    node = flown(thrusters_topic="/t", n_thrusters=N_THRUSTERS + 2.0)
    full = {f"thruster{k}": 1.0 for k in range(1, N_THRUSTERS + 1)}
    assert commands(move(node, **full)) == [1.0] * N_THRUSTERS + [0.0] * 2


@pytest.mark.parametrize("other", ["twist_topic", "odom_topic"])
def test_a_vehicle_that_takes_both_gets_what_was_moved_last(other: str) -> None:
    node = flown(thrusters_topic="/t", n_thrusters=1.0, **{other: "/v"})
    topics = [
        [topic for topic, _ in move(node, **axes)]
        for axes in (
            {},
            {"surge": 1.0},
            {"surge": 1.0, "thruster1": 1.0},
            {"thruster1": 1.0},
            {},
            {"yaw": -1.0, "thruster1": 1.0},
            {"yaw": -1.0},
            {},
        )
    ]
    assert topics == [["/v"], ["/v"], ["/v"], ["/t"], ["/t"], ["/t"], ["/v"], ["/v"]]


def test_inputs_without_axes_that_came_later_leave_those_at_rest() -> None:
    node = flown(twist_topic="/v", thrusters_topic="/t", n_thrusters=1.0)
    move(node, thruster1=1.0)
    older = np.zeros(AXES.index("thruster1"))
    older[AXES.index("surge")] = 1.0
    node.readers[TOPIC](Float64MultiArray(layout=LAYOUT, data=older))
    node.published.clear()
    wait(node)
    assert [topic for topic, _ in node.published] == ["/v"]


def test_inputs_of_more_numbers_than_axes_are_passed_over() -> None:
    node = flown(twist_topic="/v")
    too_many = np.ones(len(AXES) + 1)
    node.readers[TOPIC](Float64MultiArray(layout=LAYOUT, data=too_many))
    wait(node)
    assert node.published == []


def test_lamps_are_dimmed_from_full_brightness_while_their_axis_is_held() -> None:
    node = flown(lamp_topics="left/brightness right/brightness", dim_rate=8.0)
    assert move(node) == []
    said = [move(node, lamps=-1.0) for _ in range(4)]
    assert [[message.data for _, message in each] for each in said] == [  # type: ignore[attr-defined]
        pytest.approx([0.6, 0.6]),
        pytest.approx([0.2, 0.2]),
        [0.0, 0.0],
        [],
    ]
    assert {topic for topic, _ in said[0]} == {"left/brightness", "right/brightness"}
    assert [message.data for _, message in move(node, lamps=0.25)] == pytest.approx([0.1, 0.1])  # type: ignore[attr-defined]
    assert move(node) == []


def test_an_autopilot_gets_sticks_and_nothing_else_moves_the_vehicle() -> None:
    node = flown(autopilot="rov/ap", twist_topic="/cmd", thrusters_topic="/t", n_thrusters=2.0)
    ((topic, message),) = move(node, surge=0.5, heave=1.0, yaw=-0.25)
    assert topic == "rov/ap/sticks"
    assert isinstance(message, Float64MultiArray)
    assert message.data.tolist() == [0.5, 0.0, 1.0, -0.25, 0.0, 0.0]


def test_the_sticks_of_an_autopilot_rest_before_the_first_input() -> None:
    node = flown(autopilot="rov/ap")
    wait(node)
    ((topic, message),) = node.published
    assert topic == "rov/ap/sticks"
    assert isinstance(message, Float64MultiArray)
    assert not message.data.any()


def test_arming_and_modes_are_commanded_once_for_each_press() -> None:
    node = flown(autopilot="rov/ap")
    switches: list[tuple[str, object]] = []
    for axes in ({"arm": 1.0}, {"arm": 1.0, "surge": 1.0}, {}, {"arm": -1.0}, {"mode3": 1.0}):
        values = np.array([axes.get(axis, 0.0) for axis in AXES])
        node.published.clear()
        node.readers[TOPIC](Float64MultiArray(layout=LAYOUT, data=values))
        switches += [entry for entry in node.published if entry[0] != "rov/ap/sticks"]
    assert [topic for topic, _ in switches] == ["rov/ap/arm", "rov/ap/arm", "rov/ap/mode"]
    contents = [message.data for _, message in switches if isinstance(message, Bool | String)]
    assert contents == [True, False, "ALT_HOLD"]


def test_without_an_autopilot_its_axes_have_no_effect() -> None:
    node = flown(thrusters_topic="/t", n_thrusters=1.0)
    assert commands(move(node, arm=1.0, mode1=1.0)) == [0.0]
