"""Plots of a result over its levels.

Every plot is drawn from results alone. Axes have units. A loss (the first level that did not end
``ok``) is a vertical line with the level; if several curves share the axes, a cross marks the last
value before the loss. Bands are 95 % intervals of the mean over repeats. A hollow marker means that
some repeats have no value. The control run (`frozen`, which reads no image) is a dashed line, or
only named in the legend if its values are far above. If a column has no values, the reason is
written on the axes. No plot has a title.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from matplotlib.figure import Figure

from ...base.files.file_names import file_names
from ...errors import ResultError
from ...results.result import Result
from .curves import algorithm_of, curves_of, repeats_of
from .drawing import (
    CONTROL_ALGORITHM,
    CONTROL_STYLE,
    MAX_INSIDE,
    add_legend,
    curve_style,
    draw_column,
    draw_curve,
    draw_end,
    draw_prediction,
    label_axes,
    legend_entries,
    scale_axes,
    with_loss,
    write_no_data,
)
from .save import save_pdf, save_plot
from .style import SIZE, shorten_name, styled_figure, write_note

OVERVIEW_NAME = "all-measures"
MAX_PANELS_IN_COLUMN = 8
"""The greatest number of panels in one column; more are in two columns."""


def value_plot(result: Result, column: str, *, control: Result | None = None) -> Figure:
    """Draw one column over the levels; ``control`` is the result of the control run."""
    curves = curves_of(result, column)
    with styled_figure(_widen_for_legend(SIZE, len(curves))) as figure:
        axes = figure.subplots()
        draw_column(axes, result, result.columns[result.index(column)], curves, control)
        add_legend(axes, len(curves))
        write_note(figure, *_notes(result))
    return figure


def small_multiples(result: Result, *, control: Result | None = None) -> Figure:
    """Draw every measure and the total over the same levels, in two columns if there are many."""
    columns = result.columns_of_kind("measure", "score")
    curve_lists = [curves_of(result, column.name) for column in columns]
    n_curves = max(map(len, curve_lists), default=0)
    n_columns = 2 if len(columns) > MAX_PANELS_IN_COLUMN else 1
    n_rows = max(1, math.ceil(len(columns) / n_columns))
    size = (SIZE[0] * n_columns, 0.6 + 1.9 * n_rows)
    with styled_figure(_widen_for_legend(size, n_curves)) as figure:
        grid = figure.subplots(n_rows, n_columns, sharex=True, squeeze=False).T.ravel()
        for axes in grid[len(columns) or 1 :]:
            axes.remove()
        for axes, column, curves in zip(grid, columns, curve_lists, strict=False):
            is_first = axes is grid[0]
            draw_column(axes, result, column, curves, control, has_labels=is_first, label_width=18)
            if is_first:
                add_legend(axes, n_curves)
            is_lowest = axes in (grid[n_rows - 1], grid[len(columns) - 1])
            axes.tick_params(labelbottom=is_lowest)
            if not is_lowest:
                axes.set_xlabel("")
        write_note(figure, *_notes(result))
    return figure


def compare_plot(
    results: Sequence[Result], column: str, *, names: Sequence[str] | None = None
) -> Figure:
    """Draw one column of several results of the same benchmark, with a line for each result.

    Args:
        results: the results to draw.
        column: the name of the column.
        names: the names in the legend; None for the names of the algorithms, with the seed if two
            are equal.

    Raises:
        ResultError: the results sweep different levels, or the column has different units.
    """
    _check_same_axes(results, column)
    with styled_figure((SIZE[0] + 1.6, SIZE[1])) as figure:
        axes = figure.subplots()
        compared_column = results[0].columns[results[0].index(column)]
        named_curves = [
            (shorten_name(f"{name}, {curve.name}" if curve.name else name), result, curve)
            for name, result in zip(names or _unique_names(results), results, strict=True)
            for curve in curves_of(result, column)
        ]
        for i, (name, result, curve) in enumerate(named_curves):
            is_control = algorithm_of(result) == CONTROL_ALGORITHM
            style = CONTROL_STYLE if is_control else curve_style(i, len(named_curves))
            draw_curve(axes, curve, style, with_loss(name, curve))
            draw_end(axes, curve, style)
        curves = [curve for _, _, curve in named_curves]
        scale_axes(axes, curves)
        limits = []
        for result in reversed(results):  # the axes keep the labels of the first result
            label_axes(axes, result, compared_column)
            limits.append(axes.get_xlim())
        axes.set_xlim(min(low for low, _ in limits), max(high for _, high in limits))
        predictions = {result.fact("f_star"): result for result in results}
        predictions.pop(None, None)
        if len(predictions) == 1:  # the same for all results with a prediction
            draw_prediction(axes, next(iter(predictions.values())))
        if all(curve.is_empty for curve in curves):
            write_no_data(axes, next((c.reason for c in curves if c.reason), None))
        figure.legend(*legend_entries(axes), loc="outside right upper")
        write_note(figure, *_notes(results[0], with_algorithm=False))
    return figure


def draw_plots(
    result: Result, directory: Path, *, control: Result | None = None, pdf: bool = False
) -> tuple[Path, ...]:
    """Draw all plots of a result into ``directory``.

    Args:
        result: the result to draw.
        directory: the folder for the plots; it is created if it does not exist.
        control: the result of the control run (`frozen`); None without one.
        pdf: True to write each plot as PDF, too, which takes three times as long.

    Returns:
        The paths of the PNG files: the total first, the overview of all measures last.
    """
    directory.mkdir(parents=True, exist_ok=True)
    files: list[Path] = []

    def save(figure: Figure, name: str) -> None:
        files.append(save_plot(figure, directory / f"{name}.png"))
        if pdf:
            save_pdf(figure, files[-1].with_suffix(".pdf"))

    names = [
        column.name
        for column in result.columns_of_kind("score") + result.columns_of_kind("measure")
    ]
    for name, file in file_names(names, existing_names=[OVERVIEW_NAME]).items():
        save(value_plot(result, name, control=control), file)
    if len(files) > 1:
        save(small_multiples(result, control=control), OVERVIEW_NAME)
    return tuple(files)


def _widen_for_legend(size: tuple[float, float], n_curves: int) -> tuple[float, float]:
    return (size[0] + 1.5, size[1]) if n_curves > MAX_INSIDE else size


def _check_same_axes(results: Sequence[Result], column: str) -> None:
    if not results:
        raise ResultError("A plot of a comparison needs at least one result.")
    first_result = results[0]
    for other in results[1:]:
        names = [[c.name for c in r.columns_of_kind("level")] for r in (first_result, other)]
        if names[0] != names[1]:
            parameters = " and ".join(", ".join(part) for part in names)
            raise ResultError(f"These results sweep different parameters: {parameters}.")
        units = [r.columns[r.index(column)].unit for r in (first_result, other)]
        if units[0] != units[1]:
            raise ResultError(f"{column} is in {units[0]} in one result and {units[1]} in another.")


def _unique_names(results: Sequence[Result]) -> list[str]:
    names = [algorithm_of(result) or f"result {i + 1}" for i, result in enumerate(results)]
    return [
        name if names.count(name) == 1 else f"{name}, seed {result.run.seed}"
        for name, result in zip(names, results, strict=True)
    ]


def _notes(result: Result, *, with_algorithm: bool = True) -> tuple[str, str]:
    """Return the run (file, algorithm, mode, seed, version), and the meaning of the marks."""
    benchmark, run = result.inputs.benchmark, result.run
    n_repeats = len(set(repeats_of(result)))
    seeds = f"{n_repeats} repeats from seed" if n_repeats > 1 else "seed"
    parts = [
        "" if benchmark is None else shorten_name(benchmark[0], 28),
        shorten_name(algorithm_of(result), 28) if with_algorithm else "",
        run.mode or "",
        f"{seeds} {'?' if run.seed is None else run.seed}",
        f"uwsim {run.version or '?'}",
    ]
    marks = (
        "bands: 95 % intervals of the mean; dots: repeats; boxes: quartiles and median; "
        "hollow: not every repeat has a value"
    )
    return " · ".join(part for part in parts if part), marks if n_repeats > 1 else ""
