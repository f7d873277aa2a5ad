"""What is late with the strict clock, on a real time that the test turns."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.errors import RunFailed
from uwsim.middleware.strict import Delays, StreamReport, StrictClock

STEP = 0.002


class Wall:
    """Real time and simulation time of a test."""

    def __init__(self, *, deadline: float = 0.005, max_lag: float | None = None) -> None:
        self.now, self.simulation_time = 100.0, 5.0
        self.clock = StrictClock(
            lambda: self.simulation_time,
            deadline=deadline,
            max_lag=max_lag,
            now=lambda: self.now,
            sleep=self.sleep,
        )
        self.clock.watch_output("dvl")
        self.clock.watch_input("thrusters", 50.0)
        self.clock.step()

    def sleep(self, seconds: float) -> None:
        self.now += seconds

    def step(self, duration: float = 0.001) -> None:
        self.simulation_time += STEP
        self.now += duration
        self.clock.step()

    def stream(self, name: str) -> StreamReport:
        return next(s for s in self.clock.report().streams if s.name == name)


def test_a_run_in_time_has_no_errors() -> None:
    wall = Wall()
    for i in range(500):
        wall.step()
        wall.clock.note_sent("dvl", wall.simulation_time, wall.simulation_time)
        if i % 10 == 0:
            wall.clock.note_command("thrusters", wall.simulation_time - 0.004)
    report = wall.clock.report()
    assert report.n_errors == 0
    assert [(s.name, s.n, s.n_on_time, s.n_missing) for s in report.streams] == [
        ("steps", 500, 500, 0),
        ("dvl", 500, 500, 0),
        ("thrusters", 50, 50, 0),
    ]
    assert report.step_time.percentile(50.0) == pytest.approx(0.001, rel=0.05)
    assert report.input_to_effect.max_delay == pytest.approx(0.004)
    assert report.lost_time == 0.0


def test_a_step_that_sleeps_is_late_and_so_are_those_that_catch_up() -> None:
    wall = Wall()
    for i in range(500):
        wall.step(0.050 if i == 100 else 0.001)
    steps = wall.stream("steps")
    assert steps.lateness.max_delay == pytest.approx(0.048)
    # the lag of 48 ms shrinks by 1 ms a step; 48 ... 6 ms are more than 5 ms
    assert steps.n_late == pytest.approx(43, abs=1)
    assert steps.n == 500


def test_a_step_exactly_at_the_deadline_is_on_time() -> None:
    wall = Wall(deadline=0.25)
    wall.step(0.25)
    assert wall.stream("steps").n_late == 0


def test_lost_time_is_reported() -> None:
    wall = Wall()
    wall.step(1.002)
    wall.step()
    assert wall.clock.report().lost_time == pytest.approx(1.0)


def test_max_lag_ends_the_run_and_the_report_has_the_late_step() -> None:
    wall = Wall(max_lag=0.1)
    with pytest.raises(RunFailed, match="--max-lag"):
        wall.step(0.2)
    assert wall.stream("steps").n_late == 1


def test_a_late_input_and_missing_inputs_are_counted() -> None:
    wall = Wall()
    wall.clock.note_command("thrusters", None)
    for gap in (0.020, 0.024, 0.026, 0.070):  # the period is 20 ms
        wall.now += gap
        wall.clock.note_command("thrusters", None)
    stream = wall.stream("thrusters")
    assert (stream.n, stream.n_on_time, stream.n_late) == (5, 3, 2)
    assert stream.n_missing == 2  # of 70 ms, three periods; the third input has come
    assert stream.lateness.max_delay == pytest.approx(0.050)


def test_inputs_that_never_come_are_missing() -> None:
    wall = Wall()
    for _ in range(500):
        wall.step()
    stream = wall.stream("thrusters")
    assert (stream.n, stream.n_missing) == (0, 49)
    assert wall.clock.report().n_errors == 49  # a second report counts nothing twice


def test_an_output_after_its_due_time_is_late() -> None:
    wall = Wall()
    wall.step()
    wall.now += 0.030
    wall.clock.note_sent("dvl", wall.simulation_time, wall.simulation_time)
    wall.clock.note_sent("dvl", wall.simulation_time - 0.05, wall.simulation_time + 0.03)
    stream, report = wall.stream("dvl"), wall.clock.report()
    assert (stream.n, stream.n_late) == (2, 1)
    assert report.output_age.max_delay == pytest.approx(0.080, abs=0.001)


def test_an_output_has_no_reader_at_first_and_is_missing_when_the_reader_has_gone() -> None:
    wall = Wall()
    wall.step()
    wall.clock.note_unsent("dvl")
    stream = wall.stream("dvl")
    assert (stream.n, stream.n_missing, stream.n_unread) == (0, 0, 1)
    assert wall.clock.report().n_errors == 0
    wall.clock.note_sent("dvl", wall.simulation_time, wall.simulation_time)
    wall.clock.note_unsent("dvl")
    stream = wall.stream("dvl")
    assert (stream.n, stream.n_missing, stream.n_unread) == (1, 1, 1)
    assert wall.clock.report().n_errors == 1


def test_a_line_that_keeps_its_bytes_for_nobody_has_no_reader() -> None:
    wall, readers = Wall(), list[str]()
    wall.clock.watch_output("pty", lambda: bool(readers))
    wall.step()
    for _ in range(3):
        wall.clock.note_sent("pty", wall.simulation_time, wall.simulation_time)
    wall.clock.note_unsent("pty")
    stream = wall.stream("pty")
    assert (stream.n, stream.n_missing, stream.n_unread, stream.lateness.n) == (0, 0, 4, 0)
    readers.append("socat")
    stream = wall.stream("pty")
    assert (stream.n, stream.n_missing, stream.n_unread, stream.lateness.n) == (3, 1, 0, 3)


def test_percentiles_are_those_of_sorted_delays_to_five_percent() -> None:
    values = np.random.default_rng(1).lognormal(-7.0, 1.0, 10_000)
    delays = Delays()
    for value in values.tolist():
        delays.add(value)
    assert delays.n == 10_000
    assert delays.max_delay == values.max()
    for percent in (50.0, 95.0, 99.0, 99.9):
        exact = float(np.percentile(values, percent, method="inverted_cdf"))
        assert exact <= delays.percentile(percent) <= 1.05 * exact
    assert delays.percentile(100.0) == delays.max_delay


def test_delays_beyond_the_bins_are_counted() -> None:
    delays = Delays()
    assert math.isnan(delays.percentile(50.0))
    for value in (-1.0, 0.0, 1e-9, 1e6):
        delays.add(value)
    assert (delays.n, delays.n_early) == (4, 2)
    assert delays.max_delay == 1e6
    assert delays.percentile(50.0) == 0.0
    assert delays.percentile(75.0) == 1e-5
