"""Operators over a link: the route, the prediction, and the start of the task."""

from __future__ import annotations

import math

import numpy as np
import pytest

import uwsim
from uwsim.algorithms.teleoperation.motion_model import MotionModel
from uwsim.algorithms.teleoperation.operators import OperatorPredict
from uwsim.algorithms.teleoperation.route import Route
from uwsim.errors import BadSetting

DT = 0.1


def test_progress_along_a_route_never_decreases_and_stops_at_corners() -> None:
    route = Route.parse("0 0 4 0 4 3")
    route.advance(np.array([1.0, 0.5]))
    assert route.point_ahead(1.0) == pytest.approx([2.0, 0.0])
    route.advance(np.array([0.0, 0.0]))
    assert route.point_ahead(1.0) == pytest.approx([2.0, 0.0])
    assert route.point_ahead(9.0) == pytest.approx([4.0, 0.0])
    route.advance(np.array([4.0, 1.0]))
    assert route.point_ahead(9.0) == pytest.approx([4.0, 3.0])


@pytest.mark.parametrize("text", ["1 2", "1 2 3", "north"])
def test_a_route_needs_two_corners(text: str) -> None:
    with pytest.raises(BadSetting, match="expected two corners or more"):
        Route.parse(text)


def test_the_displacement_by_a_step_is_that_of_a_first_order_lag() -> None:
    model, lag, speed = MotionModel(lag=0.5), 0.5, 0.4
    for k in range(50):
        model.add_command(k * DT, np.array([speed, 0.0, 0.0]), DT)
    time = 50 * DT
    exact = speed * (time - lag * (1.0 - math.exp(-time / lag)))
    # the sum takes the velocity at the end of each step: at most half a step too far
    assert model.displacement_since(0.0, 0.0)[0] == pytest.approx(exact, abs=speed * DT / 2 + 1e-9)


def test_a_prediction_over_the_delay_is_where_the_vehicle_will_be() -> None:
    """Move an ideal vehicle with a lag and a delay in a current, and compare it."""
    lag, delay, current = 0.5, 1.5, np.array([0.05, -0.02, 0.0])
    model, n_delay = MotionModel(lag=lag), round(delay / DT)
    sent: list[np.ndarray] = []
    positions, velocities = [np.zeros(3)], [np.zeros(3)]
    predictions = []
    for k in range(300):
        now = k * DT
        report = max(0, k - n_delay)  # the newest report, and what had been sent for it
        if k >= n_delay:
            sent_time = (report - n_delay) * DT
            model.update_current(velocities[report] + current, sent_time, DT)
            moved = model.displacement_since(sent_time, 2.0 * delay)
            predictions.append((k + n_delay, positions[report] + moved))
        command = np.array([0.3 * math.sin(0.7 * now), 0.2 * math.cos(0.4 * now), 0.0])
        sent.append(command)
        model.add_command(now, command, DT)
        applied = sent[k - n_delay] if k >= n_delay else np.zeros(3)
        velocity = velocities[-1] + (1.0 - math.exp(-DT / lag)) * (applied - velocities[-1])
        velocities.append(velocity)
        positions.append(positions[-1] + (velocity + current) * DT)
    assert model.current == pytest.approx(current, abs=1e-3)
    errors = [predicted - positions[k] for k, predicted in predictions if 200 < k <= 300]
    assert np.abs(errors).max() < 0.01


def test_an_operator_measures_the_delay_and_drives_along_the_route() -> None:
    """Check the first seconds of the task, without a benchmark."""
    with uwsim.load("teleoperation-scene", seed=0, timestep=0.01) as simulation:
        operator = OperatorPredict()
        simulation.attach(operator)
        simulation.advance(8.0)
        north, east, down = simulation.pose("bluerov2").position.tolist()
        assert operator.delay < 0.2
        assert north > -3.0
        assert 0.2 < east < 1.2
        assert down == pytest.approx(1.8, abs=0.1)
