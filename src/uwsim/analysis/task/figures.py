"""The figures of a task: success rates, times to success, times of phases."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import cycle
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from ...results.result import Result
from ...statistics import SuccessCurve, success_curve
from ..plots import (
    GREY,
    INK,
    PALETTE,
    choose_evenly,
    escape,
    level_label,
    level_text,
    save_plot,
    styled_figure,
)
from .cells import TaskCell, task_cells
from .crossing import cells_along
from .phases import phase_means
from .success_times import success_times, time_limit

COLOURS = {
    "ok": "#009E73",
    "dropped": "#D55E00",
    "missed": "#E69F00",
    "lost target": "#CC79A7",
    "not found": "#0072B2",
    "collision": "#222222",
    "timeout": "#999999",
    "algorithm error": "#C00000",
    "simulation error": "#C00000",
    "lost": "#CC79A7",
}
"""The colour of each status. The last two repeat the colours of ``algorithm error`` and ``lost
target``; colour-blind readers can distinguish the others."""
OTHER_COLOURS = ("#56B4E9", "#8C6D31", "#7B3294", "#B2DF8A")
"""The colours of the statuses that outcomes name, in the order of their first occurrence."""
SUCCESS_MAP, SUCCESS_RATES, PHASE_TIMES = "success-map", "success-rates", "phases"
SUCCESS_TIMES = "success-times"
MAX_CURVES = 6
"""The greatest number of levels in a panel of times; of more levels, evenly chosen ones."""
MAX_BANDS = 2
"""The greatest number of curves in a panel that have bands."""
DASHES = ("-", (0, (5, 1.5)), (0, (1, 1)), (0, (5, 1, 1, 1)), (0, (8, 2)), (0, (2, 2)))
"""The line styles of curves of successes, which differ in grey print, too."""
CAPTIONS = {
    SUCCESS_MAP: "Left: success rate with its exact 95 % interval (Clopper and Pearson); it "
    "crosses 50 % at the black line. Right: the status of the episodes of each level",
    SUCCESS_RATES: "Success rate along each parameter, the other at its first value, with exact "
    "95 % intervals; dashed: 50 %",
    SUCCESS_TIMES: "Share of the episodes that have succeeded by each time (Kaplan and Meier), "
    "along each parameter, the other at its first value",
    PHASE_TIMES: "Mean time in each phase over all episodes, the other parameter at its first "
    "value",
}


def draw_task_figures(result: Result, folder: Path) -> dict[Path, str]:
    """Draw the figures of a task; return each file with its caption."""
    cells = task_cells(result)
    figures: dict[str, Figure] = {}
    parameters = _swept_parameters(cells)
    if len(parameters) == 2 and len(result.columns_of_kind("level")) == 2:
        figures[SUCCESS_MAP] = success_map(result, cells)
    if parameters:
        figures[SUCCESS_RATES] = success_rates(result, cells, parameters)
        if (times_figure := times_to_success(result, cells, parameters)) is not None:
            figures[SUCCESS_TIMES] = times_figure
        if any(phase_means(result, cell) for cell in cells):
            figures[PHASE_TIMES] = phase_times(result, cells, parameters)
    return {
        save_plot(figure, folder / f"{name}.png"): CAPTIONS[name]
        for name, figure in figures.items()
    }


def _swept_parameters(cells: Sequence[TaskCell]) -> list[int]:
    n = len(cells[0].level) if cells else 0
    return [i for i in range(n) if len({cell.level[i] for cell in cells}) > 1]


def success_map(result: Result, cells: Sequence[TaskCell]) -> Figure:
    """Draw maps of the success rate and of the statuses over two parameters."""
    rows = sorted({cell.level[0] for cell in cells})
    columns = sorted({cell.level[1] for cell in cells})
    size = (4.2 + 1.0 * len(columns), 1.5 + 0.55 * len(rows))
    with styled_figure(size) as figure:
        left, right = figure.subplots(1, 2, sharey=True)
        for axes in (left, right):
            _grid_axes(axes, result, rows, columns)
        colours = status_colours(s for cell in cells for s in ("ok", *cell.failures))
        for cell in cells:
            position = columns.index(cell.level[1]), rows.index(cell.level[0])
            _rate_cell(left, cell, *position)
            _endings_cell(right, cell, *position, colours)
        _draw_half(left, cells, rows, columns)
        right.set_ylabel("")
        handles = [
            Patch(color=colour, label="success" if status == "ok" else status)
            for status, colour in colours.items()
        ]
        figure.legend(handles=handles, loc="outside lower center", ncols=min(len(handles), 6))
    return figure


def status_colours(statuses: Iterable[str]) -> dict[str, str]:
    """Return the colour of each status, in the order of the first occurrence."""
    names = list(dict.fromkeys(statuses))
    other_names = [name for name in names if name not in COLOURS]
    colours = COLOURS | dict(zip(other_names, cycle(OTHER_COLOURS), strict=False))
    return {name: colours[name] for name in names}


def _grid_axes(axes: Axes, result: Result, rows: Sequence[float], columns: Sequence[float]) -> None:
    outer_column, inner_column = result.columns_of_kind("level")
    axes.set_xlim(-0.5, len(columns) - 0.5)
    axes.set_ylim(-0.5, len(rows) - 0.5)
    axes.set_xticks(range(len(columns)), [f"{value:g}" for value in columns])
    axes.set_yticks(range(len(rows)), [f"{value:g}" for value in rows])
    axes.set_xlabel(level_label(inner_column))
    axes.set_ylabel(level_label(outer_column))
    axes.grid(visible=False)


def _rate_cell(axes: Axes, cell: TaskCell, x: int, y: int) -> None:
    success = cell.success
    colour = mpl.colormaps["viridis"](success.value)
    axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1.0, 1.0, facecolor=colour, edgecolor="white"))
    ink = "white" if success.value < 0.6 else INK
    text = f"{success.successes}/{success.n}"
    axes.text(x, y + 0.12, text, ha="center", va="center", color=ink, fontsize=8.5)
    limits = f"{100 * success.low:.0f}–{100 * success.high:.0f} %"
    axes.text(x, y - 0.24, limits, ha="center", va="center", color=ink, fontsize=5.5)


def _endings_cell(axes: Axes, cell: TaskCell, x: int, y: int, colours: Mapping[str, str]) -> None:
    left, width = x - 0.44, 0.88
    for status, n in {"ok": cell.success.successes, **cell.failures}.items():
        share = width * n / cell.success.n
        colour = colours[status]
        axes.add_patch(Rectangle((left, y - 0.36), share, 0.72, facecolor=colour, linewidth=0))
        left += share


def _draw_half(
    axes: Axes, cells: Sequence[TaskCell], rows: Sequence[float], columns: Sequence[float]
) -> None:
    rates = np.full((len(rows), len(columns)), np.nan)
    for cell in cells:
        rates[rows.index(cell.level[0]), columns.index(cell.level[1])] = cell.success.value
    is_half = rates >= 0.5
    for y in range(len(rows)):
        for x in range(len(columns)):
            if x + 1 < len(columns) and is_half[y, x] != is_half[y, x + 1]:
                axes.plot([x + 0.5] * 2, [y - 0.5, y + 0.5], color="black", linewidth=2.2)
            if y + 1 < len(rows) and is_half[y, x] != is_half[y + 1, x]:
                axes.plot([x - 0.5, x + 0.5], [y + 0.5] * 2, color="black", linewidth=2.2)


def success_rates(result: Result, cells: Sequence[TaskCell], parameters: Sequence[int]) -> Figure:
    """Draw the success rate along each parameter, the others at their first values."""
    with styled_figure((3.2 * len(parameters), 2.6)) as figure:
        grid = figure.subplots(1, len(parameters), sharey=True, squeeze=False)[0]
        for axes, parameter in zip(grid, parameters, strict=True):
            line = cells_along(cells, parameter, cells[0].level)
            x = [cell.level[parameter] for cell in line]
            y = np.array([cell.success.value for cell in line])
            low = y - np.array([cell.success.low for cell in line])
            high = np.array([cell.success.high for cell in line]) - y
            axes.axhline(0.5, color=GREY, linewidth=0.9, linestyle=(0, (4, 2)))
            axes.errorbar(
                x, y, np.stack([low, high]).clip(0.0), fmt="o-", color=PALETTE[0], capsize=2.5
            )
            axes.set_xlabel(_label_with_fixed_levels(result, parameter, cells[0].level))
            axes.set_ylim(-0.04, 1.04)
        grid[0].set_ylabel("success rate [1]")
    return figure


def times_to_success(
    result: Result, cells: Sequence[TaskCell], parameters: Sequence[int]
) -> Figure | None:
    """Draw the share that succeeded by each time along each parameter; None without successes."""
    trials = success_times(result)
    if trials is None or not any(trial.has_succeeded for trial in trials):
        return None
    limit = time_limit(trials) or 1.0
    columns = result.columns_of_kind("level")
    with styled_figure((3.4 * len(parameters), 2.7)) as figure:
        grid = figure.subplots(1, len(parameters), sharey=True, squeeze=False)[0]
        for axes, parameter in zip(grid, parameters, strict=True):
            line = choose_evenly(cells_along(cells, parameter, cells[0].level), MAX_CURVES)
            for i, cell in enumerate(line):
                curve = success_curve([trials[row] for row in cell.rows])
                assert curve is not None
                name = level_text(columns[parameter], cell.level[parameter])
                has_band = len(line) <= MAX_BANDS
                draw_success_curve(axes, curve, limit, i, name, has_band=has_band)
            fixed = _label_with_fixed_levels(result, parameter, cells[0].level).partition("\n")[2]
            axes.set_xlabel(f"time [s]\n{fixed}" if fixed else "time [s]")
            axes.set(xlim=(0.0, limit), ylim=(-0.04, 1.04))
            axes.legend(loc="best")
        grid[0].set_ylabel("share that succeeded [1]")
    return figure


def draw_success_curve(
    axes: Axes, curve: SuccessCurve, limit: float, i: int, name: str, *, has_band: bool
) -> None:
    """Draw a curve of successes as steps up to the time limit.

    Args:
        axes: the axes to draw on.
        curve: the curve.
        limit: the time limit [s].
        i: the index of the curve, which determines its colour and dashes.
        name: the name in the legend.
        has_band: True to draw the 95 % intervals.
    """
    colour, dashes = PALETTE[i % len(PALETTE)], DASHES[i % len(DASHES)]
    times, shares, lows, highs = (
        [*values, end]
        for values, end in (
            (curve.times, limit),
            (curve.shares, curve.shares[-1]),
            (curve.lows, curve.lows[-1]),
            (curve.highs, curve.highs[-1]),
        )
    )
    label = escape(f"{name} ({curve.n_successes} of {curve.n})")
    axes.step(times, shares, where="post", color=colour, linestyle=dashes, label=label)
    if has_band:
        axes.fill_between(times, lows, highs, step="post", color=colour, alpha=0.15, linewidth=0)


def _label_with_fixed_levels(result: Result, parameter: int, levels: tuple[float, ...]) -> str:
    columns = result.columns_of_kind("level")
    fixed_levels = [
        level_text(column, value)
        for i, (column, value) in enumerate(zip(columns, levels, strict=True))
        if i != parameter and column.name != "none"  # the column of the updater <none/>
    ]
    label = level_label(columns[parameter])
    return f"{label}\nat {', '.join(fixed_levels)}" if fixed_levels else label


def phase_times(result: Result, cells: Sequence[TaskCell], parameters: Sequence[int]) -> Figure:
    """Draw the mean time in each phase along each parameter, a bar for each level."""
    with styled_figure((3.4 * len(parameters), 2.8)) as figure:
        grid = figure.subplots(1, len(parameters), sharey=True, squeeze=False)[0]
        names: dict[str, None] = {}
        for axes, parameter in zip(grid, parameters, strict=True):
            line = cells_along(cells, parameter, cells[0].level)
            bottoms = np.zeros(len(line))
            means = [phase_means(result, cell) for cell in line]
            names.update(dict.fromkeys(name for phases in means for name in phases))
            for i, name in enumerate(names):
                heights = np.array([phases.get(name, 0.0) for phases in means])
                colour = mpl.colormaps["tab20"](i % 20)
                axes.bar(
                    range(len(line)), heights, bottom=bottoms, color=colour, label=name, width=0.75
                )
                bottoms += heights
            axes.set_xticks(range(len(line)), [f"{cell.level[parameter]:g}" for cell in line])
            axes.set_xlabel(_label_with_fixed_levels(result, parameter, cells[0].level))
        grid[0].set_ylabel("time [s]")
        handles, labels = grid[-1].get_legend_handles_labels()  # the only panel with all phases
        figure.legend(handles[::-1], labels[::-1], loc="outside right upper")
    return figure
