"""The choice whether MuJoCo solves all contacts together, or each island of bodies separately.

An island is a set of bodies that are connected by contacts and constraints. If many bodies are at
rest, one iteration of the solver is enough for all of them, and the search for islands only takes
time. If a body moves, each further iteration includes all bodies without islands, but only its
island with them. Both ways give the same forces within the tolerance of the solver. The choice for
a step depends only on the step before. It is stored in MuJoCo's own flag, and thus part of the
state.
"""

from __future__ import annotations

from ..base.numerics.jit import njit
from ..base.numerics.memory import Ints64, read_int32, view_int32s
from .hydrodynamics.kernel import fields as f

FEW_ROWS = 256
"""The number of constraint rows up to which islands take no time, such as 16 boxes on a floor."""
PERIOD = 128
"""The number of steps between two trials without islands; a futile trial costs about 1.6 steps."""
_ISLANDS_OFF = 1 << 18  # mjDSBL_ISLAND


@njit
def choose_islands(m: int, d: int, o: Ints64, step: int) -> None:
    """Set MuJoCo's flag for the next step.

    Args:
        m: the address of the engine's model.
        d: the address of the engine's data, after a step.
        o: the offsets of fields; see `hydrodynamics.kernel.fields`.
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
