"""Merging of a model's meshes by appearance, and their division into pieces of one draw call."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..assets.mesh import Material, Mesh, Model, Texture
from ..assets.tangents import add_tangents
from ..base.geometry import Array
from .materials.maps import find_map_key, find_maps
from .pieces import compute_normals, compute_texel_densities, flat_normal, split_triangles

VERTEX = np.dtype(
    [
        ("vertex", np.float32, (3,)),  # position in the model's frame [m]
        ("vertex_normal", np.float32, (3,)),  # unit normal in the model's frame
        ("uv", np.float32, (2,)),  # texture coordinates
        ("tint", np.float32, (3,)),  # red, green, blue, 0..1
    ]
)
"""A vertex, as the shaders read it."""
MATERIAL_VERTEX = np.dtype(
    [
        *VERTEX.descr,
        ("tangent", np.float32, (4,)),  # unit vector in the model's frame; 1 or -1
        ("finish", np.float32, (3,)),  # roughness, share of metal, scale of the normal map
        ("emission", np.float32, (3,)),  # emitted radiance, red, green, blue
    ]
)
"""A vertex of a mesh with a material besides its base colour."""


@dataclass(frozen=True, eq=False)
class Piece:
    """A run of triangles that are near each other and face in about the same direction."""

    first_index: int
    """The position of the piece's first index."""
    size: int
    """The number of the piece's indices, three per triangle."""
    centre: Array
    """The centre of the bounding sphere in the model's frame, (3,) [m]."""
    radius: float
    """The radius of the bounding sphere [m]."""
    corners: Array
    """The corners of the bounding box in the model's frame, (8, 3) [m]."""
    normal: Array
    """The unit normal of a flat piece in the model's frame, (3,); 0 if it is not flat."""
    density: float
    """The largest number of texels per metre on a triangle [1/m]; 0 without a texture."""


@dataclass(frozen=True, eq=False)
class MergedMesh:
    """The meshes of a model that have the same textures, opacity and visible sides, merged."""

    vertices: npt.NDArray[np.void]
    """The vertices, of the type `VERTEX` or `MATERIAL_VERTEX`, (n,)."""
    triangles: npt.NDArray[np.uint32]
    """The vertex indices of the triangles, piece by piece, (m, 3)."""
    pieces: tuple[Piece, ...]
    texture: Texture | None
    two_sided: bool
    """True if the triangles are visible from both sides."""
    opacity: float
    """The opacity: 1 hides what is behind the mesh, 0 is invisible."""
    material: Material | None = None
    """The maps and holes of all meshes; its factors are in the vertices."""


def merge_model(model: Model) -> list[MergedMesh]:
    """Return a model's meshes, merged by appearance, in the order of first appearance."""
    groups: dict[tuple[object, ...], list[Mesh]] = {}
    for mesh in model.meshes:
        if len(mesh.triangles):
            maps = find_map_key(mesh.material)
            appearance = id(mesh.texture), mesh.two_sided, mesh.opacity, maps
            groups.setdefault(appearance, []).append(mesh)
    return [_merge_meshes(meshes) for meshes in groups.values()]


def _merge_meshes(meshes: Sequence[Mesh]) -> MergedMesh:
    """Merge meshes of one appearance, and cut large ones into pieces."""
    material = meshes[0].material
    if material is not None and material.normal_map is not None:
        meshes = [mesh if mesh.tangents is not None else add_tangents(mesh) for mesh in meshes]
    dtype = VERTEX if material is None else MATERIAL_VERTEX
    vertices = np.empty(sum(len(mesh.vertices) for mesh in meshes), dtype=dtype)
    index_arrays, start = [], 0
    for mesh in meshes:
        rows = vertices[start : start + len(mesh.vertices)]
        rows["vertex"], rows["vertex_normal"] = mesh.vertices, mesh.normals
        rows["uv"], rows["tint"] = mesh.uvs, mesh.colour
        if mesh.material is not None:
            _fill_material(rows, mesh, mesh.material)
        index_arrays.append(mesh.triangles.astype(np.uint32) + np.uint32(start))
        start += len(mesh.vertices)
    triangles = np.concatenate(index_arrays)
    points = vertices["vertex"].astype(np.float64)
    normals = compute_normals(points, triangles)
    texture = meshes[0].texture
    densities = np.zeros(len(triangles))
    textures = [] if texture is None else [texture]
    textures += find_maps(material).values()
    if textures:
        height, width = (max(image.pixels.shape[k] for image in textures) for k in range(2))
        densities = compute_texel_densities(
            points, triangles, vertices["uv"].astype(np.float64) * [width, height]
        )
    triangle_groups = split_triangles(points, triangles, normals)
    model_pieces, start = [], 0
    for numbers in triangle_groups:
        model_pieces.append(
            _create_piece(start, points[triangles[numbers]], normals[numbers], densities[numbers])
        )
        start += model_pieces[-1].size
    return MergedMesh(
        vertices=vertices,
        triangles=triangles[np.concatenate(triangle_groups)],  # a piece is a run of triangles
        pieces=tuple(model_pieces),
        texture=texture,
        two_sided=meshes[0].two_sided,
        opacity=meshes[0].opacity,
        material=material,
    )


def _fill_material(rows: npt.NDArray[np.void], mesh: Mesh, material: Material) -> None:
    rows["tangent"] = 0.0 if mesh.tangents is None else mesh.tangents
    rows["finish"] = material.roughness, material.metallic, material.normal_scale
    rows["emission"] = material.emission


def _create_piece(first_index: int, corners: Array, normals: Array, densities: Array) -> Piece:
    """Return a piece with its bounds.

    Args:
        first_index: the position of the piece's first index.
        corners: the corners of the piece's triangles in the model's frame, (k, 3, 3) [m].
        normals: the normals of the triangles, as long as twice their areas, (k, 3) [m2].
        densities: the number of texels per metre on each triangle, (k,) [1/m].
    """
    points = corners.reshape(-1, 3)
    box = np.stack([points.min(axis=0), points.max(axis=0)])  # (2, 3) [m]
    centre = box.mean(axis=0)
    return Piece(
        first_index=first_index,
        size=3 * len(corners),
        centre=centre,
        radius=float(np.sqrt(((points - centre) ** 2).sum(axis=1).max())),
        corners=np.array(list(itertools.product(*box.T))),
        normal=flat_normal(normals),
        density=float(densities.max()),
    )
