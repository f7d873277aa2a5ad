"""Bounds of batches in the world frame W, and the selection of the batches in view.

The loops are compiled: for the few dozen batches of a scene, calls of numpy functions would take
longer than drawing. Functions write their results into the last argument, unless stated otherwise.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.jit import njit

Indices = npt.NDArray[np.intp]


@njit
def compute_stretch_bounds(matrices: Array, factors: Array) -> None:
    """Compute an upper bound of the factor by which each matrix stretches a vector.

    The largest row sum of A'A bounds the square of the largest stretch; exact without shear.

    Args:
        matrices: the matrices A, (n, 3, 3).
        factors: the output, (n,) [1].
    """
    for n in range(len(matrices)):
        max_row_sum = 0.0
        for i in range(3):
            row = 0.0
            for k in range(3):
                total = 0.0
                for j in range(3):
                    total += matrices[n, j, i] * matrices[n, j, k]
                row += abs(total)
            max_row_sum = max(max_row_sum, row)
        factors[n] = math.sqrt(max_row_sum)


@njit
def set_poses(
    poses: Array,
    rows: Indices,
    version: int,
    world_from_model: Array,
    moved_versions: npt.NDArray[np.int64],
) -> bool:
    """Set the poses of some instances; return True if a pose changed.

    Args:
        poses: the new poses, (k, 4, 4).
        rows: the rows of these instances, (k,).
        version: the version that is recorded for the instances whose pose changes.
        world_from_model: the poses of all instances, (n, 4, 4), which are written.
        moved_versions: the version at which each instance last moved, (n,), which is written.
    """
    has_moved = False
    for k in range(len(rows)):
        row, is_elsewhere = rows[k], False
        for i in range(4):
            for j in range(4):
                is_elsewhere = is_elsewhere or poses[k, i, j] != world_from_model[row, i, j]
        if is_elsewhere:
            world_from_model[row] = poses[k]
            moved_versions[row] = version
            has_moved = True
    return has_moved


@njit
def transform_to_camera(
    camera_from_world: Array,
    world_from_model: Array,
    world_normals: Array,
    camera_from_model: npt.NDArray[np.float32],
    camera_normals: npt.NDArray[np.float32],
) -> None:
    """Transform poses and normal matrices to a camera's frame, in OpenGL's column-major order.

    Args:
        camera_from_world: the matrix from W to the camera, (4, 4); it may include a projection.
        world_from_model: the pose of each instance, (n, 4, 4).
        world_normals: the matrix from model normals to world normals of each instance, (n, 3, 3).
        camera_from_model: the first output, (n, 4, 4).
        camera_normals: the second output, (n, 4, 4); its last row and column are not written.
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
def transform_spheres(
    world_from_model: Array, stretch: Array, owners: Indices, model_spheres: Array, spheres: Array
) -> None:
    """Transform bounding spheres to W.

    Args:
        world_from_model: the pose of each instance, (n, 4, 4).
        stretch: the factor by which each instance stretches its model at most, (n,) [1].
        owners: the row of the instance of each sphere, (m,).
        model_spheres: centre and radius in the frame of the model, (m, 4) [m].
        spheres: the output, centre and radius in W, (m, 4) [m].
    """
    for m in range(len(owners)):
        n = owners[m]
        _transform_point(model_spheres[m], world_from_model[n], spheres[m])
        spheres[m, 3] = model_spheres[m, 3] * stretch[n]


@njit
def transform_corners(
    world_from_model: Array, owners: Indices, model_corners: Array, corners: Array
) -> None:
    """Transform the corners of bounding boxes to W.

    Args:
        world_from_model: the pose of each instance, (n, 4, 4).
        owners: the row of the instance of each box, (m,).
        model_corners: the corners in the frame of the model, (m, 8, 3) [m].
        corners: the output, the corners in W, (m, 8, 3) [m].
    """
    for m in range(len(owners)):
        for c in range(8):
            _transform_point(model_corners[m, c], world_from_model[owners[m]], corners[m, c])


@njit
def _transform_point(point: Array, world_from_model: Array, world_point: Array) -> None:
    """Transform a point of a model to W, into the first three elements of ``world_point`` [m]."""
    for k in range(3):
        total = 0.0
        for j in range(3):
            total += point[j] * world_from_model[k, j]
        world_point[k] = total + world_from_model[k, 3]


