"""The curves of a level under a film, with a cursor that runs along."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ..recorded import Curve, RecordedLevel
from .overlay import COLOURS, DIM, INK, PANEL, Pixels, blend, polyline, write

MAX_CURVES = 4
"""Drawn at once."""
MAX_OF_ONE = 6
"""The same, of the one measure that has a log, with the further columns of it."""
GAP = 16
"""Space between two curves [px]."""


def chosen(level: RecordedLevel, names: tuple[str, ...]) -> list[Curve]:
    """Return the curves of a level that are drawn: those named, or the first ones.

    Where one measure alone has a log, the further columns of the log are drawn with it.
    """
    if names:
        by_name = {curve.measure: curve for curve in _seen((*level.curves, *level.details))}
        return [by_name[name] for name in names if name in by_name]
    curves = _seen(level.curves)
    if len(curves) == 1:
        return [*curves, *_seen(level.details)][:MAX_OF_ONE]
    return curves[:MAX_CURVES]


def _seen(curves: tuple[Curve, ...]) -> list[Curve]:
    """Those that have a value at all."""
    return [curve for curve in curves if np.isfinite(curve.values).any()]


@dataclass(frozen=True, kw_only=True)
class _Cell:
    """The place of one curve in the panel [px]."""

    curve: Curve
    name: str
    colour: tuple[int, int, int]
    x: int
    y: int
    width: int
    height: int


class CurvePanel:
    """The curves of one level in a grid, each with its own scale.

    Names and curves are drawn once; an image of the film adds the cursor and the values.

    Args:
        level: the level.
        names: of measures whose curves are drawn; empty: the first ones.
        box: x, y, width and height in the frame [px].
        letters: height of the letters [px].
    """

    def __init__(
        self,
        level: RecordedLevel,
        names: tuple[str, ...],
        box: tuple[int, int, int, int],
        letters: int,
    ) -> None:
        self._level, self._box, self._letters = level, box, letters
        self._head = round(1.5 * letters)
        self._cells = self._arrange(chosen(level, names))
        _, _, width, height = box
        self._ground: Pixels = np.full((height, width, 3), PANEL, np.uint8)
        lines = [(self._line(cell), cell.colour) for cell in self._cells]
        blend(self._ground, polyline((width, height), lines), 0, 0)
        for cell in self._cells:
            write(self._ground, cell.name, (cell.x, cell.y), letters, cell.colour)

    def draw(self, frame: Pixels, time: float) -> None:
        """Draw it into a frame, with the cursor at a time [s] and the values there."""
        x, y, width, height = self._box
        frame[y : y + height, x : x + width] = self._ground
        for cell in self._cells:
            cursor = x + cell.x + self._across(time, cell.width)
            frame[y + cell.y + self._head : y + cell.y + cell.height, cursor : cursor + 2] = INK
            unit = "" if cell.curve.unit == "1" else cell.curve.unit
            value = f"{shown(value_at(cell.curve, time))} {unit}".strip()
            corner = x + cell.x + cell.width, y + cell.y
            write(frame, value, corner, self._letters, DIM, right=True)

    def _arrange(self, curves: list[Curve]) -> list[_Cell]:
        """Return the cells: two rows where there are more than two curves."""
        if not curves:
            return []
        n_rows = min(2, len(curves)) if len(curves) > 1 else 1
        n_columns = -(-len(curves) // n_rows)
        _, _, width, height = self._box
        wide, tall = width // n_columns, height // n_rows
        return [
            _Cell(
                curve=curve,
                name=short_name(curve.measure, curves),
                colour=COLOURS[number % len(COLOURS)],
                x=(number // n_rows) * wide,
                y=(number % n_rows) * tall,
                width=wide - GAP,
                height=tall - GAP // 2,
            )
            for number, curve in enumerate(curves)
        ]

    def _across(self, time: float, width: int) -> int:
        level = self._level
        share = (time - level.began) / max(level.ended - level.began, 1e-9)
        return round(min(max(share, 0.0), 1.0) * (width - 2))

    def _line(self, cell: _Cell) -> Array:
        """The curve in pixels of the panel, (n, 2)."""
        level, curve = self._level, cell.curve
        low, high = span(curve.values)
        room = max(1, cell.height - self._head - 3)
        share = (curve.times - level.began) / max(level.ended - level.began, 1e-9)
        x = cell.x + share * (cell.width - 2)
        y = cell.y + self._head + (1.0 - (curve.values - low) / (high - low)) * room
        return np.column_stack([x, y])


def short_name(name: str, curves: Sequence[Curve]) -> str:
    """Return the name of a curve, without the name of the measure if all are of that measure."""
    measures = {curve.measure.partition(".")[0] for curve in curves}
    return name.partition(".")[2] or name if len(measures) == 1 else name


def span(values: Array) -> tuple[float, float]:
    """Return the ends of the scale of a curve: 0 is in it where the curve comes near."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    if low > 0.0 and low < 0.5 * high:
        low = 0.0
    if high < 0.0 and high > 0.5 * low:
        high = 0.0
    if high - low < 1e-12 * max(abs(low), abs(high), 1e-3):
        return low - 0.5, high + 0.5
    return low, high


def value_at(curve: Curve, time: float) -> float:
    """Return the newest sample of a curve at a time [s]; NaN before the first."""
    number = int(np.searchsorted(curve.times, time + 1e-9, side="right")) - 1
    return float(curve.values[number]) if number >= 0 else float("nan")


def shown(value: float) -> str:
    """Return a value with three digits; a dash where there is none."""
    return "-" if not np.isfinite(value) else f"{value:.3g}"
