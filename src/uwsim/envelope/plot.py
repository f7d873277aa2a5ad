"""The plot of an envelope: all runs, the breaking point of each seed, and the result."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from ..analysis.plots import (
    GREY,
    INK,
    LEVEL_WORDS,
    PALETTE,
    save_plot,
    styled_figure,
    written_unit,
)
from .criterion import parse_criterion
from .envelope import Envelope
from .evaluate import Evaluation

FILE = "envelope.png"
INTACT_COLOUR, BROKEN_COLOUR = PALETTE[0], PALETTE[1]
SIZE = (5.4, 4.2)  # [inch]


def draw(envelope: Envelope, directory: Path) -> Path:
    """Draw the envelope into ``envelope.png``; return the path."""
    settings = envelope.settings
    path = directory / FILE
    with styled_figure() as figure:
        figure.set_size_inches(*SIZE)
        measure_axes, seed_axes = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
        _draw_measure(measure_axes, envelope)
        _draw_seeds(seed_axes, envelope)
        for axes in (measure_axes, seed_axes):
            _draw_result(axes, envelope)
        unit = "" if settings.unit == "1" else f" [{written_unit(settings.unit)}]"
        seed_axes.set_xlabel(f"{LEVEL_WORDS.get(settings.parameter) or settings.parameter}{unit}")
        span = abs(settings.bounds.stop - settings.bounds.start)
        ends = sorted((settings.bounds.start, settings.bounds.stop))
        seed_axes.set_xlim(ends[0] - 0.02 * span, ends[1] + 0.02 * span)
        return save_plot(figure, path)


def _draw_measure(axes: Axes, envelope: Envelope) -> None:
    """Draw the first measure of the criterion over the level; runs without a value at the top."""
    rows = [e.row for e in envelope.evaluations]
    names = list(rows[0].measures) if rows else []
    criterion = parse_criterion(envelope.settings.criterion, names)
    name = (criterion.measures or ("total",))[0]
    units = {m: unit for row in rows for m, (_, unit) in row.measures.items()}
    unit = units.get(name, "1")
    for is_broken, colour, marker, word in (
        (False, INTACT_COLOUR, "o", "holds"),
        (True, BROKEN_COLOUR, "X", "broken"),
    ):
        evaluations = [e for e in envelope.evaluations if e.judgement.is_broken == is_broken]
        points = [(e.level, v) for e in evaluations if (v := _value(e, name)) is not None]
        _dots(axes, [x for x, _ in points], [y for _, y in points], marker, colour, word)
        levels = [e.level for e in evaluations if _value(e, name) is None]
        top = axes.get_xaxis_transform()
        _dots(axes, levels, [0.95] * len(levels), "x", colour, f"{word}, no value", transform=top)
    limit = _limit(envelope.settings.criterion, name, names)
    if limit is not None:
        axes.axhline(limit, color=GREY, linewidth=0.8, linestyle=":")
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.12 * (high - low))  # space for the runs without a value
    axes.set_ylabel(name if unit == "1" else f"{name} [{written_unit(unit)}]")
    axes.plot([], [], color=INK, linewidth=1.0, label=envelope.sentence)
    axes.legend(loc="best")


def _dots(
    axes: Axes,
    x: list[float],
    y: list[float],
    marker: str,
    colour: str,
    word: str,
    **options: Any,
) -> None:
    if x:
        label = f"{word} ({len(x)} run{'s' * (len(x) > 1)})"
        axes.plot(
            x, y, marker, color=colour, markersize=4, alpha=0.8,
            markeredgewidth=0.9 if marker == "x" else 0, label=label, **options,
        )  # fmt: skip


def _draw_seeds(axes: Axes, envelope: Envelope) -> None:
    """Draw the runs and the breaking point of each seed on a separate line."""
    lines = {seed: i for i, seed in enumerate(envelope.settings.seeds)}
    for is_broken, colour, marker in ((False, INTACT_COLOUR, "o"), (True, BROKEN_COLOUR, "X")):
        runs = [e for e in envelope.evaluations if e.judgement.is_broken == is_broken]
        axes.plot(
            [e.level for e in runs], [lines[e.seed] for e in runs], marker, color=colour,
            markersize=2.6, alpha=0.7, markeredgewidth=0,
        )  # fmt: skip
    for threshold in envelope.search.thresholds:
        if threshold.hold_level is not None and threshold.break_level is not None:
            middle = (threshold.hold_level + threshold.break_level) / 2
            axes.plot([middle], [lines[threshold.seed]], "|", color=INK, markersize=9)
    axes.set_ylabel("seed")
    axes.yaxis.set_major_locator(MaxNLocator(integer=True, nbins=6))
    axes.yaxis.set_major_formatter(
        lambda y, _: str(envelope.settings.seeds[int(y)]) if 0 <= y < len(lines) else ""
    )
    axes.set_ylim(-0.7, max(len(lines) - 0.3, 0.7))


def _draw_result(axes: Axes, envelope: Envelope) -> None:
    median, bounds = envelope.median, envelope.settings.bounds
    ends = sorted((bounds.start, bounds.stop))
    if median.low is not None and median.high is not None:
        axes.axvspan(max(median.low, ends[0]), min(median.high, ends[1]), color="#e9e9e9", zorder=0)
    if median.value is not None:
        axes.axvline(median.value, color=INK, linewidth=1.0)
    reversal = envelope.search.reversal
    if reversal is not None:
        axes.axvline(reversal.hold_level, color=BROKEN_COLOUR, linewidth=0.8, linestyle="--")


def _value(evaluation: Evaluation, name: str) -> float | None:
    row = evaluation.row
    value = row.total if name == "total" else row.measures[name][0]
    return None if value is None or not math.isfinite(value) else float(value)


def _limit(criterion: str, name: str, names: list[str]) -> float | None:
    """Return the number in a criterion ``name > number``; None for any other criterion."""
    steps = parse_criterion(criterion, names).expression.steps
    if len(steps) == 3 and steps[0].name == name and steps[1].constant is not None:
        return steps[1].constant
    return None
