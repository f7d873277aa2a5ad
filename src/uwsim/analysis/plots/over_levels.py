"""Plots of a result over its levels.

Every plot is drawn from results alone. Axes carry units; a loss is a vertical line with its level,
or where several curves share the axes a cross at the last value before it. Bands are 95 % intervals
of the mean over repeats (a hollow marker: not every repeat has a value), the control (`frozen`,
which never looks at an image) is a dashed line, named but left outside when it is far above. A
column without values says why instead of showing nothing. No plot has a title: what was found is
for the reader to say.
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
    CONTROL,
    CONTROL_LOOK,
    MAX_INSIDE,
    add_legend,
    draw_column,
    draw_curve,
    draw_end,
    draw_prediction,
    label_axes,
    legend_entries,
    look_of,
    say_no_data,
    scale_axes,
    with_loss,
)
from .save import save_pdf, save_plot
from .style import SIZE, cut, styled_figure, write_note

OVERVIEW = "all-measures"
MAX_IN_A_COLUMN = 8
"""Greatest number of panels in one column; more are in two columns."""


def value_plot(result: Result, column: str, *, control: Result | None = None) -> Figure:
    """Draw one column over the levels; ``control`` is the same benchmark run with `frozen`."""
    curves = curves_of(result, column)
    with styled_figure(_with_room(SIZE, len(curves))) as figure:
        axes = figure.subplots()
        draw_column(axes, result, result.columns[result.index(column)], curves, control)
        add_legend(axes, len(curves))
        write_note(figure, *_origin(result))
    return figure


def small_multiples(result: Result, *, control: Result | None = None) -> Figure:
    """Draw every measure and the total over the same levels, in two columns if there are many."""
    columns = result.columns_of_kind("measure", "score")
    drawn = [curves_of(result, column.name) for column in columns]
    n_curves = max(map(len, drawn), default=0)
    across = 2 if len(columns) > MAX_IN_A_COLUMN else 1
    rows = max(1, math.ceil(len(columns) / across))
    with styled_figure(_with_room((SIZE[0] * across, 0.6 + 1.9 * rows), n_curves)) as figure:
        grid = figure.subplots(rows, across, sharex=True, squeeze=False).T.ravel()
        for axes in grid[len(columns) or 1 :]:
            axes.remove()
        for axes, column, curves in zip(grid, columns, drawn, strict=False):
            is_first = axes is grid[0]
            draw_column(axes, result, column, curves, control, labels=is_first, fold=18)
            if is_first:
                add_legend(axes, n_curves)
            is_lowest = axes in (grid[rows - 1], grid[len(columns) - 1])
            axes.tick_params(labelbottom=is_lowest)
            if not is_lowest:
                axes.set_xlabel("")
        write_note(figure, *_origin(result))
    return figure


def compare_plot(
    results: Sequence[Result], column: str, *, names: Sequence[str] | None = None
) -> Figure:
    """Draw one column of several results of the same benchmark, a line a result.

    Args:
        results: what is drawn.
        column: Name of the column.
        names: What the legend calls them; None: their algorithms, with the seed if need be.

    Raises:
        ResultError: they sweep different levels, or the column has different units.
    """
    _same_axes(results, column)
    with styled_figure((SIZE[0] + 1.6, SIZE[1])) as figure:
        axes = figure.subplots()
        shown = results[0].columns[results[0].index(column)]
        drawn = [
            (cut(f"{name}, {curve.name}" if curve.name else name), result, curve)
            for name, result in zip(names or _distinct_names(results), results, strict=True)
            for curve in curves_of(result, column)
        ]
        for i, (name, result, curve) in enumerate(drawn):
            is_control = algorithm_of(result) == CONTROL
            look = CONTROL_LOOK if is_control else look_of(i, len(drawn))
            draw_curve(axes, curve, look, with_loss(name, curve))
            draw_end(axes, curve, look)
        curves = [curve for _, _, curve in drawn]
        scale_axes(axes, curves)
        limits = []
        for result in reversed(results):  # the first one last: its labels stay
            label_axes(axes, result, shown)
            limits.append(axes.get_xlim())
        axes.set_xlim(min(low for low, _ in limits), max(high for _, high in limits))
        predicted = {result.fact("f_star"): result for result in results}
        predicted.pop(None, None)
        if len(predicted) == 1:  # the same for all that have the rule
            draw_prediction(axes, next(iter(predicted.values())))
        if all(curve.is_empty for curve in curves):
            say_no_data(axes, next((c.why for c in curves if c.why), None))
        figure.legend(*legend_entries(axes), loc="outside right upper")
        write_note(figure, *_origin(results[0], with_algorithm=False))
    return figure


def draw_plots(
    result: Result, directory: Path, *, control: Result | None = None, pdf: bool = False
) -> tuple[Path, ...]:
    """Draw all plots of a result into ``directory``.

    Args:
        result: what is drawn.
        directory: made if it is not there.
        control: the same benchmark run with `frozen`.
        pdf: also draw each as PDF, which takes three times as long.

    Returns:
        The PNGs, the total first, the overview of all measures last.
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
    for name, file in file_names(names, existing_names=[OVERVIEW]).items():
        save(value_plot(result, name, control=control), file)
    if len(files) > 1:
        save(small_multiples(result, control=control), OVERVIEW)
    return tuple(files)


def _with_room(size: tuple[float, float], n_curves: int) -> tuple[float, float]:
    """Widen a figure whose legend is next to the axes."""
    return (size[0] + 1.5, size[1]) if n_curves > MAX_INSIDE else size


def _same_axes(results: Sequence[Result], column: str) -> None:
    if not results:
        raise ResultError("There is nothing to compare: no result was given.")
    first = results[0]
    for other in results[1:]:
        if [c.name for c in other.columns_of_kind("level")] != [
            c.name for c in first.columns_of_kind("level")
        ]:
            raise ResultError(
                "These results sweep different things: "
                f"{', '.join(c.name for c in first.columns_of_kind('level'))} and "
                f"{', '.join(c.name for c in other.columns_of_kind('level'))}."
            )
        units = [r.columns[r.index(column)].unit for r in (first, other)]
        if units[0] != units[1]:
            raise ResultError(f"{column} is in {units[0]} in one result and {units[1]} in another.")


def _distinct_names(results: Sequence[Result]) -> list[str]:
    """Name results by their algorithm, and where that is not enough by their seed too."""
    names = [algorithm_of(result) or f"result {i + 1}" for i, result in enumerate(results)]
    return [
        name if names.count(name) == 1 else f"{name}, seed {result.run.seed}"
        for name, result in zip(names, results, strict=True)
    ]


def _origin(result: Result, *, with_algorithm: bool = True) -> tuple[str, str]:
    """The run (file, algorithm, mode, seed, version), and the meaning of the bands."""
    benchmark, run = result.inputs.benchmark, result.run
    n_repeats = len(set(repeats_of(result)))
    seeds = f"{n_repeats} repeats from seed" if n_repeats > 1 else "seed"
    parts = [
        "" if benchmark is None else cut(benchmark[0], 28),
        cut(algorithm_of(result), 28) if with_algorithm else "",
        run.mode or "",
        f"{seeds} {'?' if run.seed is None else run.seed}",
        f"uwsim {run.version or '?'}",
    ]
    bands = (
        "bands: 95 % intervals of the mean; dots: repeats; boxes: quartiles and median; "
        "hollow: not every repeat has a value"
    )
    return " · ".join(part for part in parts if part), bands if n_repeats > 1 else ""
