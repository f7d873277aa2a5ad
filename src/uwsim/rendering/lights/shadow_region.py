"""The region of an image in which shadows of the sun may fall on the backdrop (`backdrop`).

The image is divided into tiles. For each tile, the bounds of its surfaces are computed in *sunbeam
coordinates* (`sunbeam_frame`): two coordinates that are constant along a sunbeam, and the distance
towards the sun. A caster may shade a tile if the bounds overlap and it is nearer to the sun.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Intrinsics, Pose
from ...base.numerics.jit import njit
from ..bounds import transform_to_world
from ..instance import Indices, Instances
from .sun_shadow import compute_box, sunbeam_frame

TILE = 8
"""The edge of a tile of an image [px]."""

Region = tuple[int, int, int, int]
"""A rectangle of an image: left column, top row, number of columns, number of rows [px]."""


def compute_tile_bounds(
    depths: npt.NDArray[np.float32], world_from_camera: Pose, intrinsics: Intrinsics, sun: Array
) -> Array:
    """Compute the bounds of the surfaces in each tile of an image, in sunbeam coordinates.

    Args:
        depths: the depth buffer of the image, 0..1, (h, w); 1: no surface.
        world_from_camera: the pose of the camera.
        intrinsics: the pinhole of the camera.
        sun: the unit vector towards the sun in W, (3,).

    Returns:
        The minimum and maximum sunbeam coordinates in each tile, (rows, columns, 2, 3) [m]; inf
        and -inf if the tile has no surface.
    """
    i = intrinsics
    rows, columns = -(-i.height // TILE), -(-i.width // TILE)
    tiles = np.empty((rows, columns, 2, 3))
    pinhole = np.array([i.fx, i.fy, i.cx, i.cy, i.skew, i.near, i.far])
    rotation = np.ascontiguousarray(world_from_camera.rotation)
    _write_tile_bounds(
        depths, pinhole, world_from_camera.position, rotation, sunbeam_frame(sun), tiles
    )
    return tiles


def find_shaded_region(
    tiles: Array, instances: Instances, casters: Indices, sun: Array, margin: float
) -> Region:
    """Return the rectangle around all tiles on which a caster may cast a shadow.

    Args:
        tiles: the bounds of the surfaces in each tile (`compute_tile_bounds`).
        instances: all instances.
        casters: the indices of the batches that cast shadows, (k,).
        sun: the unit vector towards the sun in W, (3,).
        margin: the distance by which shadows may reach beyond a caster's bounds [m].
    """
    region = np.array([tiles.shape[1], tiles.shape[0], 0, 0])  # least column, row; greatest + 1
    _write_shaded_tiles(tiles, instances.corners, casters, sunbeam_frame(sun), margin, region)
    left, top, right, bottom = (TILE * region).tolist()
    return (left, top, right - left, bottom - top) if right > left else (0, 0, 0, 0)


@njit
def _write_tile_bounds(
    depths: npt.NDArray[np.float32],
    pinhole: Array,
    position: Array,
    rotation: Array,
    frame: Array,
    tiles: Array,
) -> None:
    """Compute `compute_tile_bounds` into ``tiles``.

    Args:
        depths: the depth buffer of the image, 0..1, (h, w).
        pinhole: fx, fy, cx, cy, skew [px], near, far [m], (7,).
        position: the position of the camera in W, (3,) [m].
        rotation: the axes of the camera in W as columns, (3, 3).
        frame: the matrix from W to sunbeam coordinates, (3, 3).
        tiles: the output, (rows, columns, 2, 3) [m].
    """
    tiles[:, :, 0], tiles[:, :, 1] = np.inf, -np.inf
    near, far = pinhole[5], pinhole[6]
    point, world = np.empty(3), np.empty(3)
    for v in range(depths.shape[0]):
        y = (pinhole[3] - v) / pinhole[1]
        for u in range(depths.shape[1]):
            if depths[v, u] >= 1.0:
                continue
            clip = 2.0 * float(depths[v, u]) - 1.0
            depth = 2.0 * far * near / (far + near - clip * (far - near))
            # the depth buffer has a resolution of 2^-24, which is this error of the depth [m]
            error = depth * depth / near * 2.0**-23
            point[0] = depth * (u - pinhole[2] - pinhole[4] * y) / pinhole[0]
            point[1], point[2] = depth * y, -depth
            transform_to_world(point, position, rotation, world)
            box = tiles[v // TILE, u // TILE]
            for k in range(3):
                total = 0.0
                for j in range(3):
                    total += frame[k, j] * world[j]
                box[0, k], box[1, k] = min(box[0, k], total - error), max(box[1, k], total + error)


@njit
def _write_shaded_tiles(
    tiles: Array,
    corners: Array,
    casters: Indices,
    frame: Array,
    margin: float,
    region: npt.NDArray[np.int64],
) -> None:
    """Compute the region of `find_shaded_region`, in tiles.

    Args:
        tiles: the bounds of the surfaces in each tile, (rows, columns, 2, 3) [m].
        corners: the corners of the bounding boxes of all batches in W, (m, 8, 3) [m].
        casters: the indices of the batches that cast shadows, (k,).
        frame: the matrix from W to sunbeam coordinates, (3, 3).
        margin: the distance by which shadows may reach beyond a caster's bounds [m].
        region: the output, (4,): the first column and row, the column and row after the last.
    """
    boxes = np.empty((len(casters), 2, 3))
    for k in range(len(casters)):
        compute_box(corners[casters[k]], frame, boxes[k])
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
                region[0], region[1] = min(region[0], column), min(region[1], row)
                region[2], region[3] = max(region[2], column + 1), max(region[3], row + 1)
