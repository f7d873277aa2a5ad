"""The experts of the tasks on a panel do them, and nothing does not."""

from __future__ import annotations

import numpy as np
import pytest

import uwsim
from uwsim.algorithms.grasp import BoxPose
from uwsim.algorithms.grasp.arm import Arm5e
from uwsim.algorithms.grasp.station import StationController
from uwsim.algorithms.grasp.task import Task
from uwsim.algorithms.grasp.vehicle_interface import VehicleInterface
from uwsim.algorithms.panel.valve import HANDLE, Valve, ValveRigid, valve_model
from uwsim.algorithms.panel.valve_phases import OVERTRAVEL, TURN


def test_the_handle_is_where_the_model_of_the_panel_has_it() -> None:
    with uwsim.load("valve-scene") as simulation:
        panel, valve = simulation.pose("panel"), simulation.pose("valve1")
    pose = BoxPose.from_pose(panel)
    point = valve_model().grasp_point(pose)
    bar = valve.position - np.array([0.0, 0.0, HANDLE[2] - 0.25])
    np.testing.assert_allclose(point, bar, atol=1e-6)


def turn(algorithm: type[Valve]) -> tuple[str, float, float]:
    """Turn with nothing in the jaw, and joints that stay where they are.

    Returns:
        The next phase, its time [s], and the angle to which the wrist was commanded [rad].
    """
    vehicle = VehicleInterface(
        StationController(kp=0.6, ki=0.03, feeds_forward=True, limit=0.3), Arm5e()
    )
    valve = algorithm()
    task = Task(vehicle, valve.perception(), valve.model(), algorithm.PARAMETERS, lambda text: None)
    phase = algorithm.PHASES["turn"]()
    phase.enter(task)
    for step in range(300):
        task.now = 0.1 * step
        if (following := phase.step(task)) is not None:
            return following, task.now, float(vehicle.posture[3])
    raise AssertionError("the turn has no end")


def test_without_feedback_the_wrist_turns_for_its_time_with_nothing_in_the_jaw() -> None:
    following, time, angle = turn(ValveRigid)
    assert following == "release"
    assert time == pytest.approx((TURN + OVERTRAVEL) / 0.25 + 2.0, abs=0.15)
    assert angle == pytest.approx(-(TURN + OVERTRAVEL))


def test_with_feedback_the_turn_fails_at_once_with_nothing_in_the_jaw() -> None:
    following, time, angle = turn(Valve)
    assert (following, time, angle) == ("retry", 0.0, 0.0)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("task", "levels"),
    [
        ("valve", {"friction": [5.0], "current": [0.3]}),
        ("plug", {"hole": [0.06], "current": [0.0]}),
    ],
)
def test_the_expert_does_the_task(task: str, levels: dict[str, list[float]]) -> None:
    result = uwsim.bench(task, algorithm=f"{task}-truth", seeds=(1,), levels=levels)
    assert result.values("status") == ("ok",)


@pytest.mark.slow
def test_without_commands_the_valve_stays() -> None:
    levels = {"friction": [1.0], "current": [0.0]}
    result = uwsim.bench("valve", algorithm="nothing", seeds=(1,), levels=levels)
    assert result.values("status") == ("untouched",)
    names = [column.name for column in result.columns]
    assert abs(result.rows[0][names.index("angle")]) < 1e-6
