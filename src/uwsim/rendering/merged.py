"""Meshes of one look merged into one, and cut into pieces: what is drawn with one call each."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..assets.mesh import Mesh, Model, Texture
from ..base.geometry import Array
from .pieces import crosses, densities, flat_normal, pieces

VERTEX = np.dtype(
    [
        ("vertex", np.float32, (3,)),
        ("vertex_normal", np.float32, (3,)),
        ("uv", np.float32, (2,)),
        ("tint", np.float32, (3,)),
    ]
)


@dataclass(frozen=True, eq=False)
class Piece:
    """A run of triangles near each other, that face about the same way."""

    first: int
    """Where its own indices begin ..."""
    size: int
    """... and how many they are."""
    centre: Array
    """Centre of the bounding sphere, model frame, (3,) [m]."""
    radius: float
    """Radius of the bounding sphere [m]."""
    corners: Array
    """Corners of the bounding box, model frame, (8, 3) [m]."""
    normal: Array
    """Of its plane, model frame, (3,); 0 if it is bent."""
    density: float
    """Texels along a metre, where most are [1/m]; 0 without a texture."""


@dataclass(frozen=True, eq=False)
class Merged:
    """Meshes of one texture, of as many sides, and as opaque."""

    vertices: npt.NDArray[np.void]
    """Of the type `VERTEX`, (n,)."""
    triangles: npt.NDArray[np.uint32]
    """Numbers of their vertices, piece by piece, (m, 3)."""
    pieces: tuple[Piece, ...]
    texture: Texture | None
    two_sided: bool
    opacity: float


def merged(model: Model) -> list[Merged]:
    """Return the meshes of a model merged by their look, in the order in which each comes first."""
    groups: dict[tuple[int, bool, float], list[Mesh]] = {}
    for mesh in model.meshes:
        if len(mesh.triangles):
            look = id(mesh.texture), mesh.two_sided, mesh.opacity
            groups.setdefault(look, []).append(mesh)
    return [_merge(meshes) for meshes in groups.values()]


def _merge(meshes: Sequence[Mesh]) -> Merged:
    """Merge meshes of one look, and cut what is large."""
    vertices = np.empty(sum(len(mesh.vertices) for mesh in meshes), dtype=VERTEX)
    several, first = [], 0
    for mesh in meshes:
        part = vertices[first : first + len(mesh.vertices)]
        part["vertex"], part["vertex_normal"] = mesh.vertices, mesh.normals
        part["uv"], part["tint"] = mesh.uvs, mesh.colour
        several.append(mesh.triangles.astype(np.uint32) + np.uint32(first))
        first += len(mesh.vertices)
    triangles = np.concatenate(several)
    points = vertices["vertex"].astype(np.float64)
    normals = crosses(points, triangles)
    texture = meshes[0].texture
    texels = np.zeros(len(triangles))
    if texture is not None:
        height, width = texture.pixels.shape[:2]
        texels = densities(points, triangles, vertices["uv"].astype(np.float64) * [width, height])
    parts = pieces(points, triangles, normals)
    found, first = [], 0
    for numbers in parts:
        found.append(_piece(first, points[triangles[numbers]], normals[numbers], texels[numbers]))
        first += found[-1].size
    return Merged(
        vertices=vertices,
        triangles=triangles[np.concatenate(parts)],  # a piece is a run of triangles
        pieces=tuple(found),
        texture=texture,
        two_sided=meshes[0].two_sided,
        opacity=meshes[0].opacity,
    )


def _piece(first: int, corners: Array, normals: Array, texels: Array) -> Piece:
    """Measure a piece.

    Args:
        first: where its indices begin.
        corners: of its triangles, (k, 3, 3) [m].
        normals: of its triangles, (k, 3) [m2].
        texels: along a metre on each, (k,) [1/m].
    """
    points = corners.reshape(-1, 3)
    box = np.stack([points.min(axis=0), points.max(axis=0)])  # (2, 3) [m]
    centre = box.mean(axis=0)
    return Piece(
        first=first,
        size=3 * len(corners),
        centre=centre,
        radius=float(np.sqrt(((points - centre) ** 2).sum(axis=1).max())),
        corners=np.array(list(itertools.product(*box.T))),
        normal=flat_normal(normals),
        density=float(texels.max()),
    )
