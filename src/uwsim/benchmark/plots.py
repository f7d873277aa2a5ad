"""Plots: what a result says, drawn so that it could go into a paper.

Every plot is drawn from results alone. Axes carry units, a loss is a vertical line with its level,
bands are 95 % intervals over repeats (a hollow marker: not every repeat has a value), the control
(`frozen`, which never looks at a picture) is a dashed line, and a column without values says why
instead of showing nothing. No plot has a title: what was found is for the reader to say.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.ticker import FuncFormatter

from ..errors import ResultError
from .interval import LevelInterval, per_level, rows_by_level
from .result import Column, Result
from .updaters.fog_sweep import LENGTHS

CONTROL = "frozen"
"""The algorithm that only echoes what it was given: dashed in every plot."""

PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#7A5C00")
"""Okabe and Ito's colours, told apart by colour-blind readers, in an order that prints."""

MARKERS = ("o", "s", "^", "D", "v", "P", "X")
INK, FAINT = "#222222", "#777777"
DPI = 200
OVERVIEW = "all-measures"
SIZE = (5.0, 3.1)  # [inch]

LEVEL_WORDS = {
    "armPosition": "arm position",
    "attenuationLength": "attenuation length",
    "current": "current",
    "fog": "fog density",
    "iteration": "iteration",
    "light": "light rate",
    "noise": "camera noise",
    "none": "",
    "visibilityRange": "visibility range",
}
"""What a level's reference is called on an axis."""

STYLE: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 8.5,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.6,
    "xtick.color": INK,
    "ytick.color": INK,
    "lines.linewidth": 1.4,
    "lines.markersize": 3.6,
    "legend.frameon": False,
    "legend.fontsize": 7.5,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "svg.hashsalt": "uwsim",
}


@dataclass(frozen=True, kw_only=True)
class Curve:
    """One line of a plot: a column over the innermost level, means over repeats."""

    name: str
    """What the legend calls it."""
    x: tuple[float, ...]
    """The innermost level's values."""
    mean: tuple[float, ...]
    """Mean at each level; NaN, which matplotlib leaves out, where there is none."""
    low: tuple[float, ...]
    """Lower limit of the 95 % interval; NaN likewise."""
    high: tuple[float, ...]
    """Upper limit; NaN likewise."""
    n_missing: tuple[int, ...]
    """How many repeats have no value at each level."""
    losses: tuple[tuple[float, str], ...]
    """(level, status) of the first level of each repeat that did not end ``ok``."""
    why: str | None
    """The first reason why a value is missing."""

    @property
    def is_empty(self) -> bool:
        """Whether no level has a value."""
        return bool(np.all(np.isnan(self.mean))) if self.mean else True


def value_plot(result: Result, column: str, *, control: Result | None = None) -> Figure:
    """Draw one column over the levels; ``control`` is the same benchmark played by `frozen`."""
    with styled_figure() as figure:
        axes = figure.subplots()
        _draw_column(axes, result, result.columns[result.index(column)], control)
        _note(figure, _origin(result))
    return figure


def small_multiples(result: Result, *, control: Result | None = None) -> Figure:
    """Draw every measure and the total, one below the other, over the same levels."""
    columns = result.of_kind("measure", "score")
    rows = max(1, len(columns))
    with styled_figure((SIZE[0], 0.6 + 1.9 * rows)) as figure:
        grid = figure.subplots(rows, 1, sharex=True, squeeze=False)
        for axes, column in zip(grid[:, 0], columns, strict=False):
            _draw_column(axes, result, column, control, labels=axes is grid[0, 0])
            axes.label_outer()
        _note(figure, _origin(result))
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
            (f"{name}, {curve.name}" if curve.name else name, result, curve)
            for name, result in zip(names or _distinct_names(results), results, strict=True)
            for curve in curves_of(result, column)
        ]
        for i, (name, result, curve) in enumerate(drawn):
            is_control = algorithm_of(result) == CONTROL
            _draw_curve(axes, curve, i, f"{name}{_loss_text(curve)}", is_control)
            _draw_end(axes, curve, i)
        curves = [curve for _, _, curve in drawn]
        _scale(axes, curves)
        _label_axes(axes, results[0], shown)
        _draw_prediction(axes, results[0])
        if all(curve.is_empty for curve in curves):
            _say_no_data(axes, next((c.why for c in curves if c.why), None))
        figure.legend(loc="outside right upper")
        _note(figure, _origin(results[0], with_algorithm=False))
    return figure


