"""Station keeping on a vehicle that follows twists through the water with a lag."""

import numpy as np
import pytest

from uwsim.algorithms.grasp.station import LAG, StationController, TrackingState
from uwsim.algorithms.grasp.task import square_spiral


def keep(law: StationController, current: tuple[float, float], seconds: float = 60.0) -> np.ndarray:
    """Where the vehicle is in the end, from (0.5, 0, 0), with its goal at the origin."""
    dt, position, through = 0.05, np.array([0.5, 0.0, 0.0]), np.zeros(3)
    water = np.array([*current, 0.0])
    for _ in range(round(seconds / dt)):
        motion = TrackingState(
            error=-position,
            heading_error=0.0,
            velocity=through + water,
            rotation=np.eye(3),
            goal_velocity=np.zeros(3),
        )
        command, _ = law.step(motion, dt)
        through = through + dt / LAG * (command - through)
        position = position + dt * (through + water)
    return position


def station(ki: float, *, feeds_forward: bool) -> StationController:
    return StationController(kp=0.6, ki=ki, feeds_forward=feeds_forward, limit=0.4)


def test_a_proportional_law_is_off_by_the_current_over_its_gain() -> None:
    found = keep(station(0.0, feeds_forward=False), (0.12, -0.06))
    assert found == pytest.approx([0.2, -0.1, 0.0], abs=1e-3)


def test_an_integral_takes_the_offset_away() -> None:
    found = keep(station(0.05, feeds_forward=False), (0.12, -0.06))
    assert found == pytest.approx([0.0, 0.0, 0.0], abs=0.02)


@pytest.mark.parametrize("current", [(0.0, 0.0), (0.3, 0.4)])
def test_a_current_that_is_fed_forward_leaves_no_offset(current: tuple[float, float]) -> None:
    law = station(0.0, feeds_forward=True)
    assert keep(law, current) == pytest.approx([0.0, 0.0, 0.0], abs=5e-3)
    assert law.current[:2] == pytest.approx(current, abs=5e-3)


def test_a_spiral_goes_ahead_first_and_covers_the_square() -> None:
    corners = square_spiral(np.array([1.0, 2.0]), 0.0, 1.0, 2.0)
    assert corners[:4] == [(2.0, 2.0), (2.0, 3.0), (0.0, 3.0), (0.0, 1.0)]
    assert max(max(abs(x - 1.0), abs(y - 2.0)) for x, y in corners) == pytest.approx(2.0)
