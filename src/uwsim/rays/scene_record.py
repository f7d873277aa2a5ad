"""Records with the addresses of scenes for ray casting, for compiled code.

The compiled code of a sensor reads a record of `RAYS` with the address of the function that casts
rays. That function is therefore compiled once, not into each sensor.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.calls import address_of, call, function_address
from ..base.numerics.jit import njit
from ..base.numerics.memory import carray, pointer
from .bodies import Bodies, EngineFrames
from .height_rays import GRID, cast_on_grid
from .kernel import Hits, cast_rays
from .triangle import Trees

RAYS = np.dtype(
    [
        ("cast", np.int64),  # the address of the function that casts rays
        ("scenes", np.int64),  # the address of records of `SCENE`, and their number
        ("n_scenes", np.int64),
        ("grids", np.int64),  # the address of records of `height_rays.GRID`, and their number
        ("n_grids", np.int64),
    ]
)
"""The function that casts rays, and the scenes and height grids that they can hit."""

_ARRAYS = {
    "tree_boxes": ("n_tree_nodes", 12),
    "tree_links": ("n_tree_nodes", 4),
    "triangles": ("n_triangles", 9),
    "surfaces": ("n_triangles", 2),
    "roots": ("n_bodies", 1),
    "tree_balls": ("n_bodies", 4),
    "balls": ("n_bodies", 4),
    "engine_body": ("n_bodies", 1),
    "world_from_body": ("n_bodies", 16),
    "body_from_world": ("n_bodies", 16),
    "centres": ("n_bodies", 4),
    "boxes": ("n_body_nodes", 12),
    "links": ("n_body_nodes", 4),
    "order": ("n_bodies", 1),
    "parents": ("n_body_nodes", 1),
    "leaves": ("n_bodies", 1),
    "origins": ("n_engine_bodies", 3),
    "axes": ("n_engine_bodies", 9),
}
"""The name of the field with the number of rows of each array, and the length of a row."""
_COUNTS = tuple(dict.fromkeys(count for count, _ in _ARRAYS.values()))
SCENE = np.dtype([(name, np.int64) for name in (*_ARRAYS, *_COUNTS)])
"""The addresses and numbers of rows of the arrays of `Trees`, `Bodies` and `EngineFrames`."""

REQUEST = np.dtype(
    [
        ("origin", np.float64, 3),  # the origin of the rays in W [m]
        ("reach", np.float64),  # the length of the rays [m]
        ("n", np.int64),  # the number of rays
        ("directions", np.int64),  # the address of the directions; see `kernel.cast_rays`
        ("starts", np.int64),  # the address of the distances at which rays begin
        ("distance", np.int64),  # the addresses of the arrays of `Hits`
        ("normal", np.int64),
        ("surface", np.int64),
        ("n_scenes", np.int64),
        ("grids", np.int64),  # the address of the height grids, and their number
        ("n_grids", np.int64),
    ]
)
"""The rays to cast, and the addresses of the arrays that receive their hits."""

Record = Any


def scene_record(trees: Trees, bodies: Bodies, engine_frames: EngineFrames) -> npt.NDArray[np.void]:
    """Return the record of `SCENE` of a scene, (1,); the arrays must outlive it."""
    arrays: tuple[npt.NDArray[Any], ...] = (*trees, *bodies, *engine_frames)
    record = np.zeros(1, SCENE)
    for (name, (count, width)), array in zip(_ARRAYS.items(), arrays, strict=True):
        if not array.flags.c_contiguous:
            raise ValueError(f"{name} is not contiguous")
        record[name], record[count] = address_of(array), array.size // width
    return record


def rays_record(
    scenes: npt.NDArray[np.void], grids: npt.NDArray[np.void] | None = None
) -> npt.NDArray[np.void]:
    """Return a record of `RAYS`, (1,).

    Args:
        scenes: the records of `SCENE`, (n,), which must outlive it.
        grids: the records of `height_rays.GRID`, (m,), which must outlive it; None: no grids.
    """
    record = np.zeros(1, RAYS)
    record["cast"] = function_address(cast_request)
    record["scenes"], record["n_scenes"] = address_of(scenes), len(scenes)
    if grids is not None and len(grids):
        record["grids"], record["n_grids"] = address_of(grids), len(grids)
    return record


@njit
def cast_from(
    rays: Record, origin: Array, directions: Array, starts: Array, reach: float, hits: Hits
) -> None:
    """Find the first hits of rays in one or several scenes.

    Args:
        rays: a record of `RAYS`.
        origin: the origin of the rays in W, (3,) [m].
        directions: unit vectors in W, (n, 3).
        starts: the distance at which each ray begins, (n,) [m].
        reach: the length of the rays [m].
        hits: receives the first hits.
    """
    requests = np.zeros(1, REQUEST)
    request = requests[0]
    for k in range(3):
        request.origin[k] = origin[k]
    request.reach, request.n = reach, len(directions)
    request.directions, request.starts = directions.ctypes.data, starts.ctypes.data
    request.distance, request.normal = hits.distance.ctypes.data, hits.normal.ctypes.data
    request.surface, request.n_scenes = hits.surface.ctypes.data, rays.n_scenes
    request.grids, request.n_grids = rays.grids, rays.n_grids
    call(rays.cast, rays.scenes, requests.ctypes.data, 0.0)


@njit
def cast_all(
    rays: Record, origin: Array, directions: Array, starts: Array, reach: float, hits: Hits
) -> None:
    """Call `cast_from` from Python with a record of `RAYS`, (1,)."""
    cast_from(rays[0], origin, directions, starts, reach, hits)


def cast_request(scenes_address: int, request_address: int, time: float) -> None:
    """Cast the rays of a `REQUEST` in records of `SCENE`; see `uwsim.base.numerics.calls`."""
    request = carray(pointer(request_address), (1,), REQUEST)[0]
    n = request.n
    directions = carray(pointer(request.directions), (n, 3), np.float64)
    starts = carray(pointer(request.starts), (n,), np.float64)
    hits = Hits(
        carray(pointer(request.distance), (n,), np.float64),
        carray(pointer(request.normal), (n, 3), np.float64),
        carray(pointer(request.surface), (n,), np.int32),
    )
    origin, reach = request.origin, request.reach
    scenes = carray(pointer(scenes_address), (request.n_scenes,), SCENE)
    cast_in(scenes[0], origin, directions, starts, reach, hits)
    if request.n_grids > 0:
        grids = carray(pointer(request.grids), (request.n_grids,), GRID)
        for index in range(request.n_grids):
            cast_on_grid(grids[index], origin, directions, starts, reach, hits)
    if request.n_scenes == 1:
        return
    scene_hits = Hits(np.empty(n), np.empty((n, 3)), np.empty(n, np.int32))
    for index in range(1, request.n_scenes):
        cast_in(scenes[index], origin, directions, starts, reach, scene_hits)
        for i in range(n):
            if scene_hits.distance[i] < hits.distance[i]:
                hits.distance[i], hits.surface[i] = scene_hits.distance[i], scene_hits.surface[i]
                hits.normal[i] = scene_hits.normal[i]


@njit
def cast_in(
    scene: Record, origin: Array, directions: Array, starts: Array, reach: float, hits: Hits
) -> None:
    """Cast rays in one scene; see `kernel.cast_rays`."""
    b, k, n_body_nodes = scene.n_bodies, scene.n_tree_nodes, scene.n_body_nodes
    trees = Trees(
        carray(pointer(scene.tree_boxes), (k, 12), np.float64),
        carray(pointer(scene.tree_links), (k, 4), np.int32),
        carray(pointer(scene.triangles), (scene.n_triangles, 9), np.float64),
        carray(pointer(scene.surfaces), (scene.n_triangles, 2), np.int32),
        carray(pointer(scene.roots), (b,), np.int32),
        carray(pointer(scene.tree_balls), (b, 4), np.float64),
    )
    bodies = Bodies(
        carray(pointer(scene.balls), (b, 4), np.float64),
        carray(pointer(scene.engine_body), (b,), np.int32),
        carray(pointer(scene.world_from_body), (b, 4, 4), np.float64),
        carray(pointer(scene.body_from_world), (b, 4, 4), np.float64),
        carray(pointer(scene.centres), (b, 4), np.float64),
        carray(pointer(scene.boxes), (n_body_nodes, 12), np.float64),
        carray(pointer(scene.links), (n_body_nodes, 4), np.int32),
        carray(pointer(scene.order), (b,), np.int32),
        carray(pointer(scene.parents), (n_body_nodes,), np.int32),
        carray(pointer(scene.leaves), (b,), np.int32),
    )
    engine_frames = EngineFrames(
        carray(pointer(scene.origins), (scene.n_engine_bodies, 3), np.float64),
        carray(pointer(scene.axes), (scene.n_engine_bodies, 3, 3), np.float64),
    )
    cast_rays(trees, bodies, engine_frames, origin, directions, (starts, reach), hits)
