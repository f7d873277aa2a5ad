"""A growing table of random numbers that Python and compiled code can read in any order."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import address_of

BLOCK_SIZE = 1024
"""The number of rows drawn at a time. It determines the numbers of a seed; never change it."""
ROWS = np.dtype([("rows", np.int64), ("n", np.int64)])
"""The address of the rows, and their number."""

Draw = Callable[[tuple[int, int], Array], Array]
"""A function that draws the next rows; its arguments are their shape and all rows before them."""


class RandomTable:
    """A table of random numbers.

    The rows are drawn in order, so their values do not depend on the order of access.

    Args:
        draw: the function that draws the next rows.
        width: the number of values in a row.
    """

    def __init__(self, draw: Draw, width: int) -> None:
        self._draw, self._width = draw, width
        self._rows = np.zeros((0, width))
        self.record = np.zeros(1, ROWS)
        """The address and the number of the rows for compiled code, a record of `ROWS`, (1,)."""
        self.extend(0)

    def extend(self, k: int) -> None:
        """Draw rows until row k exists."""
        while k >= len(self._rows):
            next_rows = self._draw((BLOCK_SIZE, self._width), self._rows)
            self._rows = np.concatenate([self._rows, next_rows])
            self.record["rows"], self.record["n"] = address_of(self._rows), len(self._rows)
