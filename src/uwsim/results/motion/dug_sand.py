"""The sand that dredges removed from heaps during a trial, as a part of its motion track.

A table of integers has a row for each removal: the first frame after it, the index of the heap in
the scene, and the position of the tool from the heap's lower corner, in multiples of `GRAIN`. A row
with the position `NO_VALUE` restores all sand of the heap.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .packing import Table

GRAIN = 1e-6
"""The resolution of the positions [m]."""
NO_VALUE = -(2**31)
"""The integer that stands for no number."""
COLUMNS = 5
"""The number of columns of the table: frame, heap, x, y, z."""
Spot = tuple[int, int, int]
"""The position x, y, z of a removal from the heap's lower corner, in multiples of `GRAIN`."""


def no_digs() -> Table:
    """Return a table without removals."""
    return np.zeros((0, COLUMNS), np.int32)


@dataclass(frozen=True, kw_only=True, eq=False)
class DugSand:
    """The spots where sand was removed, in order."""

    table: Table = field(default_factory=no_digs)
    """The frame, the index of the heap and the position of each removal, (n, 5)."""

    def spots(self, heap: int, frame: int) -> list[Spot]:
        """Return the spots where sand was removed up to a frame, since the heap was last restored.

        Args:
            heap: the index of the heap in the scene.
            frame: the index of the frame.
        """
        rows = self.table[(self.table[:, 1] == heap) & (self.table[:, 0] <= frame), 2:]
        restorations = np.flatnonzero(rows[:, 0] == NO_VALUE)
        if len(restorations):
            rows = rows[restorations[-1] + 1 :]
        return [(x, y, z) for x, y, z in rows.tolist()]
