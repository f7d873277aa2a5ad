"""The times to success of two algorithms: failures count, pairs are used, texts are honest."""

from __future__ import annotations

import csv
import io
import json
from dataclasses import replace

import pytest
from rich.console import Console

from tests.support.compared_results import entries, make_result
from tests.support.grasp_results import grasping_result
from uwsim.analysis.comparison import Comparison, compare, shared_column
from uwsim.analysis.comparison.document import csv_text, json_text
from uwsim.analysis.comparison.page import render
from uwsim.analysis.comparison.plots import times_plot
from uwsim.analysis.comparison.terminal import renderables
from uwsim.analysis.comparison.time_table import time_lines, time_sentence
from uwsim.results.result import Result
from uwsim.statistics import mean_interval, sign_flip

LIMIT = 240.0
SEEDS = 8


def task_result(algorithm: str, times: dict[tuple[float, float], list[float | str]]) -> Result:
    """Return a task with a time of success [s], or a status, for each seed of each level."""
    result = grasping_result(SEEDS)
    rows = []
    for row in result.rows:
        if (values := times.get((row[2], row[3]))) is not None:  # type: ignore[call-overload]
            value = values[int(row[0])]  # type: ignore[arg-type]
            is_ok = not isinstance(value, str)
            duration = value if is_ok else (LIMIT if value == "timeout" else 20.0)
            score = (duration if is_ok else None, "ok" if is_ok else value, duration)
            rows.append((*row[:4], float(is_ok), *[None] * 5, duration, *score))
    run = replace(result.run, algorithm=algorithm)
    return replace(result, rows=tuple(rows), missing_values=(), run=run)


def compared(*results: Result) -> Comparison:
    found = entries(*results)
    return compare(found, shared_column(found, None))


FAST: list[float | str] = [30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0, 100.0]
SLOW: list[float | str] = [90.0, 95.0, "timeout", 110.0, "dropped", 120.0, "timeout", 130.0]


@pytest.fixture(scope="module")
def comparison() -> Comparison:
    levels = {(0.0, 0.0): FAST, (0.5, 0.0): SLOW}, {(0.0, 0.0): SLOW, (0.5, 0.0): SLOW}
    return compared(task_result("fast", levels[0]), task_result("slow", levels[1]))


def test_a_failure_counts_with_the_time_limit_in_its_pair(comparison: Comparison) -> None:
    times = comparison.pairs[0].times
    assert times is not None
    assert times.limit == LIMIT
    easy, hard = times.levels
    slow = [90.0, 95.0, 240.0, 110.0, 240.0, 120.0, 240.0, 130.0]
    differences = [b - float(a) for a, b in zip(FAST, slow, strict=True)]
    assert easy.difference.difference == mean_interval(differences)
    assert easy.difference.p == sign_flip(differences) == 2 / 2**8
    assert easy.difference.verdict == "first"
    assert (easy.first.n_successes, easy.second.n_successes) == (8, 5)
    assert (easy.first.median.value, easy.second.median.value) == (60.0, 120.0)
    assert hard.difference.verdict == "equal"
    assert hard.p_log_rank == 1.0
    assert times.sweep.difference.mean == pytest.approx(sum(differences) / 16)
    assert times.sweep.verdict == "first"


def test_the_mean_over_successes_alone_has_fewer_pairs(comparison: Comparison) -> None:
    """The trap that the times avoid: the score has no value where a trial failed."""
    easy = comparison.pairs[0].levels[0]
    assert easy.value.difference.n == 5


def test_the_p_values_of_levels_are_corrected_together() -> None:
    both = {(0.0, 0.0): FAST, (0.5, 0.0): FAST}
    other = {(0.0, 0.0): SLOW, (0.5, 0.0): SLOW}
    times = compared(task_result("fast", both), task_result("slow", other)).pairs[0].times
    assert times is not None
    assert [t.difference.p_holm for t in times.levels] == pytest.approx([4 / 2**8] * 2)


def test_results_without_a_task_have_no_times() -> None:
    values = {0.0: [1.0] * 3}
    comparison = compared(make_result("esm", values), make_result("ic", values))
    assert comparison.pairs[0].times is None
    assert times_plot(comparison) is None
    assert "time_median_first" not in csv_text(comparison).splitlines()[0]
    assert "times" not in json.loads(json_text(comparison))["pairs"][0]


def test_nobody_who_succeeds_has_no_times() -> None:
    lost = {(0.0, 0.0): ["dropped"] * 8}
    pair = compared(task_result("a", lost), task_result("b", lost)).pairs[0]
    assert pair.times is None
    assert time_lines(pair) == ()


def test_the_numbers_are_in_every_output(comparison: Comparison) -> None:
    pair = comparison.pairs[0]
    easy = time_lines(pair)[0]
    assert easy.first == "8 of 8, 60.0 [30.0, 100.0]"
    assert easy.second == "5 of 8, 120.0 [90.0, -]"
    assert easy.verdict == "fast better"
    sentence = time_sentence(comparison, pair)
    assert sentence.startswith("Mean time to success, at most 240 s: fast 112 s, slow 158 s;")
    assert sentence.endswith("p 0.008 (sign-flip test): fast is faster.")
    console = Console(width=160, file=io.StringIO(), record=True)
    for part in renderables(comparison, width=160):
        console.print(part)
    text = console.export_text()
    assert sentence[:60] in text
    assert easy.second in text
    page = render(comparison, [])
    assert sentence in page
    assert easy.second in page
    rows = list(csv.DictReader(io.StringIO(csv_text(comparison))))
    assert rows[0]["time_median_second"] == "120.0"
    assert rows[0]["time_median_second_high"] == ""
    assert (rows[2]["scope"], rows[2]["time_verdict"]) == ("sweep", "first")
    times = json.loads(json_text(comparison))["pairs"][0]["times"]
    assert times["limit"] == LIMIT
    assert times["levels"][0]["p_time_log_rank"] == pytest.approx(2 / 2**8)


def test_the_plot_has_a_curve_for_each_result(comparison: Comparison) -> None:
    figure = times_plot(comparison)
    assert figure is not None
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert texts == ["fast (13 of 16)", "slow (10 of 16)"]
