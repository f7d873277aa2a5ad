"""Random numbers with random access, for compiled code too."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import address_of

BLOCK = 1024
"""Rows drawn at once; part of what a seed means, so never to be changed."""
ROWS = np.dtype([("rows", np.int64), ("n", np.int64)])
"""The address of the rows that are drawn, and how many there are."""

Draw = Callable[[tuple[int, int], Array], Array]
"""Shape of the next rows, and all rows before -> the next rows."""


class RandomTable:
    """Rows of random numbers that do not depend on the order of access: drawn in order and kept.

    Args:
        draw: draws the next rows.
        width: how many numbers a row has.
    """

    def __init__(self, draw: Draw, width: int) -> None:
        self._draw, self._width = draw, width
        self._rows = np.zeros((0, width))
        self.record = np.zeros(1, ROWS)
        """Where the rows are, for compiled code; a record of `ROWS`, (1,)."""
        self.extend(0)

    def extend(self, k: int) -> None:
        """Draw all rows up to number k that are not drawn yet."""
        while k >= len(self._rows):
            new = self._draw((BLOCK, self._width), self._rows)
            self._rows = np.concatenate([self._rows, new])
            self.record["rows"], self.record["n"] = address_of(self._rows), len(self._rows)
