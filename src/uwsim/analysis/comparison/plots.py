"""Plots of a comparison: the curves with their bands, the differences on their zero line, success.

Bands and bars are 95 % intervals. In the plot of differences a filled marker is a level at which
one is better after Holm's correction; a hollow one shows no difference. Where there is one level,
or none, the same is drawn as bars. Levels that only one result has are left out, as in the tables.
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
from ...statistics import Interval, Rate
from ..plots import (
    FAINT,
    INK,
    MARKERS,
    PALETTE,
    SIZE,
    compare_plot,
    level_label,
    level_text,
    plain,
    save_pdf,
    save_plot,
    styled_figure,
    write_note,
    written_unit,
)
from ..plots.drawing import say_no_data
from .inputs import Entry
from .model import AtLevel, Comparison, Versus

FILLED = "; filled: p ≤ 0.05 after Holm"
Bar = tuple[str, Interval, bool]
"""Label, interval, and whether its marker is filled."""


def draw_comparison(comparison: Comparison, directory: Path) -> tuple[Path, ...]:
    """Draw every plot into ``directory``, each as PNG and as PDF; return the PNGs."""
    figures = {"curves": curves(comparison)}
    if (ended := success(comparison)) is not None:
        figures["success"] = ended
    figures["differences"] = differences_plot(comparison)
    files = []
    for name, figure in figures.items():
        files.append(save_plot(figure, directory / f"{name}.png"))
        save_pdf(figure, directory / f"{name}.pdf")
    return tuple(files)


def curves(comparison: Comparison) -> Figure:
    """Draw what was compared over the levels, a line and a band for each result."""
    entries, column = _compared(comparison), comparison.column
    if _has_one_level(comparison):
        bars = [
            (entry.name, at.interval, True)
            for entry in entries
            for at in intervals_of(entry.result, column.name)
        ]
        return _bars(bars, column.label, zero=False)
    figure = compare_plot(
        [entry.result for entry in entries], column.name, names=[entry.name for entry in entries]
    )
    figure.axes[0].set_ylabel(plain(column.label))
    return figure


def differences_plot(comparison: Comparison) -> Figure:
    """Draw second less first over the levels, a panel for each pair of results."""
    column, all_versus = comparison.column, comparison.versus
    label = f"difference [{written_unit(column.unit)}]" if column.unit else "difference"
    if _has_one_level(comparison):
        bars = [
            (_pair(versus), at.value.difference, _is_shown(at))
            for versus in all_versus
            for at in versus.levels
        ]
        return _bars(bars, f"{column.name}, {label}", zero=True)
    across = 1 if len(all_versus) < 4 else 2
    down = math.ceil(len(all_versus) / across)
    height = 0.7 + (2.2 if down == 1 else 1.7 * down)
    with styled_figure((SIZE[0] if across == 1 else 7.0, height)) as figure:
        grid = figure.subplots(down, across, sharex=True, squeeze=False)
        for i, axes in enumerate(grid.ravel()):
            if i >= len(all_versus):
                axes.axis("off")
                continue
            _draw_difference(axes, comparison, all_versus[i])
            if i % across == 0:
                axes.set_ylabel(plain(label if down > 1 else f"{column.name}, {label}"))
            if i + across >= len(all_versus):
                _label_levels(axes, comparison)
                axes.tick_params(labelbottom=True)
        write_note(figure, f"bands: 95 % intervals over repeats{FILLED}")
    return figure


def success(comparison: Comparison) -> Figure | None:
    """Draw the share of repeats that ended ``ok``; None where all did, or no status is stored."""
    drawn = []
    entries = _compared(comparison)
    for entry in entries:
        found = success_rates(entry.result)
        drawn.append([(at.level, at.success) for at in found if at.success is not None])
    if not any(rate.value < 1.0 for rates in drawn for _, rate in rates):
        return None
    if _has_one_level(comparison):
        bars = [
            (
                entry.name,
                Interval(n=r.n, mean=r.value, std=None, low=r.low, high=r.high),
                True,
            )
            for entry, rates in zip(entries, drawn, strict=True)
            for _, r in rates
        ]
        return _bars(bars, "share of repeats that ended ok", zero=False)
    with styled_figure((SIZE[0] + 1.6, 2.6)) as figure:
        axes = figure.subplots()
        several = len({level[:-1] for rates in drawn for level, _ in rates}) > 1
        i = 0
        for entry, rates in zip(entries, drawn, strict=True):
            for outer in dict.fromkeys(level[:-1] for level, _ in rates):
                line = [(level[-1], rate) for level, rate in rates if level[:-1] == outer]
                name = entry.name
                if several:
                    name += f", {_outer(entry, outer)}"
                _draw_rates(figure, line, i, plain(name))
                i += 1
        axes.set(ylabel="share that ended ok", ylim=(-0.03, 1.03))
        _label_levels(axes, comparison)
        figure.legend(loc="outside right upper")
        write_note(figure, "bars: exact 95 % intervals (Clopper and Pearson) over repeats")
    return figure


# ---------------------------------------------------------------------------- drawing


def _draw_difference(axes: Axes, comparison: Comparison, versus: Versus) -> None:
    axes.axhline(0.0, color=INK, linewidth=0.9, zorder=2)
    outers = list(dict.fromkeys(at.level[:-1] for at in versus.levels))
    for i, outer in enumerate(outers):
        levels = [at for at in versus.levels if at.level[:-1] == outer]
        colour = PALETTE[i % len(PALETTE)]
        known = [at for at in levels if at.value.difference.mean is not None]
        xs = [at.level[-1] for at in known]
        name = _outer(versus.first, outer) if len(outers) > 1 else None
        axes.plot(
            xs, [at.value.difference.mean or 0.0 for at in known], color=colour, zorder=3,
            label=plain(name) if name else None,
        )  # fmt: skip
        bands = [
            (at.level[-1], d.low, d.high)
            for at in known
            if (d := at.value.difference).low is not None and d.high is not None
        ]
        if bands:
            axes.fill_between(
                [x for x, _, _ in bands], [low for _, low, _ in bands],
                [high for _, _, high in bands], color=colour, alpha=0.18, linewidth=0,
            )  # fmt: skip
        for at in known:
            axes.plot(
                [at.level[-1]], [at.value.difference.mean or 0.0], MARKERS[i % len(MARKERS)],
                color=colour, zorder=3.5, markerfacecolor=colour if _is_shown(at) else "white",
            )  # fmt: skip
    if len(outers) > 1:
        axes.legend(loc="best")
    axes.margins(y=0.15)
    above, below = (
        (versus.second, versus.first)
        if comparison.higher_is_better
        else (versus.first, versus.second)
    )
    style: dict[str, Any] = {
        "fontsize": 7,
        "color": FAINT,
        "transform": axes.transAxes,
        "ha": "left",
    }
    axes.text(0.012, 0.985, plain(f"↑ {above.name} better"), va="top", **style)
    axes.text(0.012, 0.015, plain(f"↓ {below.name} better"), va="bottom", **style)
    axes.text(
        1.0, 1.02, plain(_pair(versus)), transform=axes.transAxes, ha="right", va="bottom",
        fontsize=8.5,
    )  # fmt: skip


def _draw_rates(figure: Figure, line: Sequence[tuple[float, Rate]], i: int, name: str) -> None:
    """Draw one result's rates with their intervals, moved a little so that none hides another."""
    axes = figure.axes[0]
    spread = [
        [rate.value - rate.low for _, rate in line],
        [rate.high - rate.value for _, rate in line],
    ]
    axes.errorbar(
        [x for x, _ in line],
        [rate.value for _, rate in line],
        yerr=spread if any(rate.n > 1 for _, rate in line) else None,
        color=PALETTE[i % len(PALETTE)],
        marker=MARKERS[i % len(MARKERS)],
        elinewidth=0.8,
        capsize=1.5,
        label=name,
        transform=offset_copy(axes.transData, fig=figure, x=2.5 * i, units="points"),
    )


