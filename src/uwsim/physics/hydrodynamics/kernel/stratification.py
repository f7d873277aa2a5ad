"""Stratified water, whose density is linear between given depths and constant outside of them.

Buoyancy, added mass and drag of a body, and the forces on a fin, are proportional to the density at
the body or fin. Not modelled: forces by the rate of change of the added mass, internal waves,
mixing of the water by moving bodies.
"""

from __future__ import annotations

from ....base.numerics.jit import njit, njit_borrowed
from ....base.numerics.memory import Floats, Ints64, read_int64, view_doubles
from ..columns import BODY_COLUMNS, LEVELS, N_LEVELS, SURFACE
from . import fields as f


@njit
def density_ratio(m: int, o: Ints64, height: float) -> float:
    """Return the density at a height in the world [m], divided by that of the model's water."""
    return density_at_height(view_doubles(read_int64(m + o[f.BODY_USER]), BODY_COLUMNS), height)


@njit_borrowed
def density_at_height(world: Floats, height: float) -> float:
    """Return the density at a height in W [m], divided by that of the model's water.

    Args:
        world: the row of the world's body.
        height: the height [m].
    """
    if world[N_LEVELS] == 0.0:
        return 1.0
    return 1.0 + density_excess(world, world[SURFACE] - height)


@njit_borrowed
def density_excess(world: Floats, depth: float) -> float:
    """Return the density at a depth divided by that of the model's water, minus 1.

    Args:
        world: the row of the world's body.
        depth: the depth below the still surface [m].
    """
    n = int(world[N_LEVELS])
    k = 1
    while k < n - 1 and world[LEVELS + 2 * k] < depth:
        k += 1
    i, j = LEVELS + 2 * (k - 1), LEVELS + 2 * k
    share = (depth - world[i]) / (world[j] - world[i])
    share = min(max(share, 0.0), 1.0)
    ratio: float = world[i + 1] + share * (world[j + 1] - world[i + 1])
    return ratio
