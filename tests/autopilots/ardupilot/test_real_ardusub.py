"""A real ArduSub steers the simulated BlueROV2; only with ``UWSIM_ARDUSUB=/path/to/ardusub``.

The tests were run with ArduSub 4.7.0-dev, see ``docs/ardupilot.md``.
"""

from __future__ import annotations

import math
import os

import numpy as np
import pytest

from tests.support.real_ardusub import (
    ALT_HOLD,
    MANUAL_MODE,
    POSHOLD,
    STABILIZE,
    VARIABLE,
    Order,
    Trial,
    fly,
)

pytestmark = pytest.mark.skipif(
    VARIABLE not in os.environ, reason=f"{VARIABLE} is not the path of an ArduSub"
)

ORDERS = [
    Order(time=20.0, mode=MANUAL_MODE),
    Order(time=21.0, is_arming=True),
    Order(time=22.0, sticks=(300, 0, 500, 0)),  # forward
    Order(time=24.0),
    Order(time=30.0, sticks=(0, 300, 500, 0)),  # to starboard
    Order(time=32.0),
    Order(time=40.0, sticks=(0, 0, 500, 200)),  # turn to starboard
    Order(time=42.0),
    Order(time=48.0, sticks=(0, 0, 800, 0)),  # up
    Order(time=50.0),
    Order(time=52.0, sticks=(0, 0, 200, 0)),  # down
    Order(time=54.0),
    Order(time=58.0, mode=STABILIZE),
    Order(time=62.0, sticks=(0, 400, 500, 0)),
    Order(time=67.0),
    Order(time=75.0, mode=ALT_HOLD),
    Order(time=100.0, mode=POSHOLD),
    Order(time=125.0, sticks=(400, 0, 500, 0)),
    Order(time=129.0),
]


@pytest.fixture(scope="module")
def trial() -> Trial:
    return fly(ORDERS, 145.0)


def displacement(trial: Trial, start: float, end: float) -> np.ndarray:
    """Return the displacement between two times in the axes of the base at the first one."""
    positions = trial.positions(start, end)
    (rotation,) = [axes for time, _, axes in trial.poses if abs(time - start) < 0.05]
    body: np.ndarray = rotation.T @ (positions[-1] - positions[0])
    return body


def test_the_estimator_aligns_and_arming_needs_no_force(trial: Trial) -> None:
    assert any("tilt alignment complete" in text for text in trial.texts)
    assert any("yaw alignment complete" in text for text in trial.texts)
    assert "Arming motors" in trial.texts
    assert trial.messages["HEARTBEAT"].base_mode & 128


def test_ardusub_uses_the_velocity_of_the_dvl(trial: Trial) -> None:
    assert any("fusing odometry" in text for text in trial.texts)


@pytest.mark.parametrize(
    ("start", "axis", "sign"),
    [(22.0, 0, 1.0), (30.0, 1, 1.0), (48.0, 2, -1.0), (52.0, 2, 1.0)],
    ids=["forward", "starboard", "up", "down"],
)
def test_each_stick_moves_the_vehicle_along_its_axis(
    trial: Trial, start: float, axis: int, sign: float
) -> None:
    body = displacement(trial, start, start + 2.1)
    assert sign * body[axis] > 0.1
    other_distances = [abs(body[i]) for i in range(2) if i != axis]
    assert max(other_distances) < 0.05


def test_the_stick_of_yaw_turns_to_starboard(trial: Trial) -> None:
    headings = trial.headings(40.0, 42.1)
    assert headings[-1] - headings[0] > math.radians(20.0)


def test_a_strafe_does_not_turn_the_vehicle(trial: Trial) -> None:
    headings = trial.headings(62.0, 70.0)
    assert np.ptp(headings) < math.radians(5.0)
    assert displacement(trial, 62.0, 67.1)[1] > 0.5


def test_depth_is_held_within_a_tenth_of_a_metre(trial: Trial) -> None:
    depths = trial.positions(80.0, 100.0)[:, 2]
    assert np.ptp(depths) < 0.1


def test_position_is_held_by_the_dvl_alone(trial: Trial) -> None:
    positions = trial.positions(105.0, 125.0)
    assert float(np.ptp(positions, axis=0).max()) < 0.2


def test_the_vehicle_stays_where_the_pilot_has_left_it(trial: Trial) -> None:
    assert displacement(trial, 125.0, 129.1)[0] > 0.2
    positions = trial.positions(138.0, 145.0)
    assert float(np.ptp(positions, axis=0).max()) < 0.1


def test_two_runs_of_ardusub_exchange_the_same_bytes() -> None:
    """Compare two runs with `PARAMETERS`: ArduSub writes no log and begins at a given time."""
    orders = [order for order in ORDERS if order.time < 26.0]
    orders.append(Order(time=26.0, mode=ALT_HOLD))
    trials = [fly(orders, 32.0) for _ in range(2)]
    assert trials[0].packets == trials[1].packets
    assert trials[0].answers == trials[1].answers