def _bars(bars: Sequence[Bar], label: str, *, zero: bool) -> Figure:
    """Draw intervals as horizontal bars, one below the other."""
    with styled_figure((SIZE[0], 0.9 + 0.32 * len(bars))) as figure:
        axes = figure.subplots()
        if zero:
            axes.axvline(0.0, color=INK, linewidth=0.9, zorder=2)
        for i, (_, found, is_filled) in enumerate(bars):
            if found.mean is None:
                continue
            colour = PALETTE[0] if zero else PALETTE[i % len(PALETTE)]
            if found.low is not None and found.high is not None:
                axes.plot([found.low, found.high], [i, i], color=colour, linewidth=1.6)
            axes.plot(
                [found.mean], [i], MARKERS[0 if zero else i % len(MARKERS)], color=colour,
                markersize=5, markerfacecolor=colour if is_filled else "white",
            )  # fmt: skip
        if all(found.mean is None for _, found, _ in bars):
            say_no_data(axes, "no repeat has a value" + " in both results" * zero)
        axes.set_yticks(range(len(bars)), [plain(name) for name, _, _ in bars])
        axes.set_ylim(len(bars) - 0.5, -0.5)
        axes.grid(visible=False, axis="y")
        axes.set_xlabel(plain(label))
        write_note(figure, "bars: 95 % intervals over repeats" + FILLED * zero)
    return figure


def _label_levels(axes: Axes, comparison: Comparison) -> None:
    column = comparison.entries[0].result.columns_of_kind("level")[-1]
    xs = sorted({level[-1] for level in comparison.levels})
    pad = 0.03 * (xs[-1] - xs[0])
    axes.set_xlim(xs[0] - pad, xs[-1] + pad)
    axes.set_xlabel(plain(level_label(column)))


def _has_one_level(comparison: Comparison) -> bool:
    columns: tuple[Column, ...] = comparison.entries[0].result.columns_of_kind("level")
    return not columns or len(comparison.levels) == 1


def _compared(comparison: Comparison) -> tuple[Entry, ...]:
    """Return the results with the levels that were compared."""
    levels = set(comparison.levels)
    return tuple(
        replace(entry, result=select_levels(entry.result, levels)) for entry in comparison.entries
    )


def _is_shown(at: AtLevel) -> bool:
    return at.value.verdict in ("first", "second")


def _pair(versus: Versus) -> str:
    return f"{versus.second.name} − {versus.first.name}"


def _outer(entry: Entry, outer: tuple[float, ...]) -> str:
    columns = entry.result.columns_of_kind("level")[:-1]
    return ", ".join(level_text(c, value) for c, value in zip(columns, outer, strict=True))
