"""Random numbers with random access."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

BLOCK = 1024
"""Rows drawn at once; part of what a seed means, so never to be changed."""


class Draws:
    """Rows of random numbers that do not depend on the order of access: drawn in order and kept."""

    def __init__(self, draw: Callable[[tuple[int, int]], npt.NDArray[np.float64]], width: int):
        self._draw, self._width = draw, width
        self._rows: list[list[float]] = []

    def row(self, k: int) -> list[float]:
        """Return row ``k``, (width,); of a negative k row 0."""
        k = max(k, 0)
        while k >= len(self._rows):
            self._rows += self._draw((BLOCK, self._width)).tolist()
        return self._rows[k]
