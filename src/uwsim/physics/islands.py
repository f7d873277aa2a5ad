"""The choice whether MuJoCo solves all contacts together, or each island of bodies alone.

An island is a set of bodies that contacts and constraints connect. Where many bodies are at rest,
one iteration of the solver is enough for all of them, and islands only take time. Where a body
moves, every iteration is one of all bodies without islands, and one of its island with them. Both
find the same forces, within the solver's tolerance. The choice for a step depends only on the step
before, and is part of the state: MuJoCo's own flag.
"""

from __future__ import annotations

from ..base.numerics.jit import njit
from ..base.numerics.memory import Ints64, read_int32, view_int32s
from .hydrodynamics.kernel import fields as f

FEW_ROWS = 256
"""The number of constraint rows up to which islands cost nothing: 16 boxes on a floor."""
PERIOD = 128
"""The steps between two tries without islands; a try in vain costs some 1.6 steps."""
_ISLANDS_OFF = 1 << 18  # mjDSBL_ISLAND


@njit
def choose_islands(m: int, d: int, o: Ints64, step: int) -> None:
    """Set MuJoCo's flag for the next step.

    Args:
        m: the address of the model.
        d: the address of the data, after a step.
        o: the offsets of the fields.
        step: the number of steps taken.
    """
    flags = view_int32s(m + o[f.DISABLE], 1)
    if read_int32(d + o[f.N_ROWS]) <= FEW_ROWS:
        is_one_island = False
    elif (flags[0] & _ISLANDS_OFF) != 0:
        is_one_island = read_int32(d + o[f.ITERATIONS]) <= 1
    else:
        is_one_island = step % PERIOD == 0
    flags[0] &= ~_ISLANDS_OFF
    if is_one_island:
        flags[0] |= _ISLANDS_OFF
