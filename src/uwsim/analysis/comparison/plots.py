"""Plots of a comparison: curves with bands, differences about a zero line, success rates, times.

Bands and bars are 95 % intervals. In the plot of differences, a filled marker is a level at which
one result is better after Holm's correction; a hollow marker shows no difference. A single level is
drawn as bars. Levels that only one result has are omitted, as in the tables.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.transforms import offset_copy

from ...results.per_level import intervals_of, select_levels, success_rates
from ...results.result import Column
from ...statistics import Interval, Rate, success_curve
from ..plots import (
    GREY,
    INK,
    MARKERS,
    PALETTE,
    SIZE,
    compare_plot,
    escape,
    level_label,
    level_text,
    save_pdf,
    save_plot,
    styled_figure,
    write_note,
    written_unit,
)
from ..plots.drawing import write_no_data
from ..plots.style import MAX_NAME_LENGTH, shorten_name
from ..task import draw_success_curve, success_times, task_measure
from .inputs import Entry
from .model import Comparison, LevelStatistics, PairComparison

FILLED_MARKERS = "; filled: p ≤ 0.05 after Holm"
Bar = tuple[str, Interval, bool]
"""The label, the interval, and a flag that is true if the marker is filled."""


def draw_comparison(comparison: Comparison, directory: Path) -> tuple[Path, ...]:
    """Draw every plot into ``directory`` as PNG and PDF; return the paths of the PNGs."""
    figures = {"curves": curves_plot(comparison)}
    if (success_figure := success_plot(comparison)) is not None:
        figures["success"] = success_figure
    if (times_figure := times_plot(comparison)) is not None:
        figures["times"] = times_figure
    figures["differences"] = differences_plot(comparison)
    files = []
    for name, figure in figures.items():
        files.append(save_plot(figure, directory / f"{name}.png"))
        save_pdf(figure, directory / f"{name}.pdf")
    return tuple(files)


def curves_plot(comparison: Comparison) -> Figure:
    """Draw the compared column over the levels, a line and a band for each result."""
    entries, column = _common_entries(comparison), comparison.column
    if _has_one_level(comparison):
        bars = [
            (shorten_name(entry.name), level_interval.interval, True)
            for entry in entries
            for level_interval in intervals_of(entry.result, column.name)
        ]
        return _bars(bars, column.label, has_zero_line=False)
    figure = compare_plot(
        [entry.result for entry in entries], column.name, names=[entry.name for entry in entries]
    )
    figure.axes[0].set_ylabel(escape(column.label))
    return figure


def differences_plot(comparison: Comparison) -> Figure:
    """Draw the differences, second minus first, over the levels, a panel for each pair."""
    column, pairs = comparison.column, comparison.pairs
    label = f"difference [{written_unit(column.unit)}]" if column.unit else "difference"
    if _has_one_level(comparison):
        bars = [
            (_bar_name(pair), stats.value.difference, _is_significant(stats))
            for pair in pairs
            for stats in pair.levels
        ]
        return _bars(bars, f"{column.name}, {label}", has_zero_line=True)
    n_columns = 1 if len(pairs) < 4 else 2
    n_rows = math.ceil(len(pairs) / n_columns)
    height = 0.7 + (2.2 if n_rows == 1 else 1.7 * n_rows)
    with styled_figure((SIZE[0] if n_columns == 1 else 7.0, height)) as figure:
        grid = figure.subplots(n_rows, n_columns, sharex=True, squeeze=False)
        for i, axes in enumerate(grid.ravel()):
            if i >= len(pairs):
                axes.axis("off")
                continue
            _draw_difference(axes, comparison, pairs[i])
            if i % n_columns == 0:
                axes.set_ylabel(escape(label if n_rows > 1 else f"{column.name}, {label}"))
            if i + n_columns >= len(pairs):
                _label_levels(axes, comparison)
                axes.tick_params(labelbottom=True)
        write_note(figure, f"bands: 95 % intervals over repeats{FILLED_MARKERS}")
    return figure


def success_plot(comparison: Comparison) -> Figure | None:
    """Draw the fraction of repeats that ended ``ok``; None if all did, or have no status."""
    entry_rates = []
    entries = _common_entries(comparison)
    for entry in entries:
        level_rates = success_rates(entry.result)
        entry_rates.append([(r.level, r.success) for r in level_rates if r.success is not None])
    if not any(rate.value < 1.0 for rates in entry_rates for _, rate in rates):
        return None
    if _has_one_level(comparison):
        bars = [
            (
                shorten_name(entry.name),
                Interval(n=r.n, mean=r.value, std=None, low=r.low, high=r.high),
                True,
            )
            for entry, rates in zip(entries, entry_rates, strict=True)
            for _, r in rates
        ]
        return _bars(bars, "share of repeats that ended ok", has_zero_line=False)
    with styled_figure((SIZE[0] + 1.6, 2.6)) as figure:
        axes = figure.subplots()
        has_outer_levels = len({level[:-1] for rates in entry_rates for level, _ in rates}) > 1
        i = 0
        for entry, rates in zip(entries, entry_rates, strict=True):
            for outer_level in dict.fromkeys(level[:-1] for level, _ in rates):
                line = [(level[-1], rate) for level, rate in rates if level[:-1] == outer_level]
                name = entry.name
                if has_outer_levels:
                    name += f", {_outer_level_text(entry, outer_level)}"
                _draw_rates(figure, line, i, escape(name))
                i += 1
        axes.set(ylabel="share that ended ok", ylim=(-0.03, 1.03))
        _label_levels(axes, comparison)
        figure.legend(loc="outside right upper")
        write_note(figure, "bars: exact 95 % intervals (Clopper and Pearson) over repeats")
    return figure


def times_plot(comparison: Comparison) -> Figure | None:
    """Draw the share of all trials that succeeded by each time; None without times.

    The levels of a seed are not independent, so intervals are drawn for a single level only.
    """
    entries = _common_entries(comparison)
    limits = [pair.times.limit for pair in comparison.pairs if pair.times]
    if not limits:
        return None
    limit = max(limits) or 1.0
    with styled_figure((SIZE[0] + 1.6, 2.8)) as figure:
        axes = figure.subplots()
        for i, entry in enumerate(entries):
            times = success_times(entry.result) if task_measure(entry.result) else None
            if times and (curve := success_curve(times)) is not None:
                draw_success_curve(
                    axes, curve, limit, i, entry.name, has_band=_has_one_level(comparison)
                )
        axes.set(xlabel="time [s]", ylabel="share that succeeded")
        axes.set(xlim=(0.0, limit), ylim=(-0.03, 1.03))
        figure.legend(loc="outside right upper")
        if _has_one_level(comparison):
            write_note(figure, "bands: 95 % intervals of each share over repeats")
        else:
            write_note(figure, "over all levels; the levels of a repeat are not independent")
    return figure


# ---------------------------------------------------------------------------- drawing


def _draw_difference(axes: Axes, comparison: Comparison, pair: PairComparison) -> None:
    axes.axhline(0.0, color=INK, linewidth=0.9, zorder=2)
    outer_levels = list(dict.fromkeys(stats.level[:-1] for stats in pair.levels))
    for i, outer_level in enumerate(outer_levels):
        levels = [stats for stats in pair.levels if stats.level[:-1] == outer_level]
        colour = PALETTE[i % len(PALETTE)]
        levels_with_mean = [stats for stats in levels if stats.value.difference.mean is not None]
        xs = [stats.level[-1] for stats in levels_with_mean]
        ys = [stats.value.difference.mean or 0.0 for stats in levels_with_mean]
        name = _outer_level_text(pair.first, outer_level) if len(outer_levels) > 1 else None
        axes.plot(xs, ys, color=colour, zorder=3, label=escape(name) if name else None)
        bands = [
            (stats.level[-1], d.low, d.high)
            for stats in levels_with_mean
            if (d := stats.value.difference).low is not None and d.high is not None
        ]
        if bands:
            axes.fill_between(
                [x for x, _, _ in bands], [low for _, low, _ in bands],
                [high for _, _, high in bands], color=colour, alpha=0.18, linewidth=0,
            )  # fmt: skip
        for x, y, stats in zip(xs, ys, levels_with_mean, strict=True):
            face = colour if _is_significant(stats) else "white"
            marker = MARKERS[i % len(MARKERS)]
            axes.plot([x], [y], marker, color=colour, zorder=3.5, markerfacecolor=face)
    if len(outer_levels) > 1:
        axes.legend(loc="best")
    axes.margins(y=0.15)
    upper_entry, lower_entry = (
        (pair.second, pair.first) if comparison.higher_is_better else (pair.first, pair.second)
    )
    style: dict[str, Any] = {
        "fontsize": 7,
        "color": GREY,
        "transform": axes.transAxes,
        "ha": "left",
    }
    axes.text(0.012, 0.985, escape(f"↑ {upper_entry.name} better"), va="top", **style)
    axes.text(0.012, 0.015, escape(f"↓ {lower_entry.name} better"), va="bottom", **style)
    axes.text(
        1.0, 1.02, escape(_pair_name(pair)), transform=axes.transAxes, ha="right", va="bottom",
        fontsize=8.5,
    )  # fmt: skip


def _draw_rates(figure: Figure, line: Sequence[tuple[float, Rate]], i: int, name: str) -> None:
    """Draw the rates of one result with their intervals, shifted so that none hides another."""
    axes = figure.axes[0]
    error_bars = [
        [rate.value - rate.low for _, rate in line],
        [rate.high - rate.value for _, rate in line],
    ]
    axes.errorbar(
        [x for x, _ in line],
        [rate.value for _, rate in line],
        yerr=error_bars if any(rate.n > 1 for _, rate in line) else None,
        color=PALETTE[i % len(PALETTE)],
        marker=MARKERS[i % len(MARKERS)],
        elinewidth=0.8,
        capsize=1.5,
        label=name,
        transform=offset_copy(axes.transData, fig=figure, x=2.5 * i, units="points"),
    )


def _bars(bars: Sequence[Bar], label: str, *, has_zero_line: bool) -> Figure:
    with styled_figure((SIZE[0], 0.9 + 0.32 * len(bars))) as figure:
        axes = figure.subplots()
        if has_zero_line:
            axes.axvline(0.0, color=INK, linewidth=0.9, zorder=2)
        for i, (_, interval, is_filled) in enumerate(bars):
            if interval.mean is None:
                continue
            colour = PALETTE[0] if has_zero_line else PALETTE[i % len(PALETTE)]
            if interval.low is not None and interval.high is not None:
                axes.plot([interval.low, interval.high], [i, i], color=colour, linewidth=1.6)
            axes.plot(
                [interval.mean], [i], MARKERS[0 if has_zero_line else i % len(MARKERS)],
                color=colour, markersize=5, markerfacecolor=colour if is_filled else "white",
            )  # fmt: skip
        if all(interval.mean is None for _, interval, _ in bars):
            write_no_data(axes, "no repeat has a value" + " in both results" * has_zero_line)
        axes.set_yticks(range(len(bars)), [escape(name) for name, _, _ in bars])
        axes.set_ylim(len(bars) - 0.5, -0.5)
        axes.grid(visible=False, axis="y")
        axes.set_xlabel(escape(label))
        write_note(figure, "bars: 95 % intervals over repeats" + FILLED_MARKERS * has_zero_line)
    return figure


def _label_levels(axes: Axes, comparison: Comparison) -> None:
    column = comparison.entries[0].result.columns_of_kind("level")[-1]
    xs = sorted({level[-1] for level in comparison.levels})
    pad = 0.03 * (xs[-1] - xs[0])
    axes.set_xlim(xs[0] - pad, xs[-1] + pad)
    axes.set_xlabel(escape(level_label(column)))


def _has_one_level(comparison: Comparison) -> bool:
    columns: tuple[Column, ...] = comparison.entries[0].result.columns_of_kind("level")
    return not columns or len(comparison.levels) == 1


def _common_entries(comparison: Comparison) -> tuple[Entry, ...]:
    levels = set(comparison.levels)
    return tuple(
        replace(entry, result=select_levels(entry.result, levels)) for entry in comparison.entries
    )


def _is_significant(stats: LevelStatistics) -> bool:
    return stats.value.verdict in ("first", "second")


def _pair_name(pair: PairComparison) -> str:
    return f"{pair.second.name} − {pair.first.name}"


def _bar_name(pair: PairComparison) -> str:
    """Return the name of a pair beside its bar, on two lines if it is long."""
    name = _pair_name(pair)
    if len(name) <= MAX_NAME_LENGTH:
        return name
    return f"{shorten_name(pair.second.name)} −\n{shorten_name(pair.first.name)}"


def _outer_level_text(entry: Entry, outer_level: tuple[float, ...]) -> str:
    columns = entry.result.columns_of_kind("level")[:-1]
    return ", ".join(level_text(c, value) for c, value in zip(columns, outer_level, strict=True))
