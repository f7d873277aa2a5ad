"""The experts of the tasks on a panel do them, and nothing does not."""

from __future__ import annotations

import numpy as np
import pytest

import uwsim
from uwsim.algorithms.grasp import BoxPose
from uwsim.algorithms.panel.valve import HANDLE, valve_model


def test_the_handle_is_where_the_model_of_the_panel_has_it() -> None:
    with uwsim.load("valve-scene") as simulation:
        panel, valve = simulation.pose("panel"), simulation.pose("valve1")
    pose = BoxPose.from_pose(panel)
    point = valve_model().grasp_point(pose)
    bar = valve.position - np.array([0.0, 0.0, HANDLE[2] - 0.25])
    np.testing.assert_allclose(point, bar, atol=1e-6)


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
