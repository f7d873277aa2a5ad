"""The sand that dredges took during a trial, as a part of its motion track.

A table of whole numbers has a row for each time that a tool took sand of a heap: the first frame
after it, the heap's number in the scene, and the place in steps of `GRAIN` from the heap's lower
corner. A row with `NO_VALUE` for a place puts all the heap's sand back.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .packing import Table

GRAIN = 1e-6
"""The resolution of the places [m]."""
NO_VALUE = -(2**31)
COLUMNS = 5
Spot = tuple[int, int, int]
"""A place, from the heap's lower corner [`GRAIN`]."""


def no_digs() -> Table:
    """Return the table in which no sand was taken."""
    return np.zeros((0, COLUMNS), np.int32)


@dataclass(frozen=True, kw_only=True, eq=False)
class DugSand:
    """The places where sand was taken, in order."""

    table: Table = field(default_factory=no_digs)
    """The frame, heap and place of each dig, (n, 5)."""

    def spots(self, heap: int, frame: int) -> list[Spot]:
        """Return the places where sand of a heap was taken up to a frame, since its last refill."""
        rows = self.table[(self.table[:, 1] == heap) & (self.table[:, 0] <= frame), 2:]
        put_back = np.flatnonzero(rows[:, 0] == NO_VALUE)
        if len(put_back):
            rows = rows[put_back[-1] + 1 :]
        return [(x, y, z) for x, y, z in rows.tolist()]
