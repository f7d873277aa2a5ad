"""The puffs of sediment that thrusters stirred up in a trial, as a part of its motion track.

A table of integers has a row for each puff, in the order of their births: the columns are the time
of birth in multiples of `TICK`, the number of the puff, its centre in W and its width in multiples
of `LENGTH`, its mass in multiples of `MASS`, the velocity of its jet in multiples of `SPEED`, and
the height of the floor in W in multiples of `LENGTH`. A row with the mass `NO_VALUE` removes all
puffs: the scene was reset. How puffs move follows from `uwsim.particles.puffs`.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .packing import Table

TICK = 1e-4
"""The resolution of times [s]."""
LENGTH = 1e-4
"""The resolution of positions and widths [m]."""
MASS = 1e-7
"""The resolution of masses [kg]."""
SPEED = 1e-4
"""The resolution of velocities [m/s]."""
NO_VALUE = -(2**31)
"""The integer that stands for no number."""
STEPS = (TICK, 1.0, LENGTH, LENGTH, LENGTH, LENGTH, MASS, SPEED, SPEED, SPEED, LENGTH)
"""The resolution of each column."""
MASS_COLUMN = 6
"""The index of the column of the mass."""


def no_births() -> Table:
    """Return a table without puffs."""
    return np.zeros((0, len(STEPS)), np.int32)


def make_removal(time: float) -> Table:
    """Return the row of a reset of the scene at a time [s], (1, 11)."""
    row = np.zeros((1, len(STEPS)), np.int32)
    row[0, 0], row[0, MASS_COLUMN] = round(time / TICK), NO_VALUE
    return row


@dataclass(frozen=True, kw_only=True, eq=False)
class StirredSediment:
    """The puffs of sediment in the order of their births."""

    table: Table = field(default_factory=no_births)
    """The columns above, (n, 11)."""
