"""Where in an image the sun's shadows may fall on what stands still in it."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Intrinsics, Pose
from ...base.numerics.jit import njit
from ..bounds import seen_to
from ..instance import Instances, Numbers
from .sun_shadow import along, bound

TILE = 8
"""Edge of a tile of an image [px]."""

Region = tuple[int, int, int, int]
"""A rectangle of an image: left column, top row, number of columns and of rows [px]."""


def tiles_of(
    depths: npt.NDArray[np.float32], world_from_camera: Pose, intrinsics: Intrinsics, sun: Array
) -> Array:
    """Bound the surfaces in the tiles of an image as the sun sees them.

    Args:
        depths: of the pixels as OpenGL stores them, 0..1, (h, w); 1: nothing is there.
        world_from_camera: Where the camera is.
        intrinsics: Its pinhole.
        sun: Unit vector towards the sun in W, (3,).

    Returns:
        Least and greatest coordinates (`along`) in each tile, (rows, columns, 2, 3) [m]; infinite,
        the least greater, where nothing is.
    """
    i = intrinsics
    rows, columns = -(-i.height // TILE), -(-i.width // TILE)
    tiles = np.empty((rows, columns, 2, 3))
    lens = np.array([i.fx, i.fy, i.cx, i.cy, i.skew, i.near, i.far])
    turn = np.ascontiguousarray(world_from_camera.rotation)
    _bound_tiles(depths, lens, world_from_camera.position, turn, along(sun), tiles)
    return tiles


def shaded_region(
    tiles: Array, instances: Instances, casters: Numbers, sun: Array, margin: float
) -> Region:
    """Return the rectangle round all tiles on which a caster may cast a shadow.

    Args:
        tiles: bounds of what is in them, as `tiles_of` returns them.
        instances: All there are.
        casters: Numbers of the batches that cast shadows, (k,).
        sun: Unit vector towards the sun in W, (3,).
        margin: By how much shadows may reach beyond boxes [m].
    """
    found = np.array([tiles.shape[1], tiles.shape[0], 0, 0])  # least column, row; greatest + 1
    _find_shaded(tiles, instances.corners, casters, along(sun), margin, found)
    left, top, right, bottom = (TILE * found).tolist()
    return (left, top, right - left, bottom - top) if right > left else (0, 0, 0, 0)


@njit
def _bound_tiles(
    depths: npt.NDArray[np.float32],
    lens: Array,
    place: Array,
    turn: Array,
    frame: Array,
    tiles: Array,
) -> None:
    """Do as `tiles_of`, into ``tiles``; ``lens``: fx, fy, cx, cy, skew [px], near, far [m]."""
    tiles[:, :, 0], tiles[:, :, 1] = np.inf, -np.inf
    near, far = lens[5], lens[6]
    point, world = np.empty(3), np.empty(3)
    for v in range(depths.shape[0]):
        y = (lens[3] - v) / lens[1]
        for u in range(depths.shape[1]):
            if depths[v, u] >= 1.0:
                continue
            clip = 2.0 * float(depths[v, u]) - 1.0
            depth = 2.0 * far * near / (far + near - clip * (far - near))
            # what is stored is rounded to a step of 2^-24 of the whole
            step = depth * depth / near * 2.0**-23
            point[0], point[1] = depth * (u - lens[2] - lens[4] * y) / lens[0], depth * y
            point[2] = -depth
            seen_to(point, place, turn, world)
            box = tiles[v // TILE, u // TILE]
            for k in range(3):
                total = 0.0
                for j in range(3):
                    total += frame[k, j] * world[j]
                box[0, k], box[1, k] = min(box[0, k], total - step), max(box[1, k], total + step)


@njit
def _find_shaded(
    tiles: Array,
    corners: Array,
    casters: Numbers,
    frame: Array,
    margin: float,
    found: npt.NDArray[np.int64],
) -> None:
    """Do as `shaded_region`, into ``found``: least column and row, greatest and one."""
    boxes = np.empty((len(casters), 2, 3))
    for k in range(len(casters)):
        bound(corners[casters[k]], frame, boxes[k])
    for row in range(tiles.shape[0]):
        for column in range(tiles.shape[1]):
            tile, is_shaded = tiles[row, column], False
            for k in range(len(boxes)):
                box = boxes[k]
                is_over = box[1, 2] >= tile[0, 2] - margin
                for j in range(2):
                    low, high = tile[0, j] - margin, tile[1, j] + margin
                    is_over = is_over and box[0, j] <= high and box[1, j] >= low
                is_shaded = is_shaded or is_over
            if is_shaded:
                found[0], found[1] = min(found[0], column), min(found[1], row)
                found[2], found[3] = max(found[2], column + 1), max(found[3], row + 1)
