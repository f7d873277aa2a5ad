"""The bodies that show a force, such as a tether: cylinders that the force places itself.

They are bodies of MuJoCo without weight and shape (``mocap``), so that images, rays, motion tracks
and saved states find them as they find all other bodies.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit

MIN_COSINE = -0.999999
"""The cosine of the angle from the z axis beyond which a cylinder is turned by half a turn."""


class SegmentBodies:
    """The cylinders of one force.

    Args:
        positions: the positions of the cylinders in the engine's state, (n, 3) [m].
        quaternions: their orientations in the engine's state, wxyz, (n, 4).
        length: the length of a cylinder [m].
        mark_stale: a function that marks the computed frames as out of date.
    """

    def __init__(
        self, positions: Array, quaternions: Array, length: float, mark_stale: Callable[[], None]
    ) -> None:
        self._positions, self._quaternions = positions, quaternions
        self._length, self._mark_stale = length, mark_stale

    def place(self, nodes: Array, broken_segment: int) -> None:
        """Place the cylinders between successive nodes; see `uwsim.world.Segments`."""
        place_segments(nodes, broken_segment, self._length, self._positions, self._quaternions)
        self._mark_stale()


@njit
def place_segments(
    nodes: Array, broken_segment: int, length: float, positions: Array, quaternions: Array
) -> None:
    """Compute the poses of the cylinders between nodes.

    The last segment may be shorter or longer than a cylinder: its cylinder ends at the last node,
    and a spare one begins at the node before it.

    Args:
        nodes: the nodes in W, (m + 1, 3) [m].
        broken_segment: the index of a segment that is not shown; -1: none.
        length: the length of a cylinder [m].
        positions: receives the centres of the cylinders, (n, 3) [m].
        quaternions: receives their orientations, wxyz, (n, 4).
    """
    last_segment = len(nodes) - 2
    for i in range(len(positions)):
        segment = min(i, last_segment)
        if segment == broken_segment:
            segment = broken_segment - 1 if broken_segment > 0 else min(1, last_segment)
        way = np.empty(3)
        square = 0.0
        for k in range(3):
            way[k] = nodes[segment + 1, k] - nodes[segment, k]
            square += way[k] * way[k]
        distance = math.sqrt(square)
        if distance == 0.0:
            way[0], way[1], way[2], distance = 0.0, 0.0, 1.0, 1.0
        for k in range(3):
            way[k] /= distance
            middle = 0.5 * (nodes[segment, k] + nodes[segment + 1, k])
            if segment == last_segment and i <= last_segment:
                middle = nodes[segment + 1, k] - 0.5 * length * way[k]
            elif segment == last_segment:
                middle = nodes[segment, k] + 0.5 * min(length, distance) * way[k]
            positions[i, k] = middle
        if way[2] < MIN_COSINE:
            quaternions[i, 0], quaternions[i, 1] = 0.0, 1.0
            quaternions[i, 2] = quaternions[i, 3] = 0.0
            continue
        scale = 1.0 / math.sqrt(2.0 * (1.0 + way[2]))
        quaternions[i, 0] = (1.0 + way[2]) * scale
        quaternions[i, 1], quaternions[i, 2] = -way[1] * scale, way[0] * scale
        quaternions[i, 3] = 0.0
