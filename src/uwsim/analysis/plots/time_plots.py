"""The values of a measure over the time of a level, with quantiles over the seeds.

Each panel is a level. With five seeds or more, a panel shows the median and the ranges of the
middle 50 % and 90 % of the seeds; with fewer seeds, a line for each seed and the median. Quantiles
at a time are over the seeds that have a sample then: there is no sample after the end of a level or
while a target is lost.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...results.log import TIME, Log
from ...results.result import Column, Result
from .curves import level_text, written_unit
from .panels import choose_evenly, choose_panels
from .style import GREY, INK, PALETTE, escape, styled_figure, write_note

Array = npt.NDArray[np.float64]
Level = tuple[float, ...]

MIN_BAND_SEEDS = 5
"""The minimum number of seeds whose quantiles are drawn as bands."""
OUTER_QUANTILES, INNER_QUANTILES = (0.05, 0.95), (0.25, 0.75)
"""The quantiles at the edges of the outer and the inner band."""
MAX_POINTS = 1500
"""The greatest number of points of a line."""
LOG_SCALE_RATIO = 50.0
"""The ratio of the medians of two levels above which the axis is logarithmic [1]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Samples:
    """The samples of a measure in one level, for all seeds."""

    times: Array
    """The times since the first sample of a seed, (n,) [s]."""
    values: Array
    """The values of each seed at these times, (seeds, n); NaN for a missing value."""


def samples_of(result: Result, log: Log) -> dict[Level, Samples]:
    """Return the samples of a log by level, in the order of the log; a missing value is NaN."""
    time_index = log.header.index(TIME)
    level_indices = [log.header.index(column.label) for column in result.columns_of_kind("level")]
    run_indices = [log.header.index(column.label) for column in result.columns_of_kind("run")]
    samples_by_seed: dict[Level, dict[tuple[object, ...], list[tuple[float, float]]]] = {}
    for sample in log.samples:
        level = tuple(float(sample[i] or 0.0) for i in level_indices)
        seed = tuple(sample[i] for i in run_indices)
        time, value = float(sample[time_index] or 0.0), sample[time_index + 1]
        points = samples_by_seed.setdefault(level, {}).setdefault(seed, [])
        points.append((time, math.nan if value is None else float(value)))
    return {level: _table(seeds) for level, seeds in samples_by_seed.items()}


def _table(seeds: Mapping[tuple[object, ...], Sequence[tuple[float, float]]]) -> Samples:
    """Combine the samples of seeds in one table; times are since the first sample of each seed."""
    rows = [{round(t - line[0][0], 3): value for t, value in line} for line in seeds.values()]
    times = sorted({t for row in rows for t in row})
    times = choose_evenly(times, MAX_POINTS)
    values = [[row.get(t, math.nan) for t in times] for row in rows]
    return Samples(times=np.array(times), values=np.array(values).reshape(len(rows), len(times)))


def time_plot(result: Result, log: Log) -> Figure | None:
    """Draw a measure over the time of each level; None if all samples are 0 or missing.

    Args:
        result: the result with the levels and seeds of the log.
        log: the samples of the measure.
    """
    if TIME not in log.header or len(log.header) < log.header.index(TIME) + 2:
        return None
    names = [column.label for column in result.columns_of_kind("run", "level")]
    if any(name not in log.header for name in names):
        return None
    samples = {
        level: table
        for level, table in samples_of(result, log).items()
        if len(table.times) > 1 and not np.isnan(table.values).all()
    }
    if not any(np.nan_to_num(table.values).any() for table in samples.values()):
        return None
    panels = choose_panels(samples)
    with styled_figure(panels.size) as figure:
        grid = panels.axes(figure, sharex=True, sharey=True)
        for axes, level in zip(grid, panels.levels, strict=True):
            _draw(axes, samples[level])
            axes.set_title(escape(level_title(result, level)), fontsize=8, loc="left", color=INK)
        _scale(grid, [samples[level] for level in panels.levels])
        n_seeds = max(len(samples[level].values) for level in panels.levels)
        write_note(figure, marks_note(n_seeds), panels.note)
        panels.label(grid, "time in the level [s]", escape(_label(log)))
    return figure


def marks_note(n_seeds: int) -> str:
    """Return the meaning of the lines and bands for this number of seeds."""
    if n_seeds == 1:
        return ""
    if n_seeds < MIN_BAND_SEEDS:
        return f"thin lines: {n_seeds} seeds; thick line: their median"
    return f"line: median of {n_seeds} seeds; dark band: middle 50 %; light band: middle 90 %"


def level_title(result: Result, level: Level) -> str:
    """Return a level as a title: ``current 0.4 m/s, fog 0.5 m⁻¹``."""
    columns: Sequence[Column] = result.columns_of_kind("level")
    column_values = zip(columns, level, strict=True)
    return ", ".join(level_text(column, v) for column, v in column_values if column.name != "none")


def _label(log: Log) -> str:
    unit = log.header[log.header.index(TIME) + 1].partition("[")[2].rstrip("]")
    return f"{log.measure} [{written_unit(unit)}]" if unit else log.measure


def _draw(axes: Axes, samples: Samples) -> None:
    times, values, colour = samples.times, samples.values, PALETTE[0]
    if len(values) == 1:
        axes.plot(times, values[0], color=colour, linewidth=1.1)
        return
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # at some times no seed has a value
        median = np.nanmedian(values, axis=0)
        edges = [np.nanquantile(values, q, axis=0) for q in (OUTER_QUANTILES, INNER_QUANTILES)]
    if len(values) < MIN_BAND_SEEDS:
        axes.plot(times, values.T, color=colour, linewidth=0.6, alpha=0.45)
    else:
        for (low, high), alpha in zip(edges, (0.16, 0.30), strict=True):
            axes.fill_between(times, low, high, color=colour, alpha=alpha, linewidth=0)
    axes.plot(times, median, color=colour, linewidth=1.3)


def _scale(grid: Sequence[Axes], samples: Sequence[Samples]) -> None:
    """Set the scales: from 0 without negative values, logarithmic for very different levels."""
    finite_values = [s.values[np.isfinite(s.values)] for s in samples]
    values = np.concatenate(finite_values)
    for axes in grid:
        axes.set_xlim(0.0, max(float(s.times[-1]) for s in samples))
        axes.axhline(0.0, color=GREY, linewidth=0.5, zorder=1)
    if values.min() < 0.0:
        return
    medians = [float(np.median(part)) for part in finite_values]
    if min(medians) > 0.0 and max(medians) > LOG_SCALE_RATIO * min(medians):
        positive = values[values > 0.0]
        grid[0].set_yscale("log")
        grid[0].set_ylim(0.8 * float(np.quantile(positive, 0.02)), 1.25 * float(positive.max()))
        return
    top = float(values.max())
    high = float(np.quantile(values, 0.995))
    grid[0].set_ylim(0.0, (top if top < 2.0 * high else 1.5 * high) * 1.05 or 1.0)
