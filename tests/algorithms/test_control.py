import numpy as np
import pytest

from uwsim.algorithms.control import PI, P, StationKeeper


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
