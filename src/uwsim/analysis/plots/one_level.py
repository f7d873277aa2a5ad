"""The plot of a result with one level: a row for each column, with a point for each repeat."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ...results.result import Result
from .curves import Curve, curves_of, label_of
from .drawing import MIN_BOX_VALUES, draw_boxes
from .style import PALETTE, escape, styled_figure, write_note

MARKS_NOTE = "dots: repeats; circle: mean with its 95 % interval; boxes: quartiles and median"


def one_level_plot(result: Result) -> Figure | None:
    """Draw the values of all repeats, in a row for each column; None if no column has values."""
    columns = result.columns_of_kind("score") + result.columns_of_kind("measure")
    column_curves = [(column, curves_of(result, column.name)) for column in columns]
    rows = [(column, c[0]) for column, c in column_curves if c and c[0].values[0]]
    if not rows:
        return None
    with styled_figure((6.4, 0.5 + 0.62 * len(rows))) as figure:
        grid = figure.subplots(len(rows), 1, squeeze=False).ravel()
        for axes, (column, curve) in zip(grid, rows, strict=True):
            _draw(axes, curve)
            axes.set_ylabel(
                escape(label_of(result, column)), rotation=0, ha="right", va="center", labelpad=8
            )
        write_note(figure, MARKS_NOTE)
    return figure


def _draw(axes: Axes, curve: Curve) -> None:
    values, colour = curve.values[0], PALETTE[0]
    if len(values) >= MIN_BOX_VALUES:
        draw_boxes(axes, [values], [-0.35], 0.4, colour, orientation="horizontal")
    axes.plot(values, [0.3] * len(values), "o", color=colour, markersize=3.2, alpha=0.55, mew=0)
    low, high = curve.low[0], curve.high[0]
    if low == low and high == high:  # neither is NaN
        axes.plot([low, high], [-0.05, -0.05], color=PALETTE[1], linewidth=1.4)
    axes.plot(curve.mean[:1], [-0.05], "o", color=PALETTE[1], markersize=4, markerfacecolor="white")
    axes.set(ylim=(-0.75, 0.65), yticks=[])
    axes.margins(x=0.08)
    axes.spines["left"].set_visible(False)
    axes.xaxis.set_major_locator(MaxNLocator(7))
    axes.tick_params(labelsize=7)
