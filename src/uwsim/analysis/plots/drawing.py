"""The drawing of curves on axes, with losses, the predicted loss, labels and legends."""

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
from .panels import choose_evenly
from .style import GREY, INK, MARKERS, PALETTE, escape, level_label, shorten_name

CONTROL_ALGORITHM = "frozen"
"""The algorithm of the control run, which repeats its initial corners; its line is dashed in every
plot."""
MAX_LEGEND_ENTRIES = 18
"""The greatest number of entries of a legend; of more entries, evenly chosen ones are shown."""
CONTROL_CLIP_RATIO = 2.5
"""The factor by which the control run must be higher than all other curves to be clipped [1]."""
INTEGER_LEVELS = ("armPosition", "iteration")
"""The levels with integer values."""
LABEL_WIDTH = 28
"""The greatest number of characters in a line of an axis label."""
MAX_LEVEL_TICKS = 6
"""The greatest number of levels that all have ticks."""
MIN_BOX_VALUES = 5
"""The minimum number of values for which a box of quartiles is drawn."""
MAX_INSIDE = 4
"""The greatest number of curves for which the legend is inside the axes."""


@dataclass(frozen=True, kw_only=True)
class LineStyle:
    """The colour, marker and dashes of a curve."""

    colour: str
    """The colour as ``#rrggbb``."""
    marker: str
    """The marker of matplotlib, such as ``o``."""
    dashes: Any = "-"
    """The line style of matplotlib."""


CONTROL_STYLE = LineStyle(colour=INK, marker="o", dashes=(0, (4, 2)))


def curve_style(i: int, n: int) -> LineStyle:
    """Return the style of curve i of n; if there are many curves, colours are from a colour map."""
    marker = MARKERS[i % len(MARKERS)]
    if n <= len(PALETTE):
        return LineStyle(colour=PALETTE[i], marker=marker)
    return LineStyle(colour=to_hex(mpl.colormaps["viridis"](0.92 * i / (n - 1))), marker=marker)


def draw_column(
    axes: Axes,
    result: Result,
    column: Column,
    curves: Sequence[Curve],
    control: Result | None,
    *,
    has_labels: bool = True,
    label_width: int = LABEL_WIDTH,
) -> None:
    """Draw the curves of a column with the control run, losses and the predicted loss."""
    for i, curve in enumerate(curves):
        style = curve_style(i, len(curves))
        name = shorten_name(curve.name or algorithm_of(result) or column.name)
        if curve.name:
            name = with_loss(name, curve)
        draw_curve(axes, curve, style, name)
        draw_repeats(axes, curve, style, with_boxes=len(curves) == 1)
        if len(curves) > 1:
            draw_end(axes, curve, style)
    controls = _curves_of_control_run(control, column.name)
    for other in controls:
        name = f"{CONTROL_ALGORITHM}, {other.name}" if other.name else CONTROL_ALGORITHM
        if _is_far_above(other, curves):
            name += f": {other.mean_text}, above"
        draw_curve(axes, other, CONTROL_STYLE, name)
    near_curves = [other for other in controls if not _is_far_above(other, curves)]
    scale_axes(axes, [*curves, *near_curves])
    label_axes(axes, result, column, label_width)
    if all(curve.is_empty for curve in curves):
        write_no_data(axes, next((curve.reason for curve in curves if curve.reason), None))
    if len(curves) == 1:
        _draw_losses(axes, curves[0], has_labels)
    draw_prediction(axes, result, has_labels)


def add_legend(axes: Axes, n_curves: int) -> None:
    """Add a legend if there are several curves, next to the axes if there are many."""
    handles, names = legend_entries(axes)
    if n_curves > MAX_INSIDE:
        axes.figure.legend(handles, names, loc="outside right upper")
    elif len(handles) > 1:
        axes.legend(handles, names, loc="best")


def legend_entries(axes: Axes) -> tuple[list[Artist], list[str]]:
    """Return the handles and names in the legend; of many, evenly chosen ones."""
    handles, names = axes.get_legend_handles_labels()
    return choose_evenly(handles, MAX_LEGEND_ENTRIES), choose_evenly(names, MAX_LEGEND_ENTRIES)


