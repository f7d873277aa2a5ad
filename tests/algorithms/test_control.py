from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tests.algorithms.fake_node import FakeNode
from uwsim.algorithms.control import PI, ControllerNode, P, StationKeeper
from uwsim.messages import TwistStamped, floats


def settle(keeper: StationKeeper, current: float, time: float, *, dt: float = 0.1) -> float:
    """Let a pure integrator drift in a current under control; return where it ends [m]."""
    position = 0.0
    for _ in range(round(time / dt)):
        command = keeper.step(np.array([-position, 0.0]), dt)[0]
        position += (command + current) * dt
    return position


def test_proportional_control_leaves_current_over_gain() -> None:
    assert settle(StationKeeper(kp=0.4, ki=0.0, limit=0.5), 0.1, 100.0) == pytest.approx(0.25)


def test_integral_control_leaves_nothing() -> None:
    assert settle(StationKeeper(kp=0.4, ki=0.04, limit=0.5), 0.1, 200.0) == pytest.approx(
        0.0, abs=1e-6
    )


def test_speeds_stay_within_the_limit() -> None:
    command = StationKeeper(kp=0.4, ki=0.04, limit=0.5).step(np.array([9.0, -9.0]), 0.1)
    assert command == pytest.approx([0.5, -0.5])


def test_the_integral_does_not_wind_up_at_the_limit() -> None:
    keeper = StationKeeper(kp=0.4, ki=0.04, limit=0.5)
    for _ in range(1000):
        keeper.step(np.array([5.0, 0.0]), 0.1)
    assert keeper.step(np.array([-0.01, 0.0]), 0.1)[0] < 0.0


def test_p_has_no_integral_gain_to_set_and_pi_has() -> None:
    assert "ki" not in P.PARAMETERS
    assert PI.PARAMETERS["ki"] == 0.04
    assert P.PARAMETERS["kp"] == PI.PARAMETERS["kp"] == 0.4


class Says:
    """A law that says one thing."""

    def __init__(self, said: object) -> None:
        self._said = said

    def step(self, error: np.ndarray, dt: float) -> Any:
        return self._said


def commanded_by(said: object, **parameters: float) -> list[float]:
    """Let a node with a law of one's own see a centroid; return what it commands."""

    class Own(ControllerNode):
        def law(self) -> Says:
            return Says(said)

    node = FakeNode(parameters=parameters)
    Own().start(node)
    k = np.array([400.0, 0.0, 320.0, 0.0, 400.0, 240.0, 0.0, 0.0, 1.0])
    node.readers["/uwsim/camera1_info"](SimpleNamespace(k=k))
    node.readers["centroidTopic"](floats(np.array([300.0, 200.0])))
    (twist,) = [message.twist for _, message in node.published if isinstance(message, TwistStamped)]
    return [twist.linear.x, twist.linear.y]


@pytest.mark.parametrize("said", [np.array([0.1, -0.2]), [0.1, -0.2], (0.1, -0.2)])
def test_a_law_of_ones_own_may_say_any_two_numbers(said: object) -> None:
    assert commanded_by(said) == [0.1, -0.2]


def test_a_law_of_ones_own_is_held_to_the_limit() -> None:
    assert commanded_by([9.0, -9.0]) == [0.5, -0.5]
    assert commanded_by([9.0, -0.1], limit=0.2) == [0.2, -0.1]


@pytest.mark.parametrize(
    "said", [[np.nan, 0.0], np.array([0.0, np.inf]), 0.3, None, [1.0, 2.0, 3.0], ["a", "b"]]
)
def test_a_law_that_says_no_two_speeds_is_an_error_of_the_algorithm(said: object) -> None:
    with pytest.raises(ValueError, match=r"the law Says returned .*; expected two finite speeds"):
        commanded_by(said)
