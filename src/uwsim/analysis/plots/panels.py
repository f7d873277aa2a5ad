"""The panels of a figure, one for each level."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.ticker import MaxNLocator

T = TypeVar("T")
Level = tuple[float, ...]

MAX_PANELS = 6
"""The greatest number of levels in a figure; of more levels, evenly chosen ones are shown."""
PANEL_WIDTH, PANEL_HEIGHT = 2.5, 1.9
"""The size of a panel with its title [inch]."""
SINGLE_PANEL_SIZE = (5.0, 2.7)
"""The size of a figure with one panel [inch]."""


@dataclass(frozen=True, kw_only=True)
class Panels:
    """The levels that a figure shows, and how its panels are arranged."""

    levels: tuple[Level, ...]
    """The level of each panel."""
    n_levels: int
    """The number of all levels."""
    is_square: bool = False
    """True if the panels are square."""

    @property
    def n_columns(self) -> int:
        """The number of panels in a row."""
        n = len(self.levels)
        return n if n <= 3 else math.ceil(n / 2)

    @property
    def n_rows(self) -> int:
        """The number of rows."""
        return math.ceil(len(self.levels) / self.n_columns)

    @property
    def size(self) -> tuple[float, float]:
        """The size of the figure [inch]."""
        if len(self.levels) == 1:
            return (4.2, 3.9) if self.is_square else SINGLE_PANEL_SIZE
        height = PANEL_WIDTH + 0.2 if self.is_square else PANEL_HEIGHT
        return 0.5 + PANEL_WIDTH * self.n_columns, 0.7 + 0.1 * self.is_square + height * self.n_rows

    @property
    def note(self) -> str:
        """The note on the choice of levels; empty if all levels are shown."""
        n = len(self.levels)
        return f"{n} of {self.n_levels} levels, evenly chosen" if n < self.n_levels else ""

    def axes(self, figure: Figure, *, sharex: bool, sharey: bool) -> list[Axes]:
        """Return the axes of the panels, by row."""
        grid = figure.subplots(
            self.n_rows, self.n_columns, sharex=sharex, sharey=sharey, squeeze=False
        ).ravel()
        for axes in grid[len(self.levels) :]:
            axes.remove()
        return list(grid[: len(self.levels)])

    def label(self, grid: Sequence[Axes], x: str, y: str) -> None:
        """Label the axes at the left and at the bottom of the figure with ``x`` and ``y``."""
        layout = grid[0].figure.get_layout_engine()
        if isinstance(layout, ConstrainedLayoutEngine):
            layout.set(wspace=0.07)  # space between the numbers of two panels
        for i, axes in enumerate(grid):
            is_lowest = i + self.n_columns >= len(grid)
            axes.tick_params(labelbottom=is_lowest, labelleft=i % self.n_columns == 0)
            axes.xaxis.set_major_locator(MaxNLocator(5 if self.n_columns > 1 else 8))
            axes.set_xlabel(x if is_lowest else "")
            axes.set_ylabel(y if i % self.n_columns == 0 else "")


def choose_panels(levels: Iterable[Level], *, is_square: bool = False) -> Panels:
    """Return the panels of evenly chosen levels, with the first and the last."""
    all_levels = tuple(levels)
    shown_levels = tuple(choose_evenly(all_levels, MAX_PANELS))
    return Panels(levels=shown_levels, n_levels=len(all_levels), is_square=is_square)


def choose_evenly(items: Sequence[T], max_items: int) -> list[T]:
    """Return evenly chosen items of a sequence, with the first and the last."""
    if len(items) <= max_items:
        return list(items)
    return [
        items[i] for i in np.linspace(0, len(items) - 1, max_items).round().astype(int).tolist()
    ]
