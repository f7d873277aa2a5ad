"""Drawing curves on axes, with their ends, predictions and labels."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.ticker import FuncFormatter, MaxNLocator

from ...base.optics import LENGTHS
from ...results.per_level import rows_by_level
from ...results.result import Column, Result
from .curves import Curve, algorithm_of, curves_of, label_of, repeats_of, written_unit
from .style import FAINT, INK, MARKERS, PALETTE, cut, level_label, plain

CONTROL = "frozen"
"""The algorithm that only echoes what it was given: dashed in every plot."""
MAX_NAMED = 18
"""Curves that a legend names; of more the first, the last and some between."""
FAR_ABOVE = 2.5
"""The control is clipped when it is this many times higher than all other curves."""
COUNTED = ("armPosition", "iteration")
"""Levels that are whole numbers."""
FOLD = 28
"""Letters of an axis' name before it is folded."""
FEW_LEVELS = 6
"""Levels up to which every one has its tick."""
FEWEST_FOR_BOX = 5
"""The number of values from which on a level has a box."""
MAX_INSIDE = 4
"""Greatest number of curves with the legend inside the axes."""


@dataclass(frozen=True, kw_only=True)
class Look:
    """How a curve looks."""

    colour: str
    marker: str
    line: Any = "-"


CONTROL_LOOK = Look(colour=INK, marker="o", line=(0, (4, 2)))


def look_of(i: int, n: int) -> Look:
    """The style of curve i of n; many curves are coloured by a scale."""
    marker = MARKERS[i % len(MARKERS)]
    if n <= len(PALETTE):
        return Look(colour=PALETTE[i], marker=marker)
    return Look(colour=to_hex(mpl.colormaps["viridis"](0.92 * i / (n - 1))), marker=marker)


def draw_column(
    axes: Axes,
    result: Result,
    column: Column,
    curves: Sequence[Curve],
    control: Result | None,
    *,
    labels: bool = True,
    fold: int = FOLD,
) -> None:
    """Draw a column's curves, their references, and where they end."""
    for i, curve in enumerate(curves):
        look = look_of(i, len(curves))
        name = cut(curve.name or algorithm_of(result) or column.name)
        if curve.name:
            name = with_loss(name, curve)
        draw_curve(axes, curve, look, name)
        draw_repeats(axes, curve, look, with_boxes=len(curves) == 1)
        if len(curves) > 1:
            draw_end(axes, curve, look)
    compared = _curves_of_control(control, column.name)
    above = [_is_far_above(other, curves) for other in compared]
    for other, is_above in zip(compared, above, strict=True):
        name = f"{CONTROL}, {other.name}" if other.name else CONTROL
        if is_above:
            name += f": {other.mean_text}, above"
        draw_curve(axes, other, CONTROL_LOOK, name)
    near = [other for other, is_above in zip(compared, above, strict=True) if not is_above]
    scale_axes(axes, [*curves, *near])
    label_axes(axes, result, column, fold=fold)
    if all(curve.is_empty for curve in curves):
        say_no_data(axes, next((curve.why for curve in curves if curve.why), None))
    if len(curves) == 1:
        _draw_losses(axes, curves[0], labels)
    draw_prediction(axes, result, labels)


def add_legend(axes: Axes, n_curves: int) -> None:
    """Add a legend if there are several curves, next to the axes if there are many."""
    handles, names = legend_entries(axes)
    if n_curves > MAX_INSIDE:
        axes.figure.legend(handles, names, loc="outside right upper")
    elif len(handles) > 1:
        axes.legend(handles, names, loc="best")


def legend_entries(axes: Axes) -> tuple[list[Artist], list[str]]:
    """The legend's entries; of very many the first, the last and some between."""
    handles, names = axes.get_legend_handles_labels()
    if len(handles) > MAX_NAMED:
        kept = np.linspace(0, len(handles) - 1, MAX_NAMED).round().astype(int)
        handles, names = [handles[k] for k in kept], [names[k] for k in kept]
    return list(handles), names


