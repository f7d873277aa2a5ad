"""Models of docks that get the dimensions of a scene, by the formula of `uwsim.scene.object`."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..base.geometry import Array
from ..base.numerics.linear import inverse, rotate_rows, transform_points
from .mesh import Mesh, Model

MIN_SIDE = 1e-6
"""The distance from the throat below which a vertex is at the throat, in model units [1]."""


@dataclass(frozen=True, kw_only=True)
class DockShape:
    """The inner dimensions of a dock along x, y and z [m]."""

    funnel_length: float
    """The length of the funnel."""
    length: float
    """The length of the chamber behind it."""
    entrance: tuple[float, float]
    """The width and height of the funnel's entrance."""
    throat: tuple[float, float]
    """The width and height of the chamber."""


def shape_dock(model: Model, object_from_mesh: Array, shape: DockShape) -> Model:
    """Return a model with the dimensions of a dock.

    Args:
        model: a model with the funnel from x = -1 to 0, the chamber from 0 to 1, and the inner
            sides at y and z of -1 and 1.
        object_from_mesh: the pose and the scale of the model, (4, 4) [m].
        shape: the dimensions.
    """
    matrix, position = object_from_mesh[:3, :3], object_from_mesh[:3, 3]
    cofactors = inverse(matrix).T
    meshes = []
    for mesh in model.meshes:
        vertices = transform_points(mesh.vertices.astype(np.float64), matrix, position)
        normals = rotate_rows(cofactors, mesh.normals.astype(np.float64))
        meshes.append(_shape_mesh(mesh, vertices, normals, shape))
    return replace(model, meshes=tuple(meshes))


def keep_inner_sides(model: Model) -> Model:
    """Return the faces of a dock, in the axes of its object, that a vehicle on its way in meets.

    These are the faces towards the axis, the rim of the entrance and the front of the back plate.
    """
    return replace(model, meshes=tuple(map(_keep_inner_sides, model.meshes)))


def _keep_inner_sides(mesh: Mesh) -> Mesh:
    corners = mesh.vertices[mesh.triangles].astype(np.float64)  # (m, 3, 3)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sizes = np.sqrt(np.sum(normals * normals, axis=1))
    radial_parts = np.sum(normals[:, 1:] * corners.mean(axis=1)[:, 1:], axis=1)
    is_inner = (radial_parts < MIN_SIDE * sizes) & (normals[:, 0] < 0.5 * sizes)
    return replace(mesh, triangles=mesh.triangles[is_inner])


def _shape_mesh(mesh: Mesh, vertices: Array, normals: Array, shape: DockShape) -> Mesh:
    is_funnel = _find_funnel(mesh, vertices)
    x_scale = np.where(is_funnel, shape.funnel_length, shape.length)
    entrance, throat = 0.5 * np.array(shape.entrance), 0.5 * np.array(shape.throat)
    part = np.where(is_funnel, -vertices[:, 0], 0.0)[:, None]  # (n, 1), 1 at the entrance
    scales = throat + (entrance - throat) * part  # (n, 2) of y and z [m]
    slopes = np.where(is_funnel[:, None], throat - entrance, 0.0)  # (n, 2), along x [m]
    points = np.column_stack([x_scale * vertices[:, 0], scales * vertices[:, 1:]])
    transverse_parts = normals[:, 1:] / scales  # (n, 2)
    axial_parts = (
        normals[:, 0] - np.sum(slopes * vertices[:, 1:] * transverse_parts, axis=1)
    ) / x_scale
    turned_normals = np.column_stack([axial_parts, transverse_parts])
    turned_normals /= np.sqrt(np.sum(turned_normals * turned_normals, axis=1))[:, None]
    return replace(
        mesh,
        vertices=points.astype(np.float32),
        normals=turned_normals.astype(np.float32),
        tangents=None,
    )


def _find_funnel(mesh: Mesh, vertices: Array) -> Array:
    """Return which vertices belong to triangles of the funnel, (n,)."""
    is_before = (vertices[mesh.triangles][:, :, 0] < -MIN_SIDE).any(axis=1)
    is_funnel = np.zeros(len(vertices), dtype=bool)
    is_funnel[mesh.triangles[is_before].ravel()] = True
    return is_funnel
