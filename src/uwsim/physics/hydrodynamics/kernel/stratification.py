"""Water whose density changes with depth: linear between levels, constant above and below them.

Buoyancy, added mass and drag of a body, and the forces on a fin, grow with the density where it is.
Not modelled: the rate of change of added mass that goes with it, internal waves, and what a body
that moves through layers does to them.
"""

from __future__ import annotations

from ....base.numerics.jit import njit
from ....base.numerics.memory import Floats, Ints64, read_int64, view_doubles
from ..columns import BODY_COLUMNS, LEVELS, N_LEVELS, SURFACE
from . import fields as f


@njit
def density_ratio(m: int, at: Ints64, height: float) -> float:
    """Density at a height in W [m], relative to that of the model's water."""
    world = view_doubles(read_int64(m + at[f.BODY_USER]), BODY_COLUMNS)
    if world[N_LEVELS] == 0.0:
        return 1.0
    return 1.0 + excess(world, world[SURFACE] - height)


@njit
def excess(world: Floats, depth: float) -> float:
    """By how much water at a depth [m] is denser than the model's, of the latter.

    Args:
        world: the row of the world body.
        depth: below the still surface.
    """
    n = int(world[N_LEVELS])
    k = 1
    while k < n - 1 and world[LEVELS + 2 * k] < depth:
        k += 1
    first, second = LEVELS + 2 * (k - 1), LEVELS + 2 * k
    share = (depth - world[first]) / (world[second] - world[first])
    share = min(max(share, 0.0), 1.0)
    found: float = world[first + 1] + share * (world[second + 1] - world[first + 1])
    return found