def draw_curve(axes: Axes, curve: Curve, look: Look, name: str) -> None:
    """Draw means, their band, and hollow markers where not every repeat has a value."""
    is_control = look is CONTROL_LOOK
    axes.plot(
        curve.x,
        curve.mean,
        color=look.colour,
        linestyle=look.line,
        linewidth=1.1 if is_control else None,
        marker="none" if is_control and len(curve.x) > 1 else look.marker,
        label=plain(name),
        zorder=2.5 if is_control else 3,
    )
    partial = [k for k, n in enumerate(curve.n_missing) if n and not np.isnan(curve.mean[k])]
    if partial and not is_control:
        points = [curve.x[k] for k in partial], [curve.mean[k] for k in partial]
        axes.plot(*points, look.marker, color=look.colour, markerfacecolor="white", zorder=3.5)
    if len(curve.x) == 1:
        spread = [[curve.mean[0] - curve.low[0]], [curve.high[0] - curve.mean[0]]]
        if not np.isnan(spread).any():
            axes.errorbar(curve.x, curve.mean, yerr=spread, color=look.colour, capsize=4, zorder=3)
    elif not np.all(np.isnan(curve.low)):
        axes.fill_between(
            curve.x, curve.low, curve.high, color=look.colour, alpha=0.18, linewidth=0
        )


def draw_repeats(axes: Axes, curve: Curve, look: Look, *, with_boxes: bool) -> None:
    """Draw a point for each repeat, and at each level a box from the lower to the upper quartile.

    The line in the box is the median; whiskers reach to the last value within 1.5 times the box. A
    level with fewer than five values has points only.
    """
    if max(map(len, curve.values), default=0) < 2:
        return
    width = _box_width(curve.x)
    for x, values in zip(curve.x, curve.values, strict=True):
        n = len(values)
        offsets = (np.arange(n) - 0.5 * (n - 1)) / max(n - 1, 1) * (0.6 if with_boxes else 0.0)
        axes.plot(
            x + width * offsets, values, "o", color=look.colour, markersize=2.8, alpha=0.55,
            markeredgewidth=0, zorder=2.8,
        )  # fmt: skip
    boxed = [k for k, values in enumerate(curve.values) if len(values) >= FEWEST_FOR_BOX]
    if with_boxes and boxed:
        places = [curve.x[k] for k in boxed]
        draw_boxes(axes, [curve.values[k] for k in boxed], places, width, look.colour)


def draw_boxes(
    axes: Axes,
    values: Sequence[Sequence[float]],
    places: Sequence[float],
    width: float,
    colour: str,
    **settings: Any,
) -> None:
    """Draw boxes of quartiles with medians and whiskers, behind points; without outliers.

    Args:
        axes: where.
        values: those of each box.
        places: of the boxes along the other axis.
        width: of each.
        colour: of their lines.
        settings: others of Matplotlib.
    """
    line = {"color": colour, "linewidth": 0.7, "alpha": 0.8}
    axes.boxplot(
        values,
        positions=places,
        widths=width,
        manage_ticks=False,
        showfliers=False,
        boxprops=line,
        whiskerprops=line,
        capprops=line,
        medianprops={"color": INK, "linewidth": 1.0},
        zorder=2.7,
        **settings,
    )


def _box_width(levels: Iterable[float]) -> float:
    """Return the width of a box: a third of the least step, and a tenth of the axis at most."""
    xs = sorted(set(levels))
    if len(xs) < 2:
        return 0.3
    return float(min(0.36 * min(np.diff(xs)), 0.1 * (xs[-1] - xs[0])))


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
        _write_above(axes, last, curve.loss_text, PALETTE[1], line=1)


def draw_end(axes: Axes, curve: Curve, look: Look) -> None:
    """Mark with a cross the last value before a loss."""
    known = [k for k, value in enumerate(curve.mean) if not np.isnan(value)]
    if curve.losses and known and known[-1] < len(curve.x) - 1:
        x, y = curve.x[known[-1]], curve.mean[known[-1]]
        axes.plot([x], [y], "x", color=look.colour, markersize=8, mew=1.6, zorder=4)


