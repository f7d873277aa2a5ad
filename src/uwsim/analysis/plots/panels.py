"""Panels of a figure, one for each level."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.ticker import MaxNLocator

Level = tuple[float, ...]

MAX_PANELS = 6
"""The greatest number of levels in a figure; of more the first, the last and some between."""
WIDTH, HEIGHT = 2.5, 1.9
"""Of a panel, with its title [inch]."""
ALONE = (5.0, 2.7)
"""The size of a figure with one panel [inch]."""


@dataclass(frozen=True, kw_only=True)
class Panels:
    """The levels that a figure shows, and how its panels are arranged."""

    levels: tuple[Level, ...]
    """The level of each panel."""
    n_levels: int
    """The number of all levels."""
    is_square: bool = False
    """Whether the panels are as high as wide."""

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
            return (4.2, 3.9) if self.is_square else ALONE
        height = WIDTH + 0.2 if self.is_square else HEIGHT
        return 0.5 + WIDTH * self.n_columns, 0.7 + 0.1 * self.is_square + height * self.n_rows

    @property
    def note(self) -> str:
        """Which levels are shown; empty where all are."""
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
        """Label the axes at the left and at the bottom of the figure."""
        layout = grid[0].figure.get_layout_engine()
        if isinstance(layout, ConstrainedLayoutEngine):
            layout.set(wspace=0.07)  # the numbers of two panels do not touch
        for i, axes in enumerate(grid):
            is_lowest = i + self.n_columns >= len(grid)
            axes.tick_params(labelbottom=is_lowest, labelleft=i % self.n_columns == 0)
            axes.xaxis.set_major_locator(MaxNLocator(5 if self.n_columns > 1 else 8))
            axes.set_xlabel(x if is_lowest else "")
            axes.set_ylabel(y if i % self.n_columns == 0 else "")


def panels_of(levels: Iterable[Level], *, is_square: bool = False) -> Panels:
    """Choose evenly from levels, the first and the last among them."""
    known = tuple(levels)
    kept = np.linspace(0, len(known) - 1, min(len(known), MAX_PANELS)).round().astype(int)
    return Panels(
        levels=tuple(known[i] for i in kept.tolist()), n_levels=len(known), is_square=is_square
    )
