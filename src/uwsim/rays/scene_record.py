"""Scenes for ray casting as compiled code reads them by their addresses.

A sensor holds a record of `RAYS`. It says where to find the function that casts rays, so that
no sensor has that function compiled into its own.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.calls import address_of, call, function_address
from ..base.numerics.jit import njit
from ..base.numerics.memory import carray, pointer
from .bodies import Bodies, Engine
from .kernel import Hits, cast_rays
from .triangle import Trees

RAYS = np.dtype([("cast", np.int64), ("scenes", np.int64), ("n_scenes", np.int64)])
"""The addresses of the function that casts rays and of some records of `SCENE`."""

_ARRAYS = {
    "tree_boxes": ("n_nodes", 12),
    "tree_links": ("n_nodes", 4),
    "triangles": ("n_triangles", 9),
    "surfaces": ("n_triangles", 2),
    "roots": ("n_bodies", 1),
    "tree_balls": ("n_bodies", 4),
    "balls": ("n_bodies", 4),
    "engine": ("n_bodies", 1),
    "world_from_body": ("n_bodies", 16),
    "body_from_world": ("n_bodies", 16),
    "centres": ("n_bodies", 4),
    "boxes": ("n_forks", 12),
    "links": ("n_forks", 4),
    "order": ("n_bodies", 1),
    "parents": ("n_forks", 1),
    "leaves": ("n_bodies", 1),
    "origins": ("n_engine", 3),
    "axes": ("n_engine", 9),
}
"""What counts the rows of each array, and how many numbers a row has."""
_COUNTS = tuple(dict.fromkeys(count for count, _ in _ARRAYS.values()))
SCENE = np.dtype([(name, np.int64) for name in (*_ARRAYS, *_COUNTS)])
"""The addresses of the arrays of `Trees`, `Bodies` and `Engine`, and their lengths."""

REQUEST = np.dtype(
    [
        ("origin", np.float64, 3),  # of the rays, in W [m]
        ("reach", np.float64),  # how far they go [m]
        ("n", np.int64),  # how many they are
        ("directions", np.int64),  # addresses of arrays; see `kernel.cast_rays`
        ("begins", np.int64),
        ("distance", np.int64),
        ("normal", np.int64),
        ("surface", np.int64),
        ("n_scenes", np.int64),
    ]
)
"""Rays to cast, and where their hits are written."""

Record = Any


def scene_record(trees: Trees, bodies: Bodies, place: Engine) -> npt.NDArray[np.void]:
    """Return the record of `SCENE` of a scene, (1,); its arrays have to live on."""
    arrays: tuple[npt.NDArray[Any], ...] = (*trees, *bodies, *place)
    record = np.zeros(1, SCENE)
    for (name, (count, width)), array in zip(_ARRAYS.items(), arrays, strict=True):
        if not array.flags.c_contiguous:
            raise ValueError(f"{name} is not contiguous")
        record[name], record[count] = address_of(array), array.size // width
    return record


def rays_record(scenes: npt.NDArray[np.void]) -> npt.NDArray[np.void]:
    """Return the record of `RAYS` of some records of `SCENE`, (1,), which have to live on."""
    record = np.zeros(1, RAYS)
    record["cast"] = function_address(cast_request)
    record["scenes"], record["n_scenes"] = address_of(scenes), len(scenes)
    return record


@njit
def cast_from(
    rays: Record, origin: Array, directions: Array, begins: Array, reach: float, hits: Hits
) -> None:
    """Find the first hits of rays in any of some scenes.

    Args:
        rays: a record of `RAYS`.
        origin: where the rays begin, in W, (3,) [m].
        directions: of the rays in W, unit vectors, (n, 3).
        begins: from where on each ray hits, (n,) [m].
        reach: how far they go [m].
        hits: for the results.
    """
    requests = np.zeros(1, REQUEST)
    request = requests[0]
    for k in range(3):
        request.origin[k] = origin[k]
    request.reach, request.n = reach, len(directions)
    request.directions, request.begins = directions.ctypes.data, begins.ctypes.data
    request.distance, request.normal = hits.distance.ctypes.data, hits.normal.ctypes.data
    request.surface, request.n_scenes = hits.surface.ctypes.data, rays.n_scenes
    call(rays.cast, rays.scenes, requests.ctypes.data, 0.0)


@njit
def cast_all(
    rays: Record, origin: Array, directions: Array, begins: Array, reach: float, hits: Hits
) -> None:
    """Call `cast_from`, from Python, with the first of some records of `RAYS`."""
    cast_from(rays[0], origin, directions, begins, reach, hits)


def cast_request(parameters: int, values: int, time: float) -> None:
    """Cast the rays of a `REQUEST` in scenes; see `uwsim.base.numerics.calls`."""
    request = carray(pointer(values), (1,), REQUEST)[0]
    n = request.n
    directions = carray(pointer(request.directions), (n, 3), np.float64)
    begins = carray(pointer(request.begins), (n,), np.float64)
    hits = Hits(
        carray(pointer(request.distance), (n,), np.float64),
        carray(pointer(request.normal), (n, 3), np.float64),
        carray(pointer(request.surface), (n,), np.int32),
    )
    origin, reach = request.origin, request.reach
    scenes = carray(pointer(parameters), (request.n_scenes,), SCENE)
    cast_in(scenes[0], origin, directions, begins, reach, hits)
    if request.n_scenes == 1:
        return
    others = Hits(np.empty(n), np.empty((n, 3)), np.empty(n, np.int32))
    for number in range(1, request.n_scenes):
        cast_in(scenes[number], origin, directions, begins, reach, others)
        for i in range(n):
            if others.distance[i] < hits.distance[i]:
                hits.distance[i], hits.surface[i] = others.distance[i], others.surface[i]
                hits.normal[i] = others.normal[i]


@njit
def cast_in(
    scene: Record, origin: Array, directions: Array, begins: Array, reach: float, hits: Hits
) -> None:
    """Cast rays in one scene; see `kernel.cast_rays`."""
    b, k, forks = scene.n_bodies, scene.n_nodes, scene.n_forks
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
        carray(pointer(scene.engine), (b,), np.int32),
        carray(pointer(scene.world_from_body), (b, 4, 4), np.float64),
        carray(pointer(scene.body_from_world), (b, 4, 4), np.float64),
        carray(pointer(scene.centres), (b, 4), np.float64),
        carray(pointer(scene.boxes), (forks, 12), np.float64),
        carray(pointer(scene.links), (forks, 4), np.int32),
        carray(pointer(scene.order), (b,), np.int32),
        carray(pointer(scene.parents), (forks,), np.int32),
        carray(pointer(scene.leaves), (b,), np.int32),
    )
    place = Engine(
        carray(pointer(scene.origins), (scene.n_engine, 3), np.float64),
        carray(pointer(scene.axes), (scene.n_engine, 3, 3), np.float64),
    )
    cast_rays(trees, bodies, place, origin, directions, (begins, reach), hits)
