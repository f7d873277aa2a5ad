"""Which time a row counts with: successes, time limits, failures, sequences."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from tests.support.compared_results import make_result
from tests.support.grasp_results import grasping_result
from uwsim.analysis.task import restricted_time, success_times, task_cells, time_limit
from uwsim.analysis.task.figures import times_to_success
from uwsim.results.result import Result
from uwsim.statistics import TrialTime


def with_statuses(statuses: list[str], ends: list[float], done_time: float | None = None) -> Result:
    """Return a task of one level, a row for each status, all with the same ``time_done`` [s]."""
    result = grasping_result(len(statuses))
    rows = [row for row in result.rows if row[2:4] == (0.0, 0.0)]
    return replace(
        result,
        rows=tuple(
            (*row[:6], done_time, *row[7:-2], status, end)
            for row, status, end in zip(rows, statuses, ends, strict=True)
        ),
        missing_values=(),
    )


def test_failures_never_succeed_and_time_limits_are_censored() -> None:
    statuses = ["ok", "timeout", "dropped", "simulation error"]
    trials = success_times(with_statuses(statuses, [40.0, 240.0, 31.0, 7.0]))
    assert trials == (
        TrialTime(time=40.0, has_succeeded=True),
        TrialTime(time=240.0, has_succeeded=False),
        TrialTime(time=math.inf, has_succeeded=False),
        TrialTime(time=7.0, has_succeeded=False),
    )
    limit = time_limit(trials)
    assert limit == 240.0
    assert [restricted_time(trial, limit) for trial in trials] == [40.0, 240.0, 240.0, None]
    assert time_limit(trials[2:3]) is None


def test_a_success_counts_from_when_it_held_not_from_the_end_of_the_level() -> None:
    trials = success_times(with_statuses(["ok", "left"], [60.0, 60.0], done_time=12.5))
    assert trials == (
        TrialTime(time=12.5, has_succeeded=True),
        TrialTime(time=math.inf, has_succeeded=False),
    )


def test_the_times_of_a_sequence_are_summed_over_its_levels() -> None:
    result = make_result("esm", {0.0: [1.0, 1.0], 0.5: [1.0, None], 1.0: [1.0, 1.0]})
    result = replace(result, run=replace(result.run, mode="sequential"))
    trials = success_times(result)  # ended_at is 2, 4, 6 s in each repeat
    assert trials is not None
    assert [trial.time for trial in trials] == [2.0, 2.0, 2.0, 2.0, math.inf, 2.0]


def test_without_status_there_are_no_times() -> None:
    result = make_result("esm", {0.0: [1.0]})
    columns = tuple(replace(c, kind="run") if c.name == "seed" else c for c in result.columns)
    without = replace(result, columns=columns[:-2], rows=tuple(row[:-2] for row in result.rows))
    assert success_times(without) is None


def test_the_figure_has_the_successes_of_each_level() -> None:
    result = grasping_result()
    figure = times_to_success(result, task_cells(result), [0, 1])
    assert figure is not None
    texts = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert texts == ["fog 0 m⁻¹ (4 of 4)", "fog 0.5 m⁻¹ (3 of 4)", "fog 1 m⁻¹ (2 of 4)"]
    # seeds 0 to 3 succeed after 40, 50, 60, 70 s
    assert figure.axes[0].lines[0].get_xdata().tolist() == [0.0, 40.0, 50.0, 60.0, 70.0, 70.0]
    assert figure.axes[0].lines[0].get_ydata()[-1] == pytest.approx(1.0)
    failed = replace(
        result, rows=tuple((*row[:-2], "missed", row[-1]) for row in result.rows), missing_values=()
    )
    assert times_to_success(failed, task_cells(failed), [0]) is None
