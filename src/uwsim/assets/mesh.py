"""Meshes, textures and models as plain arrays."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from ..base.files.input_files import InputFile
from ..world import Box
from .collada_asset import ColladaAsset


@dataclass(frozen=True, eq=False, kw_only=True)
class Texture:
    """A texture image."""

    name: str
    """The name of the image; equal names mean equal pixels."""
    pixels: npt.NDArray[np.uint8]
    """The stored values (no gamma applied), (h, w, 3), row 0 at the top."""
    repeats: bool = True
    """True if the image repeats outside the coordinates 0..1; False if its edge continues there."""


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
    sha256: str = ""
    """The hash of the file's bytes, or of the arrays of a generated model."""
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
    def n_triangles(self) -> int:
        """The number of triangles."""
        return sum(len(mesh.triangles) for mesh in self.meshes)
