"""Figures of a task: a map of its success, rates along each parameter, the time of its phases."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from ...results.result import Result
from ..plots import FAINT, INK, PALETTE, level_label, level_text, save_plot, styled_figure
from .cells import TaskCell, task_cells
from .crossing import along
from .phases import phase_means

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
"""Status -> colour; colour-blind safe but for the last two, which are named in the table."""
SUCCESS_MAP, RATES, PHASES = "success-map", "success-rates", "phases"
CAPTIONS = {
    SUCCESS_MAP: "Left: success rate with its exact 95 % interval (Clopper and Pearson); the black "
    "line is where it crosses 50 %. Right: how the episodes of each level ended",
    RATES: "Success rate along each parameter, the other at its first value, with exact 95 % "
    "intervals; dashed: 50 %",
    PHASES: "Mean time in each phase over all episodes, the other parameter at its first value",
}


def draw_task_figures(result: Result, folder: Path) -> dict[Path, str]:
    """Draw the figures of a task; returns each file with its caption."""
    cells = task_cells(result)
    drawn: dict[str, Figure] = {}
    swept = _swept(cells)
    if len(swept) == 2 and len(result.columns_of_kind("level")) == 2:
        drawn[SUCCESS_MAP] = success_map(result, cells)
    if swept:
        drawn[RATES] = success_rates(result, cells, swept)
        if any(phase_means(result, cell) for cell in cells):
            drawn[PHASES] = phase_times(result, cells, swept)
    return {
        save_plot(figure, folder / f"{name}.png"): CAPTIONS[name] for name, figure in drawn.items()
    }


def _swept(cells: Sequence[TaskCell]) -> list[int]:
    """Numbers of the parameters that have more than one value."""
    n = len(cells[0].level) if cells else 0
    return [i for i in range(n) if len({cell.level[i] for cell in cells}) > 1]


def success_map(result: Result, cells: Sequence[TaskCell]) -> Figure:
    """Draw success rate and endings over two parameters."""
    rows = sorted({cell.level[0] for cell in cells})
    columns = sorted({cell.level[1] for cell in cells})
    size = (4.2 + 1.0 * len(columns), 1.5 + 0.55 * len(rows))
    with styled_figure(size) as figure:
        left, right = figure.subplots(1, 2, sharey=True)
        for axes in (left, right):
            _grid_axes(axes, result, rows, columns)
        for cell in cells:
            at = columns.index(cell.level[1]), rows.index(cell.level[0])
            _rate_cell(left, cell, *at)
            _endings_cell(right, cell, *at)
        _draw_half(left, cells, rows, columns)
        right.set_ylabel("")
        seen = dict.fromkeys(status for cell in cells for status in ("ok", *cell.failures))
        handles = [
            Patch(color=COLOURS.get(s, FAINT), label="success" if s == "ok" else s) for s in seen
        ]
        figure.legend(handles=handles, loc="outside lower center", ncols=min(len(handles), 6))
    return figure


def _grid_axes(axes: Axes, result: Result, rows: Sequence[float], columns: Sequence[float]) -> None:
    outer, inner = result.columns_of_kind("level")
    axes.set_xlim(-0.5, len(columns) - 0.5)
    axes.set_ylim(-0.5, len(rows) - 0.5)
    axes.set_xticks(range(len(columns)), [f"{value:g}" for value in columns])
    axes.set_yticks(range(len(rows)), [f"{value:g}" for value in rows])
    axes.set_xlabel(level_label(inner))
    axes.set_ylabel(level_label(outer))
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


def _endings_cell(axes: Axes, cell: TaskCell, x: int, y: int) -> None:
    left, width = x - 0.44, 0.88
    for status, n in {"ok": cell.success.successes, **cell.failures}.items():
        share = width * n / cell.success.n
        colour = COLOURS.get(status, FAINT)
        axes.add_patch(Rectangle((left, y - 0.36), share, 0.72, facecolor=colour, linewidth=0))
        left += share


def _draw_half(
    axes: Axes, cells: Sequence[TaskCell], rows: Sequence[float], columns: Sequence[float]
) -> None:
    """Draw the border between cells of at least half and of less than half."""
    rates = np.full((len(rows), len(columns)), np.nan)
    for cell in cells:
        rates[rows.index(cell.level[0]), columns.index(cell.level[1])] = cell.success.value
    holds = rates >= 0.5
    for y in range(len(rows)):
        for x in range(len(columns)):
            if x + 1 < len(columns) and holds[y, x] != holds[y, x + 1]:
                axes.plot([x + 0.5] * 2, [y - 0.5, y + 0.5], color="black", linewidth=2.2)
            if y + 1 < len(rows) and holds[y, x] != holds[y + 1, x]:
                axes.plot([x - 0.5, x + 0.5], [y + 0.5] * 2, color="black", linewidth=2.2)


def success_rates(result: Result, cells: Sequence[TaskCell], swept: Sequence[int]) -> Figure:
    """Draw the success rate along each parameter, the others at their first values."""
    with styled_figure((3.2 * len(swept), 2.6)) as figure:
        grid = figure.subplots(1, len(swept), sharey=True, squeeze=False)[0]
        for axes, parameter in zip(grid, swept, strict=True):
            line = along(cells, parameter, cells[0].level)
            x = [cell.level[parameter] for cell in line]
            y = np.array([cell.success.value for cell in line])
            low = y - np.array([cell.success.low for cell in line])
            high = np.array([cell.success.high for cell in line]) - y
            axes.axhline(0.5, color=FAINT, linewidth=0.9, linestyle=(0, (4, 2)))
            axes.errorbar(
                x, y, np.stack([low, high]).clip(0.0), fmt="o-", color=PALETTE[0], capsize=2.5
            )
            axes.set_xlabel(_with_fixed(result, parameter, cells[0].level))
            axes.set_ylim(-0.04, 1.04)
        grid[0].set_ylabel("success rate [1]")
    return figure


def _with_fixed(result: Result, parameter: int, first: tuple[float, ...]) -> str:
    """Label of an axis, with the values that the other parameters have."""
    columns = result.columns_of_kind("level")
    others = [
        level_text(column, value)
        for i, (column, value) in enumerate(zip(columns, first, strict=True))
        if i != parameter and column.name != "none"
    ]
    label = level_label(columns[parameter])
    return f"{label}\nat {', '.join(others)}" if others else label


def phase_times(result: Result, cells: Sequence[TaskCell], swept: Sequence[int]) -> Figure:
    """Draw the mean time in each phase along each parameter, one bar a level."""
    with styled_figure((3.4 * len(swept), 2.8)) as figure:
        grid = figure.subplots(1, len(swept), sharey=True, squeeze=False)[0]
        names: dict[str, None] = {}
        for axes, parameter in zip(grid, swept, strict=True):
            line = along(cells, parameter, cells[0].level)
            below = np.zeros(len(line))
            means = [phase_means(result, cell) for cell in line]
            names.update(dict.fromkeys(name for each in means for name in each))
            for i, name in enumerate(names):
                heights = np.array([each.get(name, 0.0) for each in means])
                colour = mpl.colormaps["tab20"](i % 20)
                axes.bar(
                    range(len(line)), heights, bottom=below, color=colour, label=name, width=0.75
                )
                below += heights
            axes.set_xticks(range(len(line)), [f"{cell.level[parameter]:g}" for cell in line])
            axes.set_xlabel(_with_fixed(result, parameter, cells[0].level))
        grid[0].set_ylabel("time [s]")
        handles, labels = grid[0].get_legend_handles_labels()
        figure.legend(handles[::-1], labels[::-1], loc="outside right upper")
    return figure