@njit
def transform_normals(
    normals: Array, owners: Indices, model_normals: Array, world_normals: Array
) -> None:
    """Transform the unit normals of batches to W.

    Args:
        normals: the matrix from model normals to world normals of each instance, (n, 3, 3).
        owners: the row of the instance of each batch, (m,).
        model_normals: the normals in the frame of the model, (m, 3); 0 for batches that are not
            flat.
        world_normals: the output, unit normals in W, or 0, (m, 3).
    """
    for m in range(len(owners)):
        n, squares = owners[m], 0.0
        for k in range(3):
            total = 0.0
            for j in range(3):
                total += model_normals[m, j] * normals[n, k, j]
            world_normals[m, k] = total
            squares += total * total
        if squares > 0.0:
            size = math.sqrt(squares)
            for k in range(3):
                world_normals[m, k] /= size


@njit
def compute_half_extents(owners: Indices, spheres: Array, extents: Array) -> None:
    """Compute half the longest side of the box around the bounding spheres of each instance.

    Args:
        owners: the row of the instance of each sphere, (m,).
        spheres: centre and radius of the spheres in W, (m, 4) [m].
        extents: the output, (n,) [m].
    """
    low, high = np.full((len(extents), 3), np.inf), np.full((len(extents), 3), -np.inf)
    for m in range(len(owners)):
        n = owners[m]
        for k in range(3):
            low[n, k] = min(low[n, k], spheres[m, k] - spheres[m, 3])
            high[n, k] = max(high[n, k], spheres[m, k] + spheres[m, 3])
    for n in range(len(extents)):
        max_side = -np.inf
        for k in range(3):
            max_side = max(max_side, high[n, k] - low[n, k])
        extents[n] = max_side / 2.0


@njit
def find_far_distances(
    indices: Indices,
    spheres: Array,
    corners: Array,
    position: Array,
    rotation: Array,
    planes: Array,
    distances: Array,
) -> None:
    """Compute the distance from a camera to the far side of each batch in its frustum.

    Args:
        indices: the indices of the batches to check, (m,).
        spheres: the bounding spheres of all batches in W, (k, 4) [m].
        corners: the corners of the bounding boxes of all batches in W, (k, 8, 3) [m].
        position: the position of the camera in W, (3,) [m].
        rotation: the axes of the camera in W as columns, (3, 3).
        planes: the planes of the frustum in the camera's frame, (6, 4).
        distances: the output, (m,) [m]; inf for batches outside of the frustum.
    """
    centre, points = np.empty(3), np.empty((8, 3))
    for i in range(len(indices)):
        m = indices[i]
        distances[i] = np.inf
        transform_from_world(spheres[m], position, rotation, centre)
        if not _is_inside(centre, planes, spheres[m, 3]):
            continue
        for c in range(8):
            transform_from_world(corners[m, c], position, rotation, points[c])
        if _reaches_inside(points, planes):
            squared_distance = centre[0] * centre[0] + centre[1] * centre[1] + centre[2] * centre[2]
            distances[i] = math.sqrt(squared_distance) + spheres[m, 3]


@njit
def transform_from_world(
    point: Array, position: Array, rotation: Array, camera_point: Array
) -> None:
    """Transform a point, (3,) [m], from W to the frame of the camera (`find_far_distances`)."""
    x, y, z = point[0] - position[0], point[1] - position[1], point[2] - position[2]
    for k in range(3):
        camera_point[k] = 0.0 + x * rotation[0, k] + y * rotation[1, k] + z * rotation[2, k]


@njit
def transform_to_world(point: Array, position: Array, rotation: Array, world_point: Array) -> None:
    """Transform a point from the camera's frame to W: the inverse of `transform_from_world`."""
    for k in range(3):
        total = position[k]
        for j in range(3):
            total += rotation[k, j] * point[j]
        world_point[k] = total


@njit
def _plane_distance(point: Array, plane: Array) -> float:
    """Return the signed distance of a point from a plane, positive inside [m]."""
    x, y, z = point[0], point[1], point[2]
    height: float = 0.0 + x * plane[0] + y * plane[1] + z * plane[2] + plane[3]
    return height


@njit
def _is_inside(centre: Array, planes: Array, radius: float) -> bool:
    """Return True if a sphere reaches inside every plane."""
    is_inside = True
    for p in range(len(planes)):
        is_inside = is_inside and _plane_distance(centre, planes[p]) + radius > 0.0
    return is_inside


@njit
def _reaches_inside(points: Array, planes: Array) -> bool:
    """Return True if some point lies inside each plane."""
    for p in range(len(planes)):
        is_some = False
        for c in range(len(points)):
            is_some = is_some or _plane_distance(points[c], planes[p]) > 0.0
        if not is_some:
            return False
    return True
