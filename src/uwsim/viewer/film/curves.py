"""The curves of a level under a film, with a cursor that runs along."""

from __future__ import annotations

import numpy as np

from ...geometry import Array
from ..recorded import Curve, RecordedLevel
from .overlay import COLOURS, DIM, INK, Pixels, blend, polyline, shade, write

MAX_CURVES = 4
"""Drawn at once."""
MAX_OF_ONE = 6
"""The same, of the one measure that has a log, with the further columns of it."""


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


class CurvePanel:
    """The curves of one level, one above the other, each with its own scale.

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
        self._curves = chosen(level, names)
        _, _, width, height = box
        self._head = round(1.5 * letters)
        self._row = height // max(1, len(self._curves))
        lines = [
            (self._line(curve, number, width), COLOURS[number % len(COLOURS)])
            for number, curve in enumerate(self._curves)
        ]
        self._drawing = polyline((width, height), lines)

    @property
    def is_empty(self) -> bool:
        """Whether there is nothing to draw."""
        return not self._curves

    def draw(self, frame: Pixels, time: float) -> None:
        """Draw it into a frame, with the cursor at a time [s] and the values there."""
        if self.is_empty:
            return
        x, y, width, height = self._box
        shade(frame, x, y, width, height)
        blend(frame, self._drawing, x, y)
        at = self._across(time, width)
        frame[y : y + height, x + at : x + at + 2] = INK
        for number, curve in enumerate(self._curves):
            top = y + number * self._row + 3
            colour = COLOURS[number % len(COLOURS)]
            write(frame, curve.measure, (x + 8, top), self._letters, colour)
            value = f"{shown(value_at(curve, time))} {'' if curve.unit == '1' else curve.unit}"
            write(frame, value.strip(), (x + width - 8, top), self._letters, DIM, right=True)

    def _across(self, time: float, width: int) -> int:
        level = self._level
        share = (time - level.began) / max(level.ended - level.began, 1e-9)
        return round(min(max(share, 0.0), 1.0) * (width - 2))

    def _line(self, curve: Curve, number: int, width: int) -> Array:
        """The curve in pixels of the panel, (n, 2)."""
        level = self._level
        low, high = span(curve.values)
        top, room = number * self._row + self._head, max(1, self._row - self._head - 6)
        x = (curve.times - level.began) / max(level.ended - level.began, 1e-9) * (width - 2)
        y = top + (1.0 - (curve.values - low) / (high - low)) * room
        return np.column_stack([x, y])


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
