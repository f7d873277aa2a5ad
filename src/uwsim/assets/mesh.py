"""Meshes, textures and models as plain arrays."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ..base.files.input_files import InputFile
from ..world import Box
from .collada_asset import ColladaAsset
from .images import EncodedImage, PixelImage


@dataclass(frozen=True, eq=False, kw_only=True)
class Texture:
    """A texture image."""

    name: str
    """The name of the image; equal names mean equal pixels."""
    image: PixelImage | EncodedImage
    """The image; an encoded one is decoded when its pixels are read."""
    repeats: bool = True
    """True if the image repeats outside the coordinates 0..1; False if its edge continues there."""

    @property
    def pixels(self) -> npt.NDArray[np.uint8]:
        """The stored values (no gamma applied), (h, w, 3) or, with holes, (h, w, 4)."""
        return self.image.pixels

    @property
    def jpeg(self) -> bytes | None:
        """The JPEG file from which the pixels are decoded; None if they are from anywhere else."""
        return self.image.jpeg


@dataclass(frozen=True, eq=False, kw_only=True)
class Material:
    """The properties of a surface besides its base colour, as glTF 2.0 (3.9) defines them.

    The image model of physical water uses all of them. UWSim's image model uses the normal map and
    the holes. Numbers are factors on the values of the maps.
    """

    roughness: float = 1.0
    """The roughness, 0 (polished) to 1; its square is the width of GGX's distribution."""
    metallic: float = 0.0
    """The share of metal, 0 (a dielectric) to 1."""
    finish_map: Texture | None = None
    """The map of occlusion (red: share of the diffuse daylight that arrives), roughness (green) and
    metal (blue)."""
    normal_map: Texture | None = None
    """The map of normals: red, green and blue are the components along the tangent (u), the
    bitangent (v) and the vertex normal, 0..255 for -1..1."""
    normal_scale: float = 1.0
    """The factor on the first two components of the normal map."""
    emission: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The emitted radiance in linear light; 1 is that of a white surface in the irradiance 1."""
    emission_map: Texture | None = None
    """The map of the emitted light, in stored values."""
    alpha_cutoff: float | None = None
    """The alpha of the texture below which the surface has a hole; None: it has no holes."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Mesh:
    """Triangles of one material."""

    vertices: npt.NDArray[np.float32]
    """The positions of the vertices, (n, 3) [m]."""
    normals: npt.NDArray[np.float32]
    """The unit normals at the vertices, (n, 3)."""
    uvs: npt.NDArray[np.float32]
    """The texture coordinates, (n, 2); v = 0 is the bottom row of the image, as in OBJ and
    OpenGL."""
    triangles: npt.NDArray[np.uint32]
    """The vertex indices, (m, 3), counter-clockwise as seen from outside."""
    colour: tuple[float, float, float] = (1.0, 1.0, 1.0)
    """The colour, by which the texture is multiplied: red, green, blue, 0..1."""
    texture: Texture | None = None
    """The texture; without one, the colour alone is drawn."""
    opacity: float = 1.0
    """The opacity, from 0 (invisible) to 1 (opaque)."""
    two_sided: bool = False
    """True if back faces are drawn as well."""
    material: Material | None = None
    """The properties besides the base colour; without them the surface is matte."""
    tangents: npt.NDArray[np.float32] | None = None
    """The tangents for a normal map, (n, 4): a unit vector towards greater u, and 1, or -1 where
    the texture is mirrored. None: they are computed from the texture coordinates."""


@dataclass(frozen=True, eq=False)
class ArrayDigest:
    """The hash of the arrays and images of meshes, which is computed when it is read."""

    meshes: tuple[Mesh, ...]
    """The meshes as they were generated."""

    @cached_property
    def sha256(self) -> str:
        """The sha256 in hexadecimal."""
        digest = hashlib.sha256()
        for array in self._arrays():
            digest.update(array.tobytes())
        return digest.hexdigest()

    def _arrays(self) -> Iterator[npt.NDArray[np.generic]]:
        for mesh in self.meshes:
            yield from (mesh.vertices, mesh.normals, mesh.uvs, mesh.triangles)
            material = mesh.material
            maps = () if material is None else (material.finish_map, material.normal_map)
            yield from (image.pixels for image in (mesh.texture, *maps) if image is not None)


@dataclass(frozen=True, eq=False, kw_only=True)
class Model:
    """A model: several meshes in one frame."""

    name: str
    """The name under which the model was loaded."""
    meshes: tuple[Mesh, ...]
    """The meshes, each of one material."""
    source: str
    """The origin: ``"file"``, ``"bundled"``, ``"stand-in"`` (bundled, in place of a model of UWSim)
    or ``"labelled box"`` (a placeholder)."""
    digest: str | ArrayDigest = ""
    """The sha256 of the file's bytes, or that of the arrays of a generated model."""
    files: tuple[InputFile, ...] = ()
    """The file and all files that were read with it: materials, buffers, images."""
    asset: ColladaAsset | None = None
    """The unit and axes that a Collada file states; they are not applied to the vertices."""
    remarks: tuple[str, ...] = ()
    """The parts of the file that are unreadable, and were left out or replaced."""
    box: Box = field(init=False)
    """The bounding box of all vertices."""

    def __post_init__(self) -> None:
        points = np.concatenate([mesh.vertices for mesh in self.meshes])
        low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        object.__setattr__(self, "box", Box(tuple(low), tuple(high)))

    @property
    def unit(self) -> float:
        """The length of a unit of the vertices [m], 1 if the file states none."""
        return 1.0 if self.asset is None else self.asset.unit

    @property
    def sha256(self) -> str:
        """The hash of the file's bytes, or of the arrays of a generated model; "" without one."""
        return self.digest.sha256 if isinstance(self.digest, ArrayDigest) else self.digest

    @property
    def n_triangles(self) -> int:
        """The number of triangles."""
        return sum(len(mesh.triangles) for mesh in self.meshes)
