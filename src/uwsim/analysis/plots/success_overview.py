"""The overview of several tasks and algorithms: a heat map of success rates for each algorithm.

A row is a task, or one value of its outer parameters. The columns are the values of its innermost
parameter, which differ from task to task, so each cell states its own. The lightness of a colour
grows with the rate alone, so colour-blind readers and grey prints have the same order.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from ...statistics import Rate
from .style import INK, escape, shorten_name, styled_figure, write_note

COLOUR_MAP = "cividis"
"""A colour map for all kinds of colour vision (Nuñez, Anderton and Renslow 2018)."""
CELL_WIDTH, CELL_HEIGHT = 0.5, 0.42
"""The size of a cell [inch]."""
LABEL_SIZE = 1.75
"""The width of the labels of the rows [inch]."""
MIN_MAP_WIDTH = 2
"""The least width of a map, which has to contain the name of an algorithm [cells]."""
MIN_WIDTH = 4.6
"""The least width of the figure, which has to contain the note [inch]."""
TITLE_DENSITY = 14.0
"""The number of characters of a title per inch."""
MAX_COLUMNS = 16
"""The greatest number of cells next to each other, over all maps."""
HEADING_HEIGHT = 0.85
"""The height of the line with the name of a task that has outer parameters [cells]."""
MIN_LIGHT_LUMINANCE = 0.21
"""The relative luminance of a cell from which dark text has more contrast than white text [1]."""
MAX_LABEL = 30
"""The greatest number of characters in a label of a row."""


@dataclass(frozen=True, kw_only=True)
class OverviewRow:
    """A row of the heat maps: a task, at one value of its outer parameters."""

    task: str
    """The name of the task."""
    parameter: str
    """The innermost parameter with its unit, ``current [m/s]``; empty without one."""
    outer_level: str
    """The values of the outer parameters as text, ``fog 0.5 m⁻¹``; empty without any."""
    levels: tuple[str, ...]
    """The values of the innermost parameter as text, easiest first."""
    rates: Mapping[str, tuple[Rate | None, ...]]
    """The success rates at these levels, by algorithm; None for a level that was not run."""


def success_overview(rows: Sequence[OverviewRow], algorithms: Sequence[str]) -> Figure:
    """Draw a heat map of success rates, tasks against difficulty, for each algorithm.

    Each cell has the value of the parameter, the successes with the number of trials, and the exact
    95 % interval of the rate.

    Args:
        rows: the tasks, at least one.
        algorithms: the names of the algorithms, at least one, in the order of the maps.
    """
    n_levels = max(len(row.levels) for row in rows)
    map_width = max(n_levels, MIN_MAP_WIDTH)  # [cells]
    n_columns = max(1, min(len(algorithms), MAX_COLUMNS // map_width))
    n_rows = math.ceil(len(algorithms) / n_columns)
    n_headings = sum(_is_heading(rows, i) for i in range(len(rows)))
    height = CELL_HEIGHT * (len(rows) + HEADING_HEIGHT * n_headings)
    size = (
        max(MIN_WIDTH, LABEL_SIZE + n_columns * (CELL_WIDTH * map_width + 0.12) + 0.9),
        n_rows * (height + 0.3) + 0.35,
    )
    with styled_figure(size) as figure:
        grid = figure.subplots(n_rows, n_columns, squeeze=False)
        for i, axes in enumerate(grid.ravel()):
            if i >= len(algorithms):
                axes.set_axis_off()
                continue
            _draw_map(axes, rows, algorithms[i], map_width, has_labels=i % n_columns == 0)
        scale = ScalarMappable(cmap=mpl.colormaps[COLOUR_MAP])
        scale.set_clim(0.0, 1.0)
        bar = figure.colorbar(scale, ax=list(grid.ravel()), shrink=0.9, aspect=30, pad=0.02)
        bar.set_label("success rate [1]")
        bar.outline.set_visible(False)
        is_complete = all(None not in row.rates.get(a, (None,)) for a in algorithms for row in rows)
        write_note(
            figure,
            "cells: value of the parameter, successes / trials, exact 95 % interval of the rate",
            "(Clopper and Pearson) [%]" + ("" if is_complete else "; hatched: not run"),
        )
    return figure


def _is_heading(rows: Sequence[OverviewRow], i: int) -> bool:
    """Return True if a task with outer parameters begins at row i, which has a line of its own."""
    return bool(rows[i].outer_level) and (i == 0 or rows[i - 1].task != rows[i].task)


def _draw_map(
    axes: Axes, rows: Sequence[OverviewRow], algorithm: str, width: int, *, has_labels: bool
) -> None:
    y = 0.0
    labels: list[tuple[float, str, bool]] = []  # position, text, True for the name of a task
    for i, row in enumerate(rows):
        if i > 0 and rows[i - 1].task != row.task:
            axes.axhline(y, color=INK, linewidth=0.7)
        if _is_heading(rows, i):
            labels += [(y + 0.26, row.task, True), (y + 0.62, row.parameter, False)]
            y += HEADING_HEIGHT
        if row.outer_level:
            labels.append((y + 0.5, row.outer_level, False))
        elif row.parameter:
            lines = row.parameter.split(", ", 1)  # of a task with one level
            labels += [(y + 0.33 - 0.1 * (len(lines) - 1), row.task, True)]
            labels += [(y + 0.69 + 0.26 * i - 0.13 * (len(lines) - 1), line, False)
                       for i, line in enumerate(lines)]  # fmt: skip
        else:
            labels.append((y + 0.5, row.task, True))
        rates = row.rates.get(algorithm, ())
        for x, level in enumerate(row.levels):
            _draw_cell(axes, x, y, level, rates[x] if x < len(rates) else None)
        y += 1.0
    axes.set_xlim(0.0, width)
    axes.set_ylim(y, 0.0)
    axes.set_xticks([])
    labels = labels if has_labels else []
    axes.set_yticks(
        [position for position, _, _ in labels],
        [escape(shorten_name(text, MAX_LABEL)) for _, text, _ in labels],
    )
    for tick_label, (_, _, is_task) in zip(axes.get_yticklabels(), labels, strict=True):
        tick_label.set(fontweight="bold" if is_task else "normal", fontsize=8 if is_task else 7)
    axes.tick_params(length=0)
    axes.grid(visible=False)
    axes.spines[:].set_visible(False)
    name = shorten_name(algorithm, int(TITLE_DENSITY * CELL_WIDTH * width))
    axes.set_title(escape(name), fontsize=8, loc="left", pad=3)


def _draw_cell(axes: Axes, x: float, y: float, level: str, rate: Rate | None) -> None:
    if rate is None:
        axes.add_patch(
            Rectangle((x, y), 1, 1, facecolor="white", edgecolor="#cccccc", hatch="////", lw=0)
        )
        return
    colour = mpl.colormaps[COLOUR_MAP](rate.value)
    axes.add_patch(Rectangle((x, y), 1, 1, facecolor=colour, edgecolor="white", linewidth=1.0))
    ink = "white" if _luminance(colour) < MIN_LIGHT_LUMINANCE else INK
    for dy, text, size in (
        (0.19, level, 5.2),
        (0.51, f"{rate.successes}/{rate.n}", 7.5),
        (0.81, f"{100 * rate.low:.0f}–{100 * rate.high:.0f}", 5.2),
    ):
        axes.text(x + 0.5, y + dy, escape(text), ha="center", va="center", color=ink, fontsize=size)


def _luminance(colour: Sequence[float]) -> float:
    """Return the relative luminance of a colour of sRGB (WCAG 2.1), 0 to 1."""
    red, green, blue = (
        value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4
        for value in colour[:3]
    )
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue
