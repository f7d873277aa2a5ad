"""Where sand was taken during a trial, as a part of its motion track.

A table of whole numbers, a row for each time that a tool took sand of a heap: the frame from which
on it is seen, the heap's number in the scene, and the place in steps of `GRAIN` from the heap's
lower corner. A row with `NOTHING` for a place puts all the heap's sand back.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .packing import Table

GRAIN = 1e-6
"""Resolution of the places [m]."""
NOTHING = -(2**31)
COLUMNS = 5
Spot = tuple[int, int, int]
"""A place, from the heap's lower corner [`GRAIN`]."""


def no_digs() -> Table:
    """Return the table in which no sand was taken."""
    return np.zeros((0, COLUMNS), np.int32)


@dataclass(frozen=True, kw_only=True, eq=False)
class DugSand:
    """Where sand was taken, in order."""

    table: Table = field(default_factory=no_digs)
    """Frame, heap, and place, (n, 5)."""

    def spots(self, heap: int, frame: int) -> list[Spot]:
        """Return where sand of a heap had been taken by a frame, since it was last put back."""
        rows = self.table[(self.table[:, 1] == heap) & (self.table[:, 0] <= frame), 2:]
        put_back = np.flatnonzero(rows[:, 0] == NOTHING)
        if len(put_back):
            rows = rows[put_back[-1] + 1 :]
        return [(x, y, z) for x, y, z in rows.tolist()]
