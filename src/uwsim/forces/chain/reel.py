r"""The segments that a winch pays out at the last node of a chain.

All segments have the same unstretched length l, except the last one, which the winch changes. When
it is longer than `LONGEST_SHARE` l, a node is inserted into it at the distance l from its first
node; when it is shorter than `SHORTEST_SHARE` l, its first node is removed. Both keep the sum of
all lengths. A new node lies on the line of the segment, so that its strain does not change, and has
the velocity of the tether there. Not modelled: the force that accelerates the tether from the drum,
its stretch on the drum, the friction of the drum.
"""

from __future__ import annotations

from ...base.geometry import Array
from ...base.numerics.jit import njit

LONGEST_SHARE, SHORTEST_SHARE = 1.6, 0.5
"""The limits of the length of the last segment, in lengths of the others [1]."""


@njit
def change_length(
    positions: Array,
    velocities: Array,
    lengths: Array,
    n_segments: int,
    unit: float,
    change: float,
) -> int:
    """Change the length of the last segment; insert or remove a node if it passes a limit.

    Args:
        positions: the positions of the nodes; the rows after the last node are free, (n, 3) [m].
        velocities: the velocities of the nodes, (n, 3) [m/s].
        lengths: the unstretched lengths of the segments, (n - 1,) [m].
        n_segments: the number of segments.
        unit: the length of the other segments [m].
        change: the change of the length [m].

    Returns:
        The new number of segments.
    """
    segment = n_segments - 1
    lengths[segment] += change
    if lengths[segment] > LONGEST_SHARE * unit and n_segments < len(lengths):
        part = unit / lengths[segment]
        for k in range(3):
            for row in (positions, velocities):
                row[segment + 2, k] = row[segment + 1, k]
                row[segment + 1, k] = (1.0 - part) * row[segment, k] + part * row[segment + 2, k]
        lengths[segment + 1], lengths[segment] = lengths[segment] - unit, unit
        return n_segments + 1
    if lengths[segment] < SHORTEST_SHARE * unit and segment > 0:
        lengths[segment - 1] += lengths[segment]
        lengths[segment] = unit
        for k in range(3):
            positions[segment, k] = positions[segment + 1, k]
            velocities[segment, k] = velocities[segment + 1, k]
        return n_segments - 1
    return n_segments
