"""Models that are repeated and bent along a line, by the formula of `uwsim.scene.object`."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..base.geometry import Array
from ..base.numerics.linear import inverse, rotate_rows, transform_points
from ..errors import AssetError
from .mesh import Mesh, Model

SPACING = 0.05
"""The distance of the points of a line at which directions are computed [m]."""
MAX_TRIANGLES = 4_000_000
"""The greatest number of triangles of a bent model."""


class BentLine:
    """A line with a direction and a normal at each length.

    Args:
        points: the points of the line, (n, 3) [m], n >= 2.
        burial: the depth and the share of the length that is buried, and the number of stretches.
        down: the direction of gravity in the frame of the points, (3,) [1].
    """

    def __init__(self, points: Array, burial: tuple[float, float, int], down: Array) -> None:
        steps = np.diff(points, axis=0)
        lengths = np.cumsum(np.sqrt(np.sum(steps * steps, axis=1)))
        self.length = float(lengths[-1])
        """The length of the line [m]."""
        n = max(2, round(self.length / SPACING) + 1)
        self._lengths = np.linspace(0.0, self.length, n)
        at_points = np.concatenate([[0.0], lengths])
        line = [np.interp(self._lengths, at_points, points[:, i]) for i in range(3)]
        depths = compute_burial(self._lengths, self.length, *burial)
        self._points = np.stack(line, axis=1) + depths[:, None] * down
        self._directions = _unit_rows(np.gradient(self._points, axis=0))

    def bend(self, vertices: Array, normals: Array) -> tuple[Array, Array]:
        """Return vertices along the y axis, and their normals, along the line, (n, 3) [m]."""
        points = self._interpolate(self._points, vertices[:, 1])
        directions = _unit_rows(self._interpolate(self._directions, vertices[:, 1]))
        axis = np.array([0.0, 0.0, 1.0])
        upper = _unit_rows(axis - directions * directions[:, 2:])
        side = np.cross(directions, upper)
        bent_vertices = points + vertices[:, :1] * side + vertices[:, 2:] * upper
        turned_normals = (
            normals[:, :1] * side + normals[:, 1:2] * directions + normals[:, 2:] * upper
        )
        return bent_vertices, turned_normals

    def _interpolate(self, values: Array, lengths: Array) -> Array:
        columns = [np.interp(lengths, self._lengths, values[:, i]) for i in range(3)]
        return np.stack(columns, axis=1)


RAMP = 0.8
"""The length over which a line rises from a buried stretch to the ground [m]."""


def compute_burial(
    lengths: Array, total: float, depth: float, share: float, stretches: int
) -> Array:
    """Compute the depth of a line below its course at some lengths, (n,) [m].

    Args:
        lengths: the lengths from the start of the line, (n,) [m].
        total: the length of the line [m].
        depth: the depth of the buried stretches [m].
        share: the share of the length that is buried [1].
        stretches: the number of buried stretches.
    """
    if share == 0.0 or depth == 0.0:
        return np.zeros(len(lengths))
    period = total / stretches
    centre = (np.floor(np.clip(lengths / period, 0.0, stretches - 0.5)) + 0.5) * period
    excess = np.abs(lengths - centre) - share * period / 2.0
    part = np.clip(1.0 - excess / RAMP, 0.0, 1.0)
    depths: Array = depth * part * part * (3.0 - 2.0 * part)
    return depths


def place_piece(model: Model, object_from_mesh: Array) -> tuple[list[Array], float, float]:
    """Return the vertices of each mesh of a piece, where it starts along y, and its length [m].

    Args:
        model: the model of the piece.
        object_from_mesh: its pose and scale, (4, 4) [m].

    Raises:
        AssetError: the piece has no extent along y.
    """
    matrix, position = object_from_mesh[:3, :3], object_from_mesh[:3, 3]
    pieces = [
        transform_points(m.vertices.astype(np.float64), matrix, position) for m in model.meshes
    ]
    start = min(float(points[:, 1].min()) for points in pieces)
    length = max(float(points[:, 1].max()) for points in pieces) - start
    if length < 1e-3:
        raise AssetError(
            f"{model.name}: its extent along y is {length:g} m; expected 0.001 m or more."
        )
    return pieces, start, length


def bend_model(model: Model, object_from_mesh: Array, line: BentLine) -> Model:
    """Return copies of a model, end to end along its y axis, along a line.

    Args:
        model: the model of one piece.
        object_from_mesh: the pose and the scale of the piece, (4, 4) [m].
        line: the line, in the frame of the object.

    Raises:
        AssetError: the piece has no extent along y, or the copies have too many triangles.
    """
    matrix = object_from_mesh[:3, :3]
    pieces, start, piece = place_piece(model, object_from_mesh)
    n = max(1, round(line.length / piece))
    if n * sum(len(mesh.triangles) for mesh in model.meshes) > MAX_TRIANGLES:
        raise AssetError(
            f"{model.name}: {n} copies along the line have more than {MAX_TRIANGLES} triangles."
        )
    stretch = line.length / (n * piece)
    cofactors = inverse(matrix).T
    meshes = []
    for mesh, vertices in zip(model.meshes, pieces, strict=True):
        vertices[:, 1] = (vertices[:, 1] - start) * stretch
        normals = rotate_rows(cofactors, mesh.normals.astype(np.float64))
        normals = _unit_rows(normals / np.array([1.0, stretch, 1.0]))
        meshes.append(_repeat(mesh, vertices, normals, n, line))
    return replace(model, meshes=tuple(meshes))


def _repeat(mesh: Mesh, vertices: Array, normals: Array, n: int, line: BentLine) -> Mesh:
    """Return n copies of a mesh whose y is the length along the first n-th of the line [m]."""
    copies = np.tile(vertices, (n, 1))
    copies[:, 1] += np.repeat(np.arange(n), len(vertices)) * (line.length / n)
    bent_vertices, turned_normals = line.bend(copies, np.tile(normals, (n, 1)))
    offsets = (np.arange(n) * len(vertices)).astype(np.uint32)
    triangles = (mesh.triangles[None] + offsets[:, None, None]).reshape(-1, 3)
    return replace(
        mesh,
        vertices=bent_vertices.astype(np.float32),
        normals=turned_normals.astype(np.float32),
        uvs=np.tile(mesh.uvs, (n, 1)),
        triangles=triangles.astype(np.uint32),
        tangents=None,
    )


def _unit_rows(vectors: Array) -> Array:
    """Return vectors (n, 3) divided by their lengths."""
    unit_vectors: Array = vectors / np.sqrt(np.sum(vectors * vectors, axis=1))[:, None]
    return unit_vectors
