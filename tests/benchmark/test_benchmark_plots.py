"""What plots promise."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text
from synthetic_results import (
    F_STAR,
    WHY,
    frozen,
    nested,
    nothing_measured,
    one_level,
    visibility,
)

from uwsim.benchmark.plots import (
    compare_plot,
    curves_of,
    draw_plots,
    save_plot,
    small_multiples,
    value_plot,
)
from uwsim.benchmark.result import Result
from uwsim.errors import ResultError


def words(figure: Figure) -> str:
    return "\n".join(text.get_text() for text in figure.findobj(Text))


def vertical_lines(figure: Figure) -> list[float]:
    lines = [line.get_xdata() for line in figure.axes[0].lines]
    return sorted(float(x[0]) for x in lines if len(x) == 2 and x[0] == x[1])


def test_axes_carry_names_and_units() -> None:
    axes = value_plot(visibility(), "corners").axes[0]
    assert axes.get_xlabel() == "fog density [1/m]"
    assert axes.get_ylabel() == "corners [px]"
    assert axes.get_title() == ""


def test_a_loss_and_its_prediction_are_vertical_lines_with_labels() -> None:
    figure = value_plot(visibility(lost_at=1.2), "corners")
    assert vertical_lines(figure) == pytest.approx([F_STAR, 1.2])
    assert "lost at 1.2" in words(figure)
    assert f"$f^*$ = {F_STAR:.2f} m⁻¹" in words(figure)


def test_a_sweep_of_lengths_shows_the_prediction_as_a_length() -> None:
    result = visibility(lost_at=1.2)
    fog, *others = result.columns
    length = replace(fog, name="attenuationLength", unit="m")
    rows = tuple((1.0 / max(row[0], 0.05), *row[1:]) for row in result.rows)  # type: ignore[type-var]
    figure = value_plot(replace(result, columns=(length, *others), rows=rows), "corners")
    assert figure.axes[0].get_xlabel() == "attenuation length [m]"
    assert vertical_lines(figure)[-1] == pytest.approx(1.0 / F_STAR)
    assert f"predicted at {1.0 / F_STAR:.2f} m, $f^*$ = {F_STAR:.2f} m⁻¹" in words(figure)


def test_without_a_loss_and_without_facts_there_is_no_such_line() -> None:
    result = replace(frozen(), facts={})
    assert vertical_lines(value_plot(result, "corners")) == []


def test_the_losses_of_repeats_are_a_span() -> None:
    figure = value_plot(visibility(seeds=tuple(range(1, 11))), "corners")
    assert "lost at 1.15 to 1.25" in words(figure)
    assert "95 % intervals" in words(figure)


def test_the_control_is_dashed_and_named() -> None:
    axes = value_plot(visibility(), "corners", control=frozen()).axes[0]
    styles = {str(line.get_label()): line.get_linestyle() for line in axes.lines}
    assert styles["frozen"] == "--"
    assert styles["esm"] == "-"


def scaled(*factors: float) -> Result:
    result = replace(frozen(), facts={})
    rows = [
        (row[0], *(1.0 * factor for _ in range(6)), "ok", 2.0)
        for row, factor in zip(result.rows, factors, strict=False)
    ]
    return replace(result, rows=tuple(rows))


@pytest.mark.parametrize(
    ("values", "scale"), [((1.0, 49.0), "linear"), ((1.0, 100.0), "log"), ((1e-5, 2.0), "linear")]
)
def test_errors_far_apart_are_drawn_on_a_logarithmic_axis_but_nothing_is_not_an_error(
    values: tuple[float, ...], scale: str
) -> None:
    assert value_plot(scaled(*values), "corners").axes[0].get_yscale() == scale


def test_a_column_without_values_says_why() -> None:
    assert f"no data: {WHY}" in words(value_plot(nothing_measured(), "corners"))


def test_nested_levels_are_one_curve_for_each_outer_level() -> None:
    curves = curves_of(nested(), "corners")
    assert [curve.name for curve in curves] == ["current 0", "current 0.1", "current 0.2"]
    assert [len(curve.x) for curve in curves] == [27, 27, 27]
    assert [(round(x, 9), status) for x, status in curves[0].losses] == [(1.2, "lost")]


def test_several_results_are_one_curve_each_and_the_legend_says_where_they_end() -> None:
    figure = compare_plot([visibility(), visibility("orb", lost_at=0.6), frozen()], "corners")
    assert "esm (lost at 1.2)" in words(figure)
    assert "orb (lost at 0.6)" in words(figure)
    assert "frozen" in words(figure)


def test_the_same_algorithm_twice_is_told_apart_by_its_seed() -> None:
    second = replace(visibility(), run={**visibility().run, "seed": 2})
    assert "esm, seed 2 (lost at 1.2)" in words(compare_plot([visibility(), second], "corners"))


def test_what_cannot_be_compared_is_an_error() -> None:
    with pytest.raises(ResultError, match="sweep different things: fog and current, fog"):
        compare_plot([visibility(), nested()], "corners")
    with pytest.raises(ResultError, match="nothing to compare"):
        compare_plot([], "corners")


@pytest.mark.parametrize("make", [visibility, nothing_measured, one_level, nested, frozen])
def test_any_result_can_be_drawn(make: Callable[[], Result], tmp_path: Path) -> None:
    files = draw_plots(make(), tmp_path / "plots", control=frozen())
    assert [f.name for f in files] == [
        "total.png",
        "corners.png",
        "centroid.png",
        "all-measures.png",
    ]
    assert all(f.read_bytes().startswith(b"\x89PNG") for f in files)


def test_a_result_without_rows_can_be_drawn(tmp_path: Path) -> None:
    empty = replace(visibility(), rows=(), missing=())
    assert "no level was played" in words(small_multiples(empty))
    save_plot(small_multiples(empty), tmp_path / "empty.png")


def test_a_plot_has_the_same_bytes_every_time(tmp_path: Path) -> None:
    first = save_plot(value_plot(visibility(), "total"), tmp_path / "a.png").read_bytes()
    assert save_plot(value_plot(visibility(), "total"), tmp_path / "b.png").read_bytes() == first


def test_a_dollar_or_a_slash_in_a_name_is_no_mathematics_and_no_folder(tmp_path: Path) -> None:
    result = visibility()
    columns = [replace(c, name="$\\evil/$") if c.name == "corners" else c for c in result.columns]
    files = draw_plots(replace(result, columns=tuple(columns), missing=()), tmp_path)
    assert {f.parent for f in files} == {tmp_path}
