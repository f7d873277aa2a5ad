"""Nets of straight twines: copies of a model of a twine, each stretched to its length."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..base.geometry import Array
from ..base.numerics.linear import dot, inverse, product, rotate_rows
from ..errors import AssetError
from .bending import place_piece
from .mesh import Mesh, Model

MAX_TRIANGLES = 2_000_000
"""The greatest number of triangles of a net."""


def weave_net(model: Model, object_from_mesh: Array, twines: Array) -> Model:
    """Return a copy of a model for each twine of a net in the x-z plane.

    The model is a piece along its y axis, which is turned to the twine and stretched along it.

    Args:
        model: the model of a piece of twine.
        object_from_mesh: the pose and the scale of the piece, (4, 4) [m].
        twines: the ends x, z, x, z of each twine, (n, 4) [m].

    Raises:
        AssetError: the piece has no extent along y, or the copies have too many triangles.
    """
    matrix = object_from_mesh[:3, :3]
    pieces, low, extent = place_piece(model, object_from_mesh)
    if len(twines) * sum(len(mesh.triangles) for mesh in model.meshes) > MAX_TRIANGLES:
        raise AssetError(
            f"{model.name}: {len(twines)} twines have more than {MAX_TRIANGLES} triangles."
        )
    meshes = []
    for mesh, vertices in zip(model.meshes, pieces, strict=True):
        shares = (vertices[:, 1] - low) / extent
        meshes.append(_copy_mesh(mesh, vertices, shares, matrix, twines))
    return replace(model, meshes=tuple(meshes))


def _copy_mesh(mesh: Mesh, vertices: Array, shares: Array, matrix: Array, twines: Array) -> Mesh:
    """Return a copy of a mesh for each twine, (n, 4) [m].

    Args:
        mesh: the mesh of the piece.
        vertices: its vertices in the frame of the object, (m, 3) [m].
        shares: the place of each vertex along the piece, 0..1, (m,).
        matrix: the rotation and scale of the piece, (3, 3).
        twines: the ends of each twine.
    """
    normals = rotate_rows(inverse(matrix).T, mesh.normals.astype(np.float64))
    normals /= np.sqrt(np.sum(normals * normals, axis=1))[:, None]
    all_vertices, all_normals = [], []
    for x0, z0, x1, z1 in twines.tolist():
        direction = np.array([x1 - x0, 0.0, z1 - z0])
        length = float(np.sqrt(dot(direction, direction)))
        direction /= length
        side = np.array([-direction[2], 0.0, direction[0]])
        axes = np.stack([side, direction, np.array([0.0, 1.0, 0.0])], axis=1)
        bar = np.stack([vertices[:, 0], shares * length, vertices[:, 2]], axis=1)
        all_vertices.append(product(bar, axes.T) + np.array([x0, 0.0, z0]))
        all_normals.append(product(normals, axes.T))
    offsets = (np.arange(len(twines)) * len(vertices)).astype(np.uint32)
    triangles = (mesh.triangles[None] + offsets[:, None, None]).reshape(-1, 3)
    return replace(
        mesh,
        vertices=np.concatenate(all_vertices).astype(np.float32),
        normals=np.concatenate(all_normals).astype(np.float32),
        uvs=np.tile(mesh.uvs, (len(twines), 1)),
        triangles=triangles.astype(np.uint32),
        tangents=None,
    )
