"""The panel with the curves of a level in a film, with a cursor at the displayed time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ..recorded import Curve, RecordedLevel
from .overlay import COLOURS, GREY, INK, PANEL, Pixels, blend, draw_lines, write_text

MAX_CURVES = 4
"""The greatest number of curves that are drawn if there are several measures."""
MAX_MEASURE_CURVES = 6
"""The greatest number of curves of a single measure: its value and the other columns of its log."""
CELL_GAP = 16
"""The space between the cells of two curves [px]."""


def select_curves(level: RecordedLevel, names: tuple[str, ...]) -> list[Curve]:
    """Return the curves of a level that are drawn.

    Args:
        level: the level.
        names: the names of the curves; empty: those of the first `MAX_CURVES` recorded measures,
            which are the measures with a log. If there is only one, all columns of its log, up to
            `MAX_MEASURE_CURVES`.
    """
    if names:
        by_name = {curve.measure: curve for curve in _drop_empty((*level.curves, *level.details))}
        return [by_name[name] for name in names if name in by_name]
    curves = _drop_empty(level.curves)
    if len(curves) == 1:
        return [*curves, *_drop_empty(level.details)][:MAX_MEASURE_CURVES]
    return curves[:MAX_CURVES]


def _drop_empty(curves: tuple[Curve, ...]) -> list[Curve]:
    return [curve for curve in curves if np.isfinite(curve.values).any()]


@dataclass(frozen=True, kw_only=True)
class _Cell:
    """The area of one curve in the panel."""

    curve: Curve
    name: str
    """The displayed name of the curve."""
    colour: tuple[int, int, int]
    x: int
    """The left column in the panel [px]."""
    y: int
    """The top row in the panel [px]."""
    width: int
    """The width [px]."""
    height: int
    """The height, with the name above the curve [px]."""


class CurvePanel:
    """The curves of one level in a grid, each with its own scale.

    Names and curves are drawn once; each image of the film adds the cursor and the values.

    Args:
        level: the level.
        names: the names of the curves; empty: see `select_curves`.
        box: the left column, top row, width and height in the film's image [px].
        letter_height: the height of the letters [px].
    """

    def __init__(
        self,
        level: RecordedLevel,
        names: tuple[str, ...],
        box: tuple[int, int, int, int],
        letter_height: int,
    ) -> None:
        self._level, self._box, self._letter_height = level, box, letter_height
        self._name_height = round(1.5 * letter_height)  # height of the row with name and value [px]
        self._cells = self._arrange(select_curves(level, names))
        _, _, width, height = box
        self._background: Pixels = np.full((height, width, 3), PANEL, np.uint8)
        lines = [(self._line(cell), cell.colour) for cell in self._cells]
        blend(self._background, draw_lines((width, height), lines), 0, 0)
        for cell in self._cells:
            write_text(self._background, cell.name, (cell.x, cell.y), letter_height, cell.colour)

    def draw(self, frame: Pixels, time: float) -> None:
        """Draw the panel into a frame, with the cursor and the values at a simulation time [s]."""
        x, y, width, height = self._box
        frame[y : y + height, x : x + width] = self._background
        for cell in self._cells:
            cursor = x + cell.x + self._cursor_x(time, cell.width)
            frame[
                y + cell.y + self._name_height : y + cell.y + cell.height, cursor : cursor + 2
            ] = INK
            unit = "" if cell.curve.unit == "1" else cell.curve.unit
            value = f"{format_value(value_at(cell.curve, time))} {unit}".strip()
            corner = x + cell.x + cell.width, y + cell.y
            write_text(frame, value, corner, self._letter_height, GREY, right=True)

    def _arrange(self, curves: list[Curve]) -> list[_Cell]:
        if not curves:
            return []
        n_rows = min(2, len(curves)) if len(curves) > 1 else 1
        n_columns = -(-len(curves) // n_rows)
        _, _, width, height = self._box
        cell_width, cell_height = width // n_columns, height // n_rows
        return [
            _Cell(
                curve=curve,
                name=short_name(curve.measure, curves),
                colour=COLOURS[index % len(COLOURS)],
                x=(index // n_rows) * cell_width,
                y=(index % n_rows) * cell_height,
                width=cell_width - CELL_GAP,
                height=cell_height - CELL_GAP // 2,
            )
            for index, curve in enumerate(curves)
        ]

    def _cursor_x(self, time: float, width: int) -> int:
        level = self._level
        fraction = (time - level.start_time) / max(level.end_time - level.start_time, 1e-9)
        return round(min(max(fraction, 0.0), 1.0) * (width - 2))

    def _line(self, cell: _Cell) -> Array:
        """Return the points of a curve's line in the panel, (n, 2) [px]."""
        level, curve = self._level, cell.curve
        low, high = scale_limits(curve.values)
        plot_height = max(1, cell.height - self._name_height - 3)
        fractions = (curve.times - level.start_time) / max(level.end_time - level.start_time, 1e-9)
        x = cell.x + fractions * (cell.width - 2)
        y = cell.y + self._name_height + (1.0 - (curve.values - low) / (high - low)) * plot_height
        return np.column_stack([x, y])


def short_name(name: str, curves: Sequence[Curve]) -> str:
    """Return the name of a curve for display; without the measure if all curves belong to one."""
    measures = {curve.measure.partition(".")[0] for curve in curves}
    return name.partition(".")[2] or name if len(measures) == 1 else name


def scale_limits(values: Array) -> tuple[float, float]:
    """Return the lower and upper limit of a curve's scale.

    The scale includes 0 if all values have one sign and some are less than half of the largest.
    """
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    if low > 0.0 and low < 0.5 * high:
        low = 0.0
    if high < 0.0 and high > 0.5 * low:
        high = 0.0
    if high - low < 1e-12 * max(abs(low), abs(high), 1e-3):
        return low - 0.5, high + 0.5
    return low, high


def value_at(curve: Curve, time: float) -> float:
    """Return the value of the last sample of a curve up to a time [s]; NaN if there is none."""
    index = int(np.searchsorted(curve.times, time + 1e-9, side="right")) - 1
    return float(curve.values[index]) if index >= 0 else float("nan")


def format_value(value: float) -> str:
    """Return the text of a value with three significant digits; a dash for NaN."""
    return "-" if not np.isfinite(value) else f"{value:.3g}"