def draw_plots(
    result: Result, directory: Path, *, control: Result | None = None
) -> tuple[Path, ...]:
    """Draw all plots of a result into ``directory`` and return the files, the total first."""
    directory.mkdir(parents=True, exist_ok=True)
    files = []
    for column in result.of_kind("score") + result.of_kind("measure"):
        files.append(directory / f"{_slug(column.name)}.png")
        save_plot(value_plot(result, column.name, control=control), files[-1])
    if len(files) > 1:
        files.append(directory / f"{OVERVIEW}.png")
        save_plot(small_multiples(result, control=control), files[-1])
    return tuple(files)


def save_plot(figure: Figure, path: Path) -> Path:
    """Write a plot as PNG, 200 dots an inch, without a date or a program's name in it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    FigureCanvasAgg(figure)
    figure.savefig(path, dpi=DPI, format="png", metadata={"Software": None})
    return path


def curves_of(result: Result, column: str) -> list[Curve]:
    """Return one curve, or with nested levels one for each combination of the outer ones."""
    outer = [c.name for c in result.of_kind("level")][:-1]
    found: dict[tuple[float, ...], list[LevelInterval]] = {}
    for entry in per_level(result, column):
        found.setdefault(entry.level[:-1], []).append(entry)
    return [
        Curve(
            name=", ".join(f"{name} {value:g}" for name, value in zip(outer, key, strict=True)),
            x=tuple(entry.level[-1] if entry.level else 0.0 for entry in entries),
            mean=tuple(_or_nan(entry.interval.mean) for entry in entries),
            low=tuple(_or_nan(entry.interval.low) for entry in entries),
            high=tuple(_or_nan(entry.interval.high) for entry in entries),
            n_missing=tuple(entry.n_missing for entry in entries),
            losses=_losses(result, key),
            why=next((entry.why for entry in entries if entry.why), None),
        )
        for key, entries in found.items()
    ]


def written_unit(unit: str) -> str:
    """Return a unit as it is written behind a number: 1/m as m⁻¹."""
    return re.sub(r"^1/(\w+)$", r"\1⁻¹", unit)


def algorithm_of(result: Result) -> str:
    """Return the name of the algorithm a result is about."""
    return str(result.run.get("algorithm") or "")


# ---------------------------------------------------------------------------- drawing


@contextmanager
def styled_figure(size: tuple[float, float] = SIZE) -> Iterator[Figure]:
    """Give an empty figure of ``size`` [inch] in the house style."""
    with mpl.rc_context(STYLE):
        yield Figure(figsize=size, layout=ConstrainedLayoutEngine(rect=(0, 0.03, 1, 0.97)))


def _draw_column(
    axes: Axes, result: Result, column: Column, control: Result | None, *, labels: bool = True
) -> None:
    curves = curves_of(result, column.name)
    compared = _curves_of_control(control, result, column.name)
    for i, curve in enumerate(curves):
        _draw_curve(axes, curve, i, curve.name or algorithm_of(result) or column.name, False)
    for curve in compared:
        _draw_curve(axes, curve, 0, CONTROL, True)
    _scale(axes, [*curves, *compared])
    _label_axes(axes, result, column)
    if all(curve.is_empty for curve in curves):
        _say_no_data(axes, next((curve.why for curve in curves if curve.why), None))
    if len(curves) == 1:
        _draw_losses(axes, curves[0], labels)
    _draw_prediction(axes, result, labels)
    if len(curves) + len(compared) > 1 and labels:
        axes.legend(loc="best")


def _draw_curve(axes: Axes, curve: Curve, i: int, name: str, is_control: bool) -> None:
    colour = INK if is_control else PALETTE[i % len(PALETTE)]
    axes.plot(
        curve.x,
        curve.mean,
        color=colour,
        linestyle=(0, (4, 2)) if is_control else "-",
        linewidth=1.1 if is_control else None,
        marker="none" if is_control and len(curve.x) > 1 else MARKERS[i % len(MARKERS)],
        label=_text(name),
        zorder=2.5 if is_control else 3,
    )
    partial = [k for k, n in enumerate(curve.n_missing) if n and not np.isnan(curve.mean[k])]
    if partial and not is_control:
        points = [curve.x[k] for k in partial], [curve.mean[k] for k in partial]
        marker = MARKERS[i % len(MARKERS)]
        axes.plot(*points, marker, color=colour, markerfacecolor="white", zorder=3.5)
    if len(curve.x) == 1:
        spread = [[curve.mean[0] - curve.low[0]], [curve.high[0] - curve.mean[0]]]
        if not np.isnan(spread).any():
            axes.errorbar(curve.x, curve.mean, yerr=spread, color=colour, capsize=4, zorder=3)
    elif not np.all(np.isnan(curve.low)):
        axes.fill_between(curve.x, curve.low, curve.high, color=colour, alpha=0.18, linewidth=0)


def _draw_losses(axes: Axes, curve: Curve, label: bool) -> None:
    """Mark the first level that did not end ok: a line, over repeats from first to last."""
    if not curve.losses:
        return
    levels = [level for level, _ in curve.losses]
    first, last = min(levels), max(levels)
    if first < last:
        axes.axvspan(first, last, color=PALETTE[1], alpha=0.10, linewidth=0, zorder=1)
    for level in dict.fromkeys((first, last)):
        axes.axvline(level, color=PALETTE[1], linewidth=1.0, zorder=2)
    if label:
        _write_above(axes, last, _loss_text(curve).strip(" ()"), PALETTE[1], line=1)


def _draw_end(axes: Axes, curve: Curve, i: int) -> None:
    """Mark with a cross the last value before a loss."""
    known = [k for k, value in enumerate(curve.mean) if not np.isnan(value)]
    if curve.losses and known and known[-1] < len(curve.x) - 1:
        x, y = curve.x[known[-1]], curve.mean[known[-1]]
        axes.plot([x], [y], "x", color=PALETTE[i % len(PALETTE)], markersize=8, mew=1.6, zorder=4)


def _draw_prediction(axes: Axes, result: Result, label: bool = True) -> None:
    """Draw f*, the fog at which the ZNCC is expected to reach its threshold."""
    fact, levels = result.fact("f_star"), result.of_kind("level")
    if fact is None or not levels or levels[-1].name not in ("fog", *LENGTHS):
        return
    low, high = axes.get_xlim()
    text = f"$f^*$ = {fact[0]:.2f} {_text(written_unit(fact[1]))}"
    x = fact[0]
    if (length := LENGTHS.get(levels[-1].name)) is not None:
        x = length(x) if x > 0.0 else math.inf
        text = f"{x:.2f} m, {text}"
    if low <= x <= high:
        axes.axvline(x, color=FAINT, linewidth=1.1, linestyle=(0, (1, 1.5)), zorder=2)
        if label:
            _write_above(axes, x, f"loss predicted at {text}", FAINT, line=0)
    elif label:
        _write_above(axes, high, f"loss predicted beyond these levels, {text}", FAINT, line=0)


def _write_above(axes: Axes, x: float, text: str, colour: str, *, line: int) -> None:
    """Write over the axes, ending (or on the left half, beginning) at a vertical line."""
    low, high = axes.get_xlim()
    axes.annotate(
        text,
        (x, 1.0),
        xycoords=("data", "axes fraction"),
        xytext=(0, 2 + 9 * line),
        textcoords="offset points",
        ha="right" if x > (low + high) / 2 else "left",
        va="bottom",
        fontsize=7.5,
        color=colour,
    )


def _label_axes(axes: Axes, result: Result, column: Column) -> None:
    levels = result.of_kind("level")
    if levels:
        word = LEVEL_WORDS.get(levels[-1].name, levels[-1].name)
        axes.set_xlabel(_text(f"{word} [{levels[-1].unit}]" if levels[-1].unit else word))
        xs = sorted({level[-1] for level in rows_by_level(result)})
        if levels[-1].name == "none":
            axes.set_xticks([])
        elif len(xs) == 1:
            axes.set_xticks(xs)
            axes.set_xlim(xs[0] - 1, xs[0] + 1)
        elif xs:
            pad = 0.03 * (xs[-1] - xs[0])
            axes.set_xlim(xs[0] - pad, xs[-1] + pad)
    axes.set_ylabel(_text(column.label))


def _scale(axes: Axes, curves: Sequence[Curve]) -> None:
    """Begin at 0 when nothing is negative; logarithmic between 1 : 50 and 1 : 1000.

    What is below a thousandth of the largest value is nothing (a control that echoes the truth).
    """
    values = np.array([v for curve in curves for v in curve.mean if not np.isnan(v)])
    if values.size == 0 or values.min() < 0:
        return
    low, high = float(values.min()), float(values.max())
    if high > 50 * low > 0.05 * high:
        axes.set_yscale("log")
        axes.yaxis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))
    else:
        limits = [v for curve in curves for v in curve.high if not np.isnan(v)]
        top = min(max([high, *limits]), 1.6 * high) * 1.12 or 1.0
        axes.set_ylim(-0.03 * top if low < 0.01 * high else 0, top)


def _say_no_data(axes: Axes, why: str | None) -> None:
    axes.text(
        0.5,
        0.5,
        _text(f"no data: {why or 'no level was played'}"),
        transform=axes.transAxes,
        ha="center",
        va="center",
        color=FAINT,
        wrap=True,
        bbox={"facecolor": "white", "edgecolor": "none"},
    )
    axes.set_yticks([])


def _note(figure: Figure, text: str) -> None:
    figure.text(0.995, 0.004, _text(text), ha="right", va="bottom", fontsize=5.5, color=FAINT)


# ---------------------------------------------------------------------------- what is drawn


def _or_nan(value: float | None) -> float:
    return float("nan") if value is None else value


def _losses(result: Result, outer: tuple[float, ...]) -> tuple[tuple[float, str], ...]:
    status = result.of_kind("status")
    if not status or not result.of_kind("level"):
        return ()
    cells = result.values(status[0].name)
    repeats = [result.values(column.name) for column in result.of_kind("run")]
    first: dict[tuple[object, ...], tuple[float, str]] = {}
    for level, rows in rows_by_level(result).items():
        for row in rows:
            if level[:-1] == outer and cells[row] not in ("ok", None):
                repeat = tuple(cells_[row] for cells_ in repeats)
                first.setdefault(repeat, (level[-1], str(cells[row])))
    return tuple(first.values())


def _loss_text(curve: Curve) -> str:
    """`` (lost at 1.2)``, or over repeats `` (lost at 1.15 to 1.25)``; nothing without a loss."""
    if not curve.losses:
        return ""
    words = sorted({status for _, status in curve.losses})
    levels = [level for level, _ in curve.losses]
    span = f"{min(levels):g}" + (f" to {max(levels):g}" if min(levels) < max(levels) else "")
    return f" ({' or '.join(words)} at {span})"


def _curves_of_control(control: Result | None, result: Result, column: str) -> list[Curve]:
    if control is None or column not in [c.name for c in control.columns]:
        return []
    return curves_of(control, column)[:1]


def _same_axes(results: Sequence[Result], column: str) -> None:
    if not results:
        raise ResultError("There is nothing to compare: no result was given.")
    first = results[0]
    for other in results[1:]:
        if [c.name for c in other.of_kind("level")] != [c.name for c in first.of_kind("level")]:
            raise ResultError(
                "These results sweep different things: "
                f"{', '.join(c.name for c in first.of_kind('level'))} and "
                f"{', '.join(c.name for c in other.of_kind('level'))}."
            )
        units = [r.columns[r.index(column)].unit for r in (first, other)]
        if units[0] != units[1]:
            raise ResultError(f"{column} is in {units[0]} in one result and {units[1]} in another.")


def _distinct_names(results: Sequence[Result]) -> list[str]:
    """Name results by their algorithm, and where that is not enough by their seed too."""
    names = [algorithm_of(result) or f"result {i + 1}" for i, result in enumerate(results)]
    return [
        name if names.count(name) == 1 else f"{name}, seed {result.run.get('seed')}"
        for name, result in zip(names, results, strict=True)
    ]


def _origin(result: Result, *, with_algorithm: bool = True) -> str:
    """What was played: file, algorithm, mode, seed, version."""
    benchmark = result.inputs.get("benchmark")
    repeats = {row[0] for row in zip(*_run_columns(result), strict=True)}
    seeds = f"{len(repeats)} repeats from seed" if len(repeats) > 1 else "seed"
    parts = [
        str(benchmark[0]) if isinstance(benchmark, tuple) and benchmark else "",
        algorithm_of(result) if with_algorithm else "",
        str(result.run.get("mode") or ""),
        f"{seeds} {result.run.get('seed', '?')}",
        f"uwsim {result.run.get('version', '?')}",
    ]
    band = "; bands: 95 % intervals; hollow: not every repeat" if len(repeats) > 1 else ""
    return " · ".join(part for part in parts if part) + band


def _run_columns(result: Result) -> list[tuple[object, ...]]:
    return [result.values(column.name) for column in result.of_kind("run")]


def _text(text: str) -> str:
    """Names come from files: a dollar in them is a dollar, not mathematics."""
    return re.sub(r"(?<!\\)\$", r"\\$", text)


def _slug(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9_.-]", "_", name).lstrip(".") or "column"
