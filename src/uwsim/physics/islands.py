"""Whether MuJoCo solves the contacts of all bodies together, or each island of them alone.

An island is what contacts and constraints connect. Where many bodies lie at rest, one iteration of
the solver does for all of them, and islands are nothing but work. Where something moves, every
iteration is one of all bodies unless islands keep the others out of it. Both find the same
forces, within the solver's tolerance. What is chosen for a step depends on the step before alone,
and is part of the state: MuJoCo's own flag.
"""

from __future__ import annotations

from ..base.numerics.jit import njit
from ..base.numerics.memory import Ints64, read_int32, view_int32s
from .hydrodynamics.kernel import fields as f

FEW_ROWS = 256
"""Of constraints, 16 boxes on a floor: up to here islands cost nothing."""
PERIOD = 128
"""Steps between two tries without islands; one that is in vain costs some 1.6 steps."""
_WITHOUT_ISLANDS = 1 << 18  # mjDSBL_ISLAND


@njit
def choose_islands(m: int, d: int, at: Ints64, step: int) -> None:
    """Set MuJoCo's flag for the next step.

    Args:
        m: address of the model.
        d: address of the data, as a step has left it.
        at: offsets of the fields.
        step: steps taken.
    """
    flags = view_int32s(m + at[f.DISABLE], 1)
    if read_int32(d + at[f.N_ROWS]) <= FEW_ROWS:
        together = False
    elif (flags[0] & _WITHOUT_ISLANDS) != 0:
        together = read_int32(d + at[f.ITERATIONS]) <= 1
    else:
        together = step % PERIOD == 0
    flags[0] &= ~_WITHOUT_ISLANDS
    if together:
        flags[0] |= _WITHOUT_ISLANDS