def draw_prediction(axes: Axes, result: Result, label: bool = True) -> None:
    """Draw f*, the fog at which the ZNCC is expected to reach its threshold."""
    fact, levels = result.fact("f_star"), result.columns_of_kind("level")
    if fact is None or not is_fog_swept(result):
        return
    low, high = axes.get_xlim()
    text = f"$f^*$ = {_two_decimals(fact[0])} {plain(written_unit(fact[1]))}"
    x = fact[0]
    if (length := LENGTHS.get(levels[-1].name)) is not None:
        x = length(x) if x > 0.0 else math.inf
        text = f"{_two_decimals(x)} m, {text}"
    if low <= x <= high:
        axes.axvline(x, color=FAINT, linewidth=1.1, linestyle=(0, (1, 1.5)), zorder=2)
        if label:
            _write_above(axes, x, f"loss predicted at {text}", FAINT, line=0)
    elif label:
        _write_above(axes, high, f"loss predicted beyond these levels, {text}", FAINT, line=0)


def _two_decimals(number: float) -> str:
    """Two digits behind the point, unless there would be many before it."""
    return f"{number:.2f}" if abs(number) < 1e4 else f"{number:.3g}"


def is_fog_swept(result: Result) -> bool:
    """Whether the axis of the plots is fog, as a density or as a length."""
    levels = result.columns_of_kind("level")
    return bool(levels) and levels[-1].name in ("fog", *LENGTHS)


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


def label_axes(axes: Axes, result: Result, column: Column, *, fold: int = FOLD) -> None:
    """Label the axes with units; ticks are at the levels where these are few."""
    levels = result.columns_of_kind("level")
    if levels:
        axes.set_xlabel(plain(level_label(levels[-1])))
        xs = sorted({level[-1] for level in rows_by_level(result)})
        if levels[-1].name == "none":
            axes.set_xticks([])
        elif len(xs) == 1:
            axes.set_xticks(xs)
            axes.set_xlim(xs[0] - 1, xs[0] + 1)
        elif xs:
            has_repeats = len(set(repeats_of(result))) > 1
            pad = max(0.03 * (xs[-1] - xs[0]), 0.7 * _box_width(xs) * has_repeats)
            axes.set_xlim(xs[0] - pad, xs[-1] + pad)
            if len(xs) <= FEW_LEVELS:
                axes.set_xticks(xs, [f"{x:g}" for x in xs])
            elif levels[-1].name in COUNTED:
                axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_ylabel(plain(textwrap.fill(label_of(result, column), fold)))


def scale_axes(axes: Axes, curves: Sequence[Curve]) -> None:
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
        repeats = [v for curve in curves for values in curve.values for v in values]
        top = max([min(max([high, *limits]), 1.6 * high), *repeats]) * 1.12 or 1.0
        axes.set_ylim(-0.03 * top if low < 0.01 * high else 0, top)


def _is_far_above(other: Curve, curves: Sequence[Curve]) -> bool:
    """Whether drawing the control would press all else flat."""
    spans = [span for curve in curves if (span := curve.span) is not None]
    return (
        other.span is not None
        and bool(spans)
        and min(low for low, _ in spans) >= 0
        and other.span[0] > FAR_ABOVE * max(high for _, high in spans)
    )


def say_no_data(axes: Axes, why: str | None) -> None:
    """Write the reason where a curve would be."""
    axes.text(
        0.5,
        0.5,
        plain(textwrap.fill(f"no data: {why or 'no level was run'}", 60)),
        transform=axes.transAxes,
        ha="center",
        va="center",
        color=FAINT,
        bbox={"facecolor": "white", "edgecolor": "none"},
    )
    axes.set_yticks([])


def with_loss(name: str, curve: Curve) -> str:
    """Return a curve's name with where it was lost: ``esm (lost at 1.2)``."""
    return f"{name} ({curve.loss_text})" if curve.losses else name


def _curves_of_control(control: Result | None, column: str) -> list[Curve]:
    if control is None or column not in [c.name for c in control.columns]:
        return []
    return curves_of(control, column)[:1]
