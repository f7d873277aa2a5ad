"""What plots promise."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text

from tests.support.synthetic_results import (
    F_STAR,
    LOSS_REASON,
    frozen_result,
    lost_result,
    nested_result,
    one_level_result,
    visibility_result,
)
from uwsim.analysis.plots import (
    INK,
    compare_plot,
    curves_of,
    draw_plots,
    save_plot,
    small_multiples,
    value_plot,
)
from uwsim.analysis.plots.drawing import MAX_LEGEND_ENTRIES
from uwsim.errors import ResultError
from uwsim.results.inputs import Inputs
from uwsim.results.result import Column, Result


def words(figure: Figure) -> str:
    return "\n".join(text.get_text() for text in figure.findobj(Text))


def vertical_lines(figure: Figure) -> list[float]:
    lines = [line.get_xdata() for line in figure.axes[0].lines]
    return sorted(float(x[0]) for x in lines if len(x) == 2 and x[0] == x[1])


def test_axes_carry_names_and_units() -> None:
    axes = value_plot(visibility_result(), "corners").axes[0]
    assert axes.get_xlabel() == "fog density [m⁻¹]"
    assert axes.get_ylabel() == "corners [px]"
    assert axes.get_title() == ""
    assert value_plot(visibility_result(), "total").axes[0].get_ylabel() == "total [px]"


def test_a_loss_and_its_prediction_are_vertical_lines_with_labels() -> None:
    figure = value_plot(visibility_result(lost_at=1.2), "corners")
    assert vertical_lines(figure) == pytest.approx([F_STAR, 1.2])
    assert "lost at 1.2" in words(figure)
    assert f"$f^*$ = {F_STAR:.2f} m⁻¹" in words(figure)


def test_a_sweep_of_lengths_shows_the_prediction_as_a_length() -> None:
    result = visibility_result(lost_at=1.2)
    fog, *others = result.columns
    length = replace(fog, name="attenuationLength", unit="m")
    rows = tuple((1.0 / max(row[0], 0.05), *row[1:]) for row in result.rows)  # type: ignore[type-var]
    figure = value_plot(replace(result, columns=(length, *others), rows=rows), "corners")
    assert figure.axes[0].get_xlabel() == "attenuation length [m]"
    assert vertical_lines(figure)[-1] == pytest.approx(1.0 / F_STAR)
    assert f"predicted loss at {1.0 / F_STAR:.2f} m, $f^*$ = {F_STAR:.2f} m⁻¹" in words(figure)


def test_without_a_loss_and_without_facts_there_is_no_such_line() -> None:
    result = replace(frozen_result(), facts={})
    assert vertical_lines(value_plot(result, "corners")) == []


def test_the_losses_of_repeats_are_a_span() -> None:
    figure = value_plot(visibility_result(seeds=tuple(range(1, 11))), "corners")
    assert "lost at 1.15 to 1.25" in words(figure)
    assert "95 % intervals" in words(figure)


def test_the_control_is_dashed_and_named() -> None:
    axes = value_plot(visibility_result(), "corners", control=frozen_result()).axes[0]
    styles = {str(line.get_label()): line.get_linestyle() for line in axes.lines}
    assert styles["frozen"] == "--"
    assert styles["esm"] == "-"


def scaled(*factors: float) -> Result:
    result = replace(frozen_result(), facts={})
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
    said = words(value_plot(lost_result(), "corners"))
    assert f"no data: {LOSS_REASON}" in said.replace("\n", " ")


def test_nested_levels_are_one_curve_for_each_outer_level() -> None:
    curves = curves_of(nested_result(), "corners")
    assert [curve.name for curve in curves] == [
        "current 0 m/s",
        "current 0.1 m/s",
        "current 0.2 m/s",
    ]
    assert [len(curve.x) for curve in curves] == [27, 27, 27]
    assert [(round(x, 9), status) for x, status in curves[0].losses] == [(1.2, "lost")]


def test_nested_curves_end_in_a_cross_and_the_legend_says_where() -> None:
    figure = value_plot(nested_result(), "corners")
    assert [line.get_marker() for line in figure.axes[0].lines].count("x") == 3
    assert "current 0.1 m/s (lost at 1.2)" in words(figure)
    assert vertical_lines(figure) == []


def test_many_curves_look_all_different_and_stand_in_a_legend_beside_the_axes() -> None:
    one = visibility_result(lost_at=2.0)
    columns = (Column(name="current", kind="level", unit="m/s"), *one.columns)
    rows = tuple((0.01 * i, *row) for i in range(30) for row in one.rows)
    many = replace(one, columns=columns, rows=rows, facts={})
    figure = value_plot(many, "corners")
    named = [line for line in figure.axes[0].lines if not str(line.get_label()).startswith("_")]
    assert len({line.get_color() for line in named}) == 30
    assert figure.axes[0].get_legend() is None
    (legend,) = figure.legends
    shown = [text.get_text() for text in legend.get_texts()]
    assert len(shown) == MAX_LEGEND_ENTRIES
    assert (shown[0], shown[-1]) == ("current 0 m/s", "current 0.29 m/s")


def test_a_control_far_above_is_named_and_does_not_press_the_curve_flat() -> None:
    rows = tuple((row[0], *[48.6] * 6, *row[7:]) for row in frozen_result().rows)
    figure = value_plot(visibility_result(), "corners", control=replace(frozen_result(), rows=rows))
    assert "frozen: 48.6, above" in words(figure)
    assert figure.axes[0].get_ylim()[1] < 10
    near = tuple((row[0], *[4.0] * 6, *row[7:]) for row in frozen_result().rows)
    figure = value_plot(visibility_result(), "corners", control=replace(frozen_result(), rows=near))
    assert "above" not in words(figure)
    assert figure.axes[0].get_ylim()[1] > 4


def test_the_value_of_a_control_is_that_of_its_means_not_of_their_intervals() -> None:
    (found,) = curves_of(frozen_result(), "corners")
    curve = replace(found, x=(0.0, 1.0), mean=(104.64, 104.64), low=(70.0,) * 2, high=(148.0,) * 2)
    assert curve.mean_text == "105"
    assert replace(curve, mean=(32.0, 48.6)).mean_text == "32 to 48.6"
    assert replace(curve, mean=(math.nan, 48.6)).mean_text == "48.6"


def test_few_levels_have_a_tick_each_and_iterations_are_whole_numbers() -> None:
    few = replace(frozen_result(), rows=frozen_result().rows[:3])
    assert list(value_plot(few, "corners").axes[0].get_xticks()) == [0.0, 0.05, 0.1]
    columns = (Column(name="iteration", kind="level"), *frozen_result().columns[1:])
    rows = tuple((float(i), *row[1:]) for i, row in enumerate(frozen_result().rows[:9]))
    counted = replace(frozen_result(), columns=columns, rows=rows, facts={})
    assert all(x.is_integer() for x in value_plot(counted, "corners").axes[0].get_xticks())


def test_very_long_names_leave_nothing_outside_the_figure() -> None:
    base, long = visibility_result(), "a_measure_whose_name_tells_a_very_long_story_" * 2
    columns = tuple(replace(c, name=long) if c.name == "corners" else c for c in base.columns)
    result = replace(
        base,
        columns=columns,
        missing_values=(),
        inputs=Inputs(benchmark=(f"{long}.xml", "sha256:0")),
        run=replace(base.run, algorithm=f"package:{long}"),
    )
    for figure in (value_plot(result, long, control=frozen_result()), small_multiples(result)):
        renderer = FigureCanvasAgg(figure).get_renderer()
        figure.draw(renderer)
        for text in figure.findobj(Text):
            if len(text.get_text()) > 20:
                box = text.get_window_extent(renderer)
                assert box.x0 >= 0
                assert box.x1 <= figure.bbox.width + 1


def test_several_results_are_one_curve_each_and_the_legend_says_where_they_end() -> None:
    figure = compare_plot(
        [visibility_result(), visibility_result("orb", lost_at=0.6), frozen_result()], "corners"
    )
    assert "esm (lost at 1.2)" in words(figure)
    assert "orb (lost at 0.6)" in words(figure)
    assert "frozen" in words(figure)


def test_a_comparison_shows_the_predicted_loss_of_those_that_have_one() -> None:
    no_rule = replace(frozen_result(), facts={})
    figure = compare_plot([no_rule, visibility_result()], "corners")
    assert vertical_lines(figure)[:1] == pytest.approx([F_STAR])
    assert vertical_lines(compare_plot([no_rule, no_rule], "corners")) == []
    stricter = replace(visibility_result(), facts={"f_star": (0.9 * F_STAR, "1/m")})
    figure = compare_plot([visibility_result(), stricter], "corners")
    assert "predicted" not in words(figure)  # one line would be wrong for one of them


def test_the_same_algorithm_twice_is_distinguished_by_its_seed() -> None:
    second = replace(visibility_result(), run=replace(visibility_result().run, seed=2))
    assert "esm, seed 2 (lost at 1.2)" in words(
        compare_plot([visibility_result(), second], "corners")
    )


def test_what_cannot_be_compared_is_an_error() -> None:
    with pytest.raises(ResultError, match="sweep different parameters: fog and current, fog"):
        compare_plot([visibility_result(), nested_result()], "corners")
    with pytest.raises(ResultError, match="needs at least one result"):
        compare_plot([], "corners")


@pytest.mark.parametrize(
    "make", [visibility_result, lost_result, one_level_result, nested_result, frozen_result]
)
def test_any_result_can_be_drawn(make: Callable[[], Result], tmp_path: Path) -> None:
    files = draw_plots(make(), tmp_path / "plots", control=frozen_result())
    assert [f.name for f in files] == [
        "total.png",
        "corners.png",
        "centroid.png",
        "all-measures.png",
    ]
    assert all(f.read_bytes().startswith(b"\x89PNG") for f in files)


@pytest.mark.slow
def test_plots_come_as_pdf_too_when_asked(tmp_path: Path) -> None:
    base = visibility_result()
    kept = [base.index(name) for name in ("fog", "total", "status")]
    result = replace(
        base,
        columns=tuple(base.columns[k] for k in kept),
        rows=tuple(tuple(row[k] for k in kept) for row in base.rows),
        missing_values=(),
    )
    draw_plots(result, tmp_path)
    assert [file.name for file in tmp_path.iterdir()] == ["total.png"]
    draw_plots(result, tmp_path, pdf=True)
    first = (tmp_path / "total.pdf").read_bytes()
    assert first.startswith(b"%PDF")
    draw_plots(result, tmp_path, pdf=True)
    assert (tmp_path / "total.pdf").read_bytes() == first


def test_a_result_without_rows_can_be_drawn(tmp_path: Path) -> None:
    empty = replace(visibility_result(), rows=(), missing_values=())
    assert "no level was run" in words(small_multiples(empty))
    save_plot(small_multiples(empty), tmp_path / "empty.png")


@pytest.mark.parametrize(("n", "across"), [(8, 1), (9, 2), (16, 2), (17, 2)])
def test_many_measures_stand_in_two_columns_with_levels_below_each(n: int, across: int) -> None:
    base = visibility_result()
    k = base.index("corners")
    more = tuple(replace(base.columns[k], name=f"m{i}") for i in range(n - 3))
    result = replace(
        base,
        columns=(*base.columns, *more),
        rows=tuple((*row, *(row[k] for _ in more)) for row in base.rows),
    )
    figure = small_multiples(result)
    panels = figure.get_axes()
    assert len(panels) == n
    lefts = {round(axes.get_position().x0, 1) for axes in panels}
    assert len(lefts) == across
    assert sum(axes.get_xlabel() != "" for axes in panels) == across
    assert figure.get_size_inches()[1] <= 0.6 + 1.9 * max(8, math.ceil(n / 2))


def test_a_plot_has_the_same_bytes_every_time(tmp_path: Path) -> None:
    first = save_plot(value_plot(visibility_result(), "total"), tmp_path / "a.png").read_bytes()
    assert (
        save_plot(value_plot(visibility_result(), "total"), tmp_path / "b.png").read_bytes()
        == first
    )


def test_a_dollar_or_a_slash_in_a_name_is_no_mathematics_and_no_folder(tmp_path: Path) -> None:
    result = visibility_result()
    columns = [replace(c, name="$\\evil/$") if c.name == "corners" else c for c in result.columns]
    files = draw_plots(replace(result, columns=tuple(columns), missing_values=()), tmp_path)
    assert {f.parent for f in files} == {tmp_path}


def test_each_repeat_is_a_point_and_each_level_of_five_or_more_a_box() -> None:
    result = visibility_result(seeds=(1, 2, 3, 4, 5, 6), lost_at=0.3)
    (axes,) = value_plot(result, "corners").axes
    (curve,) = curves_of(result, "corners")
    lines = [line for line in axes.lines if line.get_marker() == "o" and line.get_alpha() == 0.55]
    points = np.sort(np.concatenate([line.get_ydata() for line in lines]))
    assert points == pytest.approx(sorted(v for values in curve.values for v in values))
    boxed = [values for values in curve.values if len(values) >= 5]
    medians = [
        line.get_ydata()[0]
        for line in axes.lines
        if line.get_color() == INK and line.get_linewidth() == 1.0
    ]
    assert medians == pytest.approx([float(np.median(values)) for values in boxed])
    assert axes.get_xlim()[0] < 0.0


@pytest.mark.parametrize("seeds", [(1,), (1, 2)])
def test_few_repeats_have_no_box(seeds: tuple[int, ...]) -> None:
    (axes,) = value_plot(visibility_result(seeds=seeds), "corners").axes
    assert not [line for line in axes.lines if line.get_color() == INK]
