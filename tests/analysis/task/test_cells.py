"""Success by level, classes of failure, crossings of 50 % in words, phases."""

from __future__ import annotations

from pathlib import Path

import pytest
from PIL import Image

from tests.support.grasp_results import CURRENTS, FOGS, grasping_result, is_successful
from tests.support.synthetic_results import visibility_result
from uwsim.analysis.report.task_section import task_section
from uwsim.analysis.task import (
    TaskCell,
    cells_along,
    crossing_sentence,
    draw_task_figures,
    figures,
    find_crossings,
    phase_means,
    task_cells,
    task_measure,
)
from uwsim.results.result import Result


def test_only_a_result_with_a_judge_is_of_a_task() -> None:
    judge = task_measure(grasping_result())
    assert judge is not None
    assert judge.name == "success"
    assert task_measure(visibility_result()) is None
    assert task_section(visibility_result(), Path()) is None


def test_each_level_has_its_successes_with_exact_limits_and_its_failures() -> None:
    cells = task_cells(grasping_result())
    assert [cell.level for cell in cells] == [(f, c) for f in FOGS for c in CURRENTS]
    for cell in cells:
        n_ok = sum(is_successful(*cell.level, seed) for seed in range(4))
        assert (cell.success.successes, cell.success.n) == (n_ok, 4)
        assert sum(cell.failures.values()) == 4 - n_ok
    first = cells[0].success
    assert (first.low, first.high) == (pytest.approx(0.025 ** (1 / 4)), 1.0)
    assert cells[-1].failures == {"not found": 4}


def test_medians_are_over_the_successes() -> None:
    result = grasping_result()
    cells = task_cells(result)
    assert cells[0].median(result, "success.slip") == pytest.approx(0.0025)
    assert cells[0].median(result, "time") == pytest.approx(55.0)
    assert cells[-1].median(result, "time") is None


def test_a_line_of_cells_varies_one_parameter() -> None:
    line = cells_along(task_cells(grasping_result()), 0, (0.0, 0.1))
    assert [cell.level for cell in line] == [(0.0, 0.1), (0.5, 0.1), (1.0, 0.1)]


def test_where_the_rate_crosses_half_is_said_in_words() -> None:
    result = grasping_result()
    said = [crossing_sentence(result, each) for each in find_crossings(result)]
    assert (
        "At current 0.1 m/s the success rate falls below 50 % between fog density 0.5 and 1 m⁻¹ "
        "(2 of 4, then 1 of 4)." in said
    )
    assert "At fog 0 m⁻¹ the success rate is 50 % or above up to current 0.3 m/s (2 of 4)." in said
    assert (
        "At current 0.3 m/s the success rate falls below 50 % between fog density 0 and 0.5 m⁻¹ "
        "(2 of 4, then 0 of 4)." in said
    )
    assert len(said) == len(CURRENTS) + len(FOGS)


def test_a_first_level_that_is_below_half_says_so() -> None:
    result = grasping_result()
    cells = [cell for cell in task_cells(result) if cell.success.value < 0.5]
    assert cells
    found = [each for each in find_crossings(result) if each.last_above is None]
    for each in found:
        assert "from the first level on" in crossing_sentence(result, each)


def test_the_mean_time_in_each_phase() -> None:
    result = grasping_result()
    assert phase_means(result, task_cells(result)[0]) == {"search": 10.0, "lift": 15.0}


def test_the_legend_has_the_phases_of_all_panels(monkeypatch: pytest.MonkeyPatch) -> None:
    def means(result: Result, cell: TaskCell) -> dict[str, float]:
        return {"search": 9.0} | ({} if cell.level[1] == CURRENTS[0] else {"lift": 15.0})

    monkeypatch.setattr(figures, "phase_means", means)
    result = grasping_result()
    figure = figures.phase_times(result, task_cells(result), [0, 1])
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["lift", "search"]


@pytest.mark.slow
def test_the_figures_are_drawn_and_the_same_every_time(tmp_path: Path) -> None:
    first = draw_task_figures(grasping_result(), tmp_path / "a")
    again = draw_task_figures(grasping_result(), tmp_path / "b")
    assert [path.name for path in first] == [
        "success-map.png", "success-rates.png", "success-times.png", "phases.png",
    ]  # fmt: skip
    for one, other in zip(first, again, strict=True):
        assert one.read_bytes() == other.read_bytes()
        with Image.open(one) as image:
            assert image.size[0] > 600


def test_the_section_of_the_report(tmp_path: Path) -> None:
    section = task_section(grasping_result(), tmp_path)
    assert section is not None
    n_ok = sum(is_successful(f, c, s) for f in FOGS for c in CURRENTS for s in range(4))
    assert section.lead == f"{n_ok} of 48 episodes succeeded."
    assert section.rows[0].success == "4 of 4"
    assert section.rows[0].limits == "40 to 100 %"
    assert (section.rows[0].time, section.rows[0].time_limits) == ("50.0", "0.0 to –")
    assert section.rows[-1].failures == "4 not found"
    assert section.rows[-1].time == "–"
    assert section.rows[-1].medians == ("–", "–")
    assert [name for name, _ in section.median_heads] == ["time", "slip"]
