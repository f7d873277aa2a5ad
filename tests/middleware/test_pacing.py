"""Simulation time in step with real time, on a clock that the test turns."""

from __future__ import annotations

import pytest

from uwsim.errors import RunFailed
from uwsim.middleware.pacing import Pace


class Wall:
    """Real time and simulation time of a test."""

    def __init__(self, speed: float, max_lag: float | None = None) -> None:
        self.now, self.simulation_time = 100.0, 5.0
        self.pace = Pace(
            lambda: self.simulation_time,
            speed,
            max_lag=max_lag,
            now=lambda: self.now,
            sleep=self.sleep,
        )
        self.pace.step()

    def sleep(self, seconds: float) -> None:
        self.now += seconds

    def step(self, simulation_time: float, duration: float) -> None:
        self.simulation_time += simulation_time
        self.now += duration
        self.pace.step()


@pytest.mark.parametrize("speed", [1.0, 4.0, 0.5])
def test_a_simulation_that_is_fast_enough_takes_the_time_that_passes(speed: float) -> None:
    wall = Wall(speed)
    for _ in range(1000):
        wall.step(0.01, duration=0.002)
    assert wall.now - 100.0 == pytest.approx(10.0 / speed, abs=0.002)
    assert wall.pace.lost_time == 0.0


def test_a_short_lag_is_caught_up_and_a_long_one_is_lost() -> None:
    wall = Wall(1.0)
    wall.step(0.01, duration=0.11)
    for _ in range(20):
        wall.step(0.01, duration=0.0)
    assert wall.now == pytest.approx(100.21)
    wall.step(0.01, duration=3.01)
    for _ in range(20):
        wall.step(0.01, duration=0.0)
    assert wall.now == pytest.approx(100.21 + 3.01 + 0.2)
    assert wall.pace.lost_time == pytest.approx(3.0)


def test_a_strict_clock_ends_the_run_when_a_step_is_late() -> None:
    wall = Wall(1.0, max_lag=0.05)
    wall.step(0.01, duration=0.05)
    wall.step(0.01, duration=0.0)
    with pytest.raises(RunFailed, match="late; --max-lag"):
        wall.step(0.01, duration=0.06)