def draw_curve(axes: Axes, curve: Curve, style: LineStyle, name: str) -> None:
    """Draw the means with the band of their intervals; a level with missing values is hollow."""
    is_control = style is CONTROL_STYLE
    axes.plot(
        curve.x,
        curve.mean,
        color=style.colour,
        linestyle=style.dashes,
        linewidth=1.1 if is_control else None,
        marker="none" if is_control and len(curve.x) > 1 else style.marker,
        label=escape(name),
        zorder=2.5 if is_control else 3,
    )
    partial_levels = [k for k, n in enumerate(curve.n_missing) if n and not np.isnan(curve.mean[k])]
    if partial_levels and not is_control:
        points = [curve.x[k] for k in partial_levels], [curve.mean[k] for k in partial_levels]
        axes.plot(*points, style.marker, color=style.colour, markerfacecolor="white", zorder=3.5)
    if len(curve.x) == 1:
        errors = [[curve.mean[0] - curve.low[0]], [curve.high[0] - curve.mean[0]]]
        if not np.isnan(errors).any():
            axes.errorbar(curve.x, curve.mean, yerr=errors, color=style.colour, capsize=4, zorder=3)
    elif not np.all(np.isnan(curve.low)):
        axes.fill_between(
            curve.x, curve.low, curve.high, color=style.colour, alpha=0.18, linewidth=0
        )


def draw_repeats(axes: Axes, curve: Curve, style: LineStyle, *, with_boxes: bool) -> None:
    """Draw a point for each repeat, and at each level a box from the lower to the upper quartile.

    The line in the box is the median. Whiskers reach to the last value within 1.5 times the length
    of the box. A level with fewer than `MIN_BOX_VALUES` values has points only.
    """
    if max(map(len, curve.values), default=0) < 2:
        return
    width = _box_width(curve.x)
    for x, values in zip(curve.x, curve.values, strict=True):
        n = len(values)
        offsets = (np.arange(n) - 0.5 * (n - 1)) / max(n - 1, 1) * (0.6 if with_boxes else 0.0)
        axes.plot(
            x + width * offsets, values, "o", color=style.colour, markersize=2.8, alpha=0.55,
            markeredgewidth=0, zorder=2.8,
        )  # fmt: skip
    box_indices = [k for k, values in enumerate(curve.values) if len(values) >= MIN_BOX_VALUES]
    if with_boxes and box_indices:
        positions = [curve.x[k] for k in box_indices]
        draw_boxes(axes, [curve.values[k] for k in box_indices], positions, width, style.colour)


def draw_boxes(
    axes: Axes,
    values: Sequence[Sequence[float]],
    positions: Sequence[float],
    width: float,
    colour: str,
    **settings: Any,
) -> None:
    """Draw boxes of quartiles with medians and whiskers, but no outliers, behind the points.

    Args:
        axes: the axes to draw on.
        values: the values of each box.
        positions: the positions of the boxes along the other axis.
        width: the width of each box, in units of the other axis.
        colour: the colour of the lines.
        settings: other arguments of `Axes.boxplot`.
    """
    line_settings = {"color": colour, "linewidth": 0.7, "alpha": 0.8}
    axes.boxplot(
        values,
        positions=positions,
        widths=width,
        manage_ticks=False,
        showfliers=False,
        boxprops=line_settings,
        whiskerprops=line_settings,
        capprops=line_settings,
        medianprops={"color": INK, "linewidth": 1.0},
        zorder=2.7,
        **settings,
    )


def _box_width(levels: Iterable[float]) -> float:
    """Return the width of a box: 0.36 of the minimum level step, at most a tenth of the axis."""
    xs = sorted(set(levels))
    if len(xs) < 2:
        return 0.3
    return float(min(0.36 * min(np.diff(xs)), 0.1 * (xs[-1] - xs[0])))


def _draw_losses(axes: Axes, curve: Curve, has_label: bool) -> None:
    """Mark the first level that did not end ok with a line; several repeats with a band."""
    if not curve.losses:
        return
    levels = [level for level, _ in curve.losses]
    first_level, last_level = min(levels), max(levels)
    if first_level < last_level:
        axes.axvspan(first_level, last_level, color=PALETTE[1], alpha=0.10, linewidth=0, zorder=1)
    for level in dict.fromkeys((first_level, last_level)):
        axes.axvline(level, color=PALETTE[1], linewidth=1.0, zorder=2)
    if has_label:
        _write_above_axes(axes, last_level, curve.loss_text, PALETTE[1], line=1)


