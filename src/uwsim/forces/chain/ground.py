"""The surfaces near the nodes of a chain, which rays find.

Each node has at most one plane. In each step, the planes of some nodes are found again; those of
all nodes within `PERIOD`. A node with a plane casts a ray against it, from above the plane. A
node without a plane, or whose ray hits nothing, casts rays in six directions and takes the nearest
surface. Rays pass through vehicles and tethers. Not modelled: contact of a segment between its
nodes, edges and corners that several surfaces form within `REACH`, contact with vehicles.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.jit import njit
from ...rays import Hits
from ...rays.scene_record import cast_from

PERIOD = 0.05
"""The time after which the plane of a node is found again [s]."""
REACH = 0.6
"""The distance within which a node finds a surface [m]."""
SKIP = 0.01
"""The distance behind a surface that a ray passes, from which on it is cast again [m]."""
MAX_PASSES = 8
"""The largest number of surfaces that a ray passes."""

_DIRECTIONS = np.array(
    [
        [0.0, 0.0, -1.0],
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
    ]
)


@njit
def find_surfaces(
    rays: Any,
    are_solid: npt.NDArray[np.uint8],
    origin: Array,
    directions: Array,
    reach: float,
    hits: Hits,
) -> int:
    """Find the first solid surface along rays; return the index of the nearest, or -1 without one.

    Args:
        rays: a record of `uwsim.rays.scene_record.RAYS`.
        are_solid: 1 for a surface that stops a tether, by the index of the surface.
        origin: the origin of the rays in W, (3,) [m].
        directions: the unit vectors along the rays in W, (n, 3).
        reach: the length of the rays [m].
        hits: receives the first hits; the distance is infinite without one.
    """
    cast_from(rays, origin, directions, np.zeros(len(directions)), reach, hits)
    nearest_ray = -1
    next_hits, starts = Hits(np.empty(1), np.empty((1, 3)), np.empty(1, np.int32)), np.empty(1)
    for i in range(len(directions)):
        for _ in range(MAX_PASSES):
            if not hits.distance[i] <= reach or are_solid[hits.surface[i]] != 0:
                break
            starts[0] = hits.distance[i] + SKIP
            cast_from(rays, origin, directions[i : i + 1], starts, reach, next_hits)
            hits.distance[i], hits.surface[i] = next_hits.distance[0], next_hits.surface[0]
            hits.normal[i] = next_hits.normal[0]
        if not hits.distance[i] <= reach or are_solid[hits.surface[i]] == 0:
            hits.distance[i] = np.inf
        elif nearest_ray < 0 or hits.distance[i] < hits.distance[nearest_ray]:
            nearest_ray = i
    return nearest_ray


@njit
def update_planes(
    rays: Any,
    are_solid: npt.NDArray[np.uint8],
    positions: Array,
    first: int,
    stride: int,
    planes: Array,
) -> None:
    """Find the planes of some nodes.

    Args:
        rays: a record of `uwsim.rays.scene_record.RAYS`, (1,).
        are_solid: 1 for a surface that stops a tether, by the index of the surface.
        positions: the positions of the nodes in W, (n, 3) [m].
        first: the first node whose plane is found.
        stride: the number of nodes from one such node to the next.
        planes: the planes of `line.NodeSurroundings`, which are updated, (n, 5).
    """
    origin, direction = np.empty(3), np.empty((1, 3))
    hits = Hits(np.empty(6), np.empty((6, 3)), np.empty(6, np.int32))
    hit = Hits(np.empty(1), np.empty((1, 3)), np.empty(1, np.int32))
    for i in range(first, len(positions), stride):
        place = positions[i]
        if planes[i, 4] != 0.0:
            for k in range(3):
                origin[k] = place[k] + 0.5 * REACH * planes[i, k]
                direction[0, k] = -planes[i, k]
            if find_surfaces(rays[0], are_solid, origin, direction, 1.5 * REACH, hit) == 0:
                _set_plane(planes[i], hit.normal[0], origin, direction[0], hit.distance[0])
                continue
        nearest_ray = find_surfaces(rays[0], are_solid, place, _DIRECTIONS, REACH, hits)
        planes[i, 4] = 0.0
        if nearest_ray >= 0:
            distance = hits.distance[nearest_ray]
            _set_plane(
                planes[i], hits.normal[nearest_ray], place, _DIRECTIONS[nearest_ray], distance
            )


@njit
def _set_plane(
    plane: Array, normal: Array, origin: Array, direction: Array, distance: float
) -> None:
    offset = 0.0
    for k in range(3):
        plane[k] = normal[k]
        offset += normal[k] * (origin[k] + distance * direction[k])
    plane[3], plane[4] = offset, 1.0


@njit
def lift_nodes(
    rays: Any, are_solid: npt.NDArray[np.uint8], height: float, radius: float, positions: Array
) -> None:
    """Lift the inner nodes that are below a surface onto it.

    Args:
        rays: a record of `uwsim.rays.scene_record.RAYS`, (1,).
        are_solid: 1 for a surface that stops a tether, by the index of the surface.
        height: the height in W from which surfaces are searched downwards [m].
        radius: the distance of the nodes from the surface [m].
        positions: the positions of the nodes in W, (n, 3) [m].
    """
    origin = np.empty(3)
    hit = Hits(np.empty(1), np.empty((1, 3)), np.empty(1, np.int32))
    for i in range(1, len(positions) - 1):
        origin[0], origin[1], origin[2] = positions[i, 0], positions[i, 1], height
        reach = height - positions[i, 2] + radius
        if reach <= 0.0:
            continue
        if find_surfaces(rays[0], are_solid, origin, _DIRECTIONS[:1], reach, hit) == 0:
            positions[i, 2] = height - hit.distance[0] + radius
