"""The values of a measure over the time of a level, with quantiles over the seeds.

A panel is a level. With five seeds or more it has the median, the range of the middle half and that
of the middle nine tenths; with fewer, the line of each seed and the median. Quantiles are those of
the seeds that have a sample at that time: a level that ends early, or that has lost its target, has
none.
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
from .panels import panels_of
from .style import FAINT, INK, PALETTE, plain, styled_figure, write_note

Array = npt.NDArray[np.float64]
Level = tuple[float, ...]

FEWEST_FOR_BANDS = 5
"""The number of seeds from which on quantiles are drawn as bands."""
OUTER, INNER = (0.05, 0.95), (0.25, 0.75)
"""Quantiles at the edges of the bands."""
MAX_POINTS = 1500
"""The greatest number of times at which a line has a point."""
LOG_SCALE = 50.0
"""The axis is logarithmic where the lines differ by more than this factor."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Samples:
    """The samples of a measure in one level, by seed."""

    times: Array
    """Times since the measure began, (n,) [s]."""
    values: Array
    """Value of each seed, (seeds, n); NaN where there is none."""


def samples_of(result: Result, log: Log) -> dict[Level, Samples]:
    """Return the samples of a log by level, in the order of the log; times without a value stay."""
    time = log.header.index(TIME)
    levels = [log.header.index(column.label) for column in result.columns_of_kind("level")]
    runs = [log.header.index(column.label) for column in result.columns_of_kind("run")]
    found: dict[Level, dict[tuple[object, ...], list[tuple[float, float]]]] = {}
    for sample in log.samples:
        level = tuple(float(sample[i] or 0.0) for i in levels)
        seed = tuple(sample[i] for i in runs)
        value = sample[time + 1]
        at = (float(sample[time] or 0.0), math.nan if value is None else float(value))
        found.setdefault(level, {}).setdefault(seed, []).append(at)
    return {level: _table(seeds) for level, seeds in found.items()}


def _table(seeds: Mapping[tuple[object, ...], Sequence[tuple[float, float]]]) -> Samples:
    """Put the samples of seeds in one table; times begin at the first sample of each."""
    rows = [{round(t - line[0][0], 3): value for t, value in line} for line in seeds.values()]
    times = sorted({t for row in rows for t in row})
    if len(times) > MAX_POINTS:
        kept = np.linspace(0, len(times) - 1, MAX_POINTS).round().astype(int)
        times = [times[i] for i in dict.fromkeys(kept.tolist())]
    values = [[row.get(t, math.nan) for t in times] for row in rows]
    return Samples(times=np.array(times), values=np.array(values).reshape(len(rows), len(times)))


def over_time_plot(result: Result, log: Log) -> Figure | None:
    """Draw a measure over the time of each level; None where no sample has a value but 0.

    Args:
        result: whose levels and seeds the log has.
        log: the samples of the measure.
    """
    if TIME not in log.header or len(log.header) < log.header.index(TIME) + 2:
        return None
    names = [column.label for column in result.columns_of_kind("run", "level")]
    if any(name not in log.header for name in names):
        return None
    samples = {
        level: found
        for level, found in samples_of(result, log).items()
        if len(found.times) > 1 and not np.isnan(found.values).all()
    }
    if not any(np.nan_to_num(found.values).any() for found in samples.values()):
        return None
    shown = panels_of(samples)
    with styled_figure(shown.size) as figure:
        grid = shown.axes(figure, sharex=True, sharey=True)
        for axes, level in zip(grid, shown.levels, strict=True):
            _draw(axes, samples[level])
            axes.set_title(plain(level_title(result, level)), fontsize=8, loc="left", color=INK)
        _scale(grid, [samples[level] for level in shown.levels])
        n_seeds = max(len(samples[level].values) for level in shown.levels)
        write_note(figure, note_of(n_seeds), shown.note)
        shown.label(grid, "time in the level [s]", plain(_label(log)))
    return figure


def note_of(n_seeds: int) -> str:
    """Return what the lines and bands of so many seeds are."""
    if n_seeds == 1:
        return ""
    if n_seeds < FEWEST_FOR_BANDS:
        return f"thin lines: {n_seeds} seeds; thick line: their median"
    return f"line: median of {n_seeds} seeds; dark band: middle 50 %; light band: middle 90 %"


def level_title(result: Result, level: Level) -> str:
    """Return a level as a title: ``current 0.4 m/s, fog 0.5 m⁻¹``."""
    columns: Sequence[Column] = result.columns_of_kind("level")
    named = zip(columns, level, strict=True)
    return ", ".join(level_text(column, v) for column, v in named if column.name != "none")


def _label(log: Log) -> str:
    """Return the label of the axis: the name of the measure with the unit of its value."""
    unit = log.header[log.header.index(TIME) + 1].partition("[")[2].rstrip("]")
    return f"{log.measure} [{written_unit(unit)}]" if unit else log.measure


def _draw(axes: Axes, samples: Samples) -> None:
    times, values, colour = samples.times, samples.values, PALETTE[0]
    if len(values) == 1:
        axes.plot(times, values[0], color=colour, linewidth=1.1)
        return
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # of times at which no seed has a value
        median = np.nanmedian(values, axis=0)
        edges = [np.nanquantile(values, both, axis=0) for both in (OUTER, INNER)]
    if len(values) < FEWEST_FOR_BANDS:
        axes.plot(times, values.T, color=colour, linewidth=0.6, alpha=0.45)
    else:
        for (low, high), alpha in zip(edges, (0.16, 0.30), strict=True):
            axes.fill_between(times, low, high, color=colour, alpha=alpha, linewidth=0)
    axes.plot(times, median, color=colour, linewidth=1.3)


def _scale(grid: Sequence[Axes], samples: Sequence[Samples]) -> None:
    """Begin at 0 where nothing is negative; logarithmic where levels differ by a large factor."""
    finite = [each.values[np.isfinite(each.values)] for each in samples]
    values = np.concatenate(finite)
    for axes in grid:
        axes.set_xlim(0.0, max(float(each.times[-1]) for each in samples))
        axes.axhline(0.0, color=FAINT, linewidth=0.5, zorder=1)
    if values.min() < 0.0:
        return
    medians = [float(np.median(part)) for part in finite]
    if min(medians) > 0.0 and max(medians) > LOG_SCALE * min(medians):
        positive = values[values > 0.0]
        grid[0].set_yscale("log")
        grid[0].set_ylim(0.8 * float(np.quantile(positive, 0.02)), 1.25 * float(positive.max()))
        return
    top = float(values.max())
    high = float(np.quantile(values, 0.995))
    grid[0].set_ylim(0.0, (top if top < 2.0 * high else 1.5 * high) * 1.05 or 1.0)