def draw_end(axes: Axes, curve: Curve, style: LineStyle) -> None:
    """Mark with a cross the last value before a loss."""
    indices = [k for k, value in enumerate(curve.mean) if not np.isnan(value)]
    if curve.losses and indices and indices[-1] < len(curve.x) - 1:
        x, y = curve.x[indices[-1]], curve.mean[indices[-1]]
        axes.plot([x], [y], "x", color=style.colour, markersize=8, mew=1.6, zorder=4)


def draw_prediction(axes: Axes, result: Result, has_label: bool = True) -> None:
    """Draw f*, the fog at which the ZNCC is expected to reach its threshold."""
    fact, levels = result.fact("f_star"), result.columns_of_kind("level")
    if fact is None or not is_fog_swept(result):
        return
    low, high = axes.get_xlim()
    text = f"$f^*$ = {_two_decimals(fact[0])} {escape(written_unit(fact[1]))}"
    x = fact[0]
    if (length := LENGTHS.get(levels[-1].name)) is not None:
        x = length(x) if x > 0.0 else math.inf
        text = f"{_two_decimals(x)} m, {text}"
    if low <= x <= high:
        axes.axvline(x, color=GREY, linewidth=1.1, linestyle=(0, (1, 1.5)), zorder=2)
        if has_label:
            _write_above_axes(axes, x, f"predicted loss at {text}", GREY, line=0)
    elif has_label:
        _write_above_axes(axes, high, f"predicted loss beyond these levels, {text}", GREY, line=0)


def _two_decimals(number: float) -> str:
    """Return a number with two decimals, or a large number with three significant digits."""
    return f"{number:.2f}" if abs(number) < 1e4 else f"{number:.3g}"


def is_fog_swept(result: Result) -> bool:
    """Return True if the innermost level is fog, as a density or as a length."""
    levels = result.columns_of_kind("level")
    return bool(levels) and levels[-1].name in ("fog", *LENGTHS)


def _write_above_axes(axes: Axes, x: float, text: str, colour: str, *, line: int) -> None:
    """Write a text above the axes that ends (in the left half: begins) at the vertical line x."""
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


def label_axes(axes: Axes, result: Result, column: Column, label_width: int = LABEL_WIDTH) -> None:
    """Label the axes with units, and set the ticks; a few levels all have a tick."""
    levels = result.columns_of_kind("level")
    if levels:
        axes.set_xlabel(escape(level_label(levels[-1])))
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
            if len(xs) <= MAX_LEVEL_TICKS:
                axes.set_xticks(xs, [f"{x:g}" for x in xs])
            elif levels[-1].name in INTEGER_LEVELS:
                axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_ylabel(escape(textwrap.fill(label_of(result, column), label_width)))


def scale_axes(axes: Axes, curves: Sequence[Curve]) -> None:
    """Set the vertical scale: logarithmic for ratios from 50 to 1000, or else linear from 0.

    Negative values leave the scale unchanged. Values below a thousandth of the largest value count
    as zero, such as those of a control run that repeats the truth.
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
    """Return True if an axis with the curve of the control run would make all others flat."""
    spans = [span for curve in curves if (span := curve.span) is not None]
    return (
        other.span is not None
        and bool(spans)
        and min(low for low, _ in spans) >= 0
        and other.span[0] > CONTROL_CLIP_RATIO * max(high for _, high in spans)
    )


def write_no_data(axes: Axes, reason: str | None) -> None:
    """Write the reason for missing values in the middle of the axes."""
    axes.text(
        0.5,
        0.5,
        escape(textwrap.fill(f"no data: {reason or 'no level was run'}", 60)),
        transform=axes.transAxes,
        ha="center",
        va="center",
        color=GREY,
        bbox={"facecolor": "white", "edgecolor": "none"},
    )
    axes.set_yticks([])


def with_loss(name: str, curve: Curve) -> str:
    """Return a curve's name with the level of its loss: ``esm (lost at 1.2)``."""
    return f"{name} ({curve.loss_text})" if curve.losses else name


def _curves_of_control_run(control: Result | None, column: str) -> list[Curve]:
    if control is None or column not in [c.name for c in control.columns]:
        return []
    return curves_of(control, column)[:1]
