"""Where the bounds of batches are in W, and which of them reach into an image.

Loops over a scene's few dozen batches, for every image: as calls of numpy they would take longer
than to draw what is found.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.jit import njit

Numbers = npt.NDArray[np.intp]


@njit
def stretches(matrices: Array, found: Array) -> None:
    """Bound how much each of (n, 3, 3) stretches a vector, into (n,) [1].

    The largest row sum of A'A bounds the square of the largest stretch; exact without shear.
    """
    for n in range(len(matrices)):
        largest = 0.0
        for i in range(3):
            row = 0.0
            for k in range(3):
                total = 0.0
                for j in range(3):
                    total += matrices[n, j, i] * matrices[n, j, k]
                row += abs(total)
            largest = max(largest, row)
        found[n] = math.sqrt(largest)


@njit
def put(
    places: Array,
    rows: Numbers,
    version: int,
    world_from_model: Array,
    moved: npt.NDArray[np.int64],
) -> bool:
    """Set the poses of some instances; returns whether one was elsewhere before.

    Args:
        places: the poses, (k, 4, 4).
        rows: of the instances, (k,).
        version: noted for those that were elsewhere.
        world_from_model: of all instances, (n, 4, 4), which is written.
        moved: the version at which each last moved, (n,), which is written.
    """
    has_moved = False
    for k in range(len(rows)):
        row, is_elsewhere = rows[k], False
        for i in range(4):
            for j in range(4):
                is_elsewhere = is_elsewhere or places[k, i, j] != world_from_model[row, i, j]
        if is_elsewhere:
            world_from_model[row] = places[k]
            moved[row] = version
            has_moved = True
    return has_moved


@njit
def see(
    camera_from_world: Array,
    world_from_model: Array,
    world_normals: Array,
    camera_from_model: npt.NDArray[np.float32],
    camera_normals: npt.NDArray[np.float32],
) -> None:
    """Write the poses and normals of models in a camera's frame, as OpenGL counts: columns first.

    Args:
        camera_from_world: (4, 4); it may project, too.
        world_from_model: of each instance, (n, 4, 4).
        world_normals: world normals from model normals, (n, 3, 3).
        camera_from_model: which is written, (n, 4, 4).
        camera_normals: which is written, (n, 4, 4), but for its last row and column.
    """
    for n in range(len(world_from_model)):
        for i in range(4):
            for k in range(4):
                total = 0.0
                for j in range(4):
                    total += camera_from_world[i, j] * world_from_model[n, j, k]
                camera_from_model[n, k, i] = total
        for i in range(3):
            for k in range(3):
                total = 0.0
                for j in range(3):
                    total += camera_from_world[i, j] * world_normals[n, j, k]
                camera_normals[n, k, i] = total


@njit
def carry(
    world_from_model: Array, stretch: Array, owners: Numbers, own: Array, spheres: Array
) -> None:
    """Where bounding spheres are in W: centre and radius, into (m, 4) [m].

    Args:
        world_from_model: of each instance, (n, 4, 4).
        stretch: of each instance, (n,) [1].
        owners: the instance of each sphere, (m,).
        own: centre and radius in the frame of the model, (m, 4) [m].
        spheres: into which they are written.
    """
    for m in range(len(owners)):
        n = owners[m]
        _carried(own[m], world_from_model[n], spheres[m])
        spheres[m, 3] = own[m, 3] * stretch[n]


@njit
def carry_corners(world_from_model: Array, owners: Numbers, own: Array, corners: Array) -> None:
    """Where corners of bounding boxes are in W, into (m, 8, 3) [m].

    Args:
        world_from_model: of each instance, (n, 4, 4).
        owners: the instance of each box, (m,).
        own: in the frame of the model, (m, 8, 3) [m].
        corners: into which they are written.
    """
    for m in range(len(owners)):
        for c in range(8):
            _carried(own[m, c], world_from_model[owners[m]], corners[m, c])


@njit
def _carried(point: Array, world_from_model: Array, found: Array) -> None:
    """A point of a model in W, into the first three of ``found`` [m]."""
    for k in range(3):
        total = 0.0
        for j in range(3):
            total += point[j] * world_from_model[k, j]
        found[k] = total + world_from_model[k, 3]


@njit
def carry_normals(normals: Array, owners: Numbers, own: Array, found: Array) -> None:
    """Unit normals in W of flat batches, 0 of bent ones, into (m, 3).

    Args:
        normals: world normals from model normals, of each instance, (n, 3, 3).
        owners: the instance of each batch, (m,).
        own: in the frame of the model, (m, 3).
        found: into which they are written.
    """
    for m in range(len(owners)):
        n, squares = owners[m], 0.0
        for k in range(3):
            total = 0.0
            for j in range(3):
                total += own[m, j] * normals[n, k, j]
            found[m, k] = total
            squares += total * total
        if squares > 0.0:
            size = math.sqrt(squares)
            for k in range(3):
                found[m, k] /= size


@njit
def half_extents(owners: Numbers, spheres: Array, found: Array) -> None:
    """Half the longest side of the box round the spheres of each instance, into (n,) [m]."""
    low, high = np.full((len(found), 3), np.inf), np.full((len(found), 3), -np.inf)
    for m in range(len(owners)):
        n = owners[m]
        for k in range(3):
            low[n, k] = min(low[n, k], spheres[m, k] - spheres[m, 3])
            high[n, k] = max(high[n, k], spheres[m, k] + spheres[m, 3])
    for n in range(len(found)):
        longest = -np.inf
        for k in range(3):
            longest = max(longest, high[n, k] - low[n, k])
        found[n] = longest / 2.0


@njit
def look(
    numbers: Numbers,
    spheres: Array,
    corners: Array,
    position: Array,
    rotation: Array,
    planes: Array,
    nearness: Array,
) -> None:
    """How far away the far side is of what reaches into a frustum, else inf, into (m,) [m].

    Args:
        numbers: which batches, (m,).
        spheres: of all batches in W, (k, 4) [m].
        corners: of their boxes in W, (k, 8, 3) [m].
        position: of the camera in W, (3,) [m].
        rotation: its axes in W as columns, (3, 3).
        planes: of the frustum, camera frame, (6, 4).
        nearness: into which it is written.
    """
    centre, points = np.empty(3), np.empty((8, 3))
    for i in range(len(numbers)):
        m = numbers[i]
        nearness[i] = np.inf
        seen_from(spheres[m], position, rotation, centre)
        if not _is_inside(centre, planes, spheres[m, 3]):
            continue
        for c in range(8):
            seen_from(corners[m, c], position, rotation, points[c])
        if _is_cut(points, planes):
            away = centre[0] * centre[0] + centre[1] * centre[1] + centre[2] * centre[2]
            nearness[i] = math.sqrt(away) + spheres[m, 3]


@njit
def seen_from(point: Array, position: Array, rotation: Array, found: Array) -> None:
    """A point of W in the frame of the camera."""
    x, y, z = point[0] - position[0], point[1] - position[1], point[2] - position[2]
    for k in range(3):
        found[k] = 0.0 + x * rotation[0, k] + y * rotation[1, k] + z * rotation[2, k]


@njit
def seen_to(point: Array, position: Array, rotation: Array, found: Array) -> None:
    """A point of the frame of the camera in W: the inverse of `seen_from`."""
    for k in range(3):
        total = position[k]
        for j in range(3):
            total += rotation[k, j] * point[j]
        found[k] = total


@njit
def _height(point: Array, plane: Array) -> float:
    """How far inside a plane a point is [m]."""
    x, y, z = point[0], point[1], point[2]
    height: float = 0.0 + x * plane[0] + y * plane[1] + z * plane[2] + plane[3]
    return height


@njit
def _is_inside(centre: Array, planes: Array, radius: float) -> bool:
    """Whether a sphere reaches inside every plane."""
    is_inside = True
    for p in range(len(planes)):
        is_inside = is_inside and _height(centre, planes[p]) + radius > 0.0
    return is_inside


@njit
def _is_cut(points: Array, planes: Array) -> bool:
    """Whether some point lies inside each plane."""
    for p in range(len(planes)):
        is_some = False
        for c in range(len(points)):
            is_some = is_some or _height(points[c], planes[p]) > 0.0
        if not is_some:
            return False
    return True
