"""Random numbers with random access, for compiled code too."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import address_of

BLOCK_SIZE = 1024
"""The number of rows of a draw. It determines the numbers of a seed; never change it."""
ROWS = np.dtype([("rows", np.int64), ("n", np.int64)])
"""The address and the number of the rows."""

Draw = Callable[[tuple[int, int], Array], Array]
"""The function that draws rows of a shape, and takes the rows before."""


class RandomTable:
    """A table of random numbers whose rows are drawn in order, for any order of access.

    Args:
        draw: draws the next rows.
        width: the length of a row.
    """

    def __init__(self, draw: Draw, width: int) -> None:
        self._draw, self._width = draw, width
        self._rows = np.zeros((0, width))
        self.record = np.zeros(1, ROWS)
        """The address and the number of the rows, for compiled code: a record of `ROWS`, (1,)."""
        self.extend(0)

    def extend(self, k: int) -> None:
        """Draw the missing rows up to number k."""
        while k >= len(self._rows):
            next_rows = self._draw((BLOCK_SIZE, self._width), self._rows)
            self._rows = np.concatenate([self._rows, next_rows])
            self.record["rows"], self.record["n"] = address_of(self._rows), len(self._rows)
