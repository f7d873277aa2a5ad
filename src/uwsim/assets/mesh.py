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
    """Names the image; equal names mean equal pixels."""
    pixels: npt.NDArray[np.uint8]
    """(h, w, 3), row 0 at the top, stored values (no gamma applied)."""
    repeats: bool = True
    """Whether coordinates outside 0..1 repeat it; else they clamp."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Mesh:
    """Triangles of one material."""

    vertices: npt.NDArray[np.float32]
    """(n, 3) [m]."""
    normals: npt.NDArray[np.float32]
    """Unit normals at the vertices, (n, 3)."""
    uvs: npt.NDArray[np.float32]
    """Texture coordinates, (n, 2); v = 0 is the bottom row of the image, as in OBJ and OpenGL."""
    triangles: npt.NDArray[np.uint32]
    """Vertex numbers, (m, 3), counter-clockwise seen from outside."""
    colour: tuple[float, float, float] = (1.0, 1.0, 1.0)
    """Multiplied with the texture, 0..1."""
    texture: Texture | None = None
    """None: the colour alone."""
    opacity: float = 1.0
    """1 hides what is behind it, 0 is not seen."""
    two_sided: bool = False
    """Whether back faces are drawn too."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Model:
    """A model: meshes in one frame."""

    name: str
    """The name that selected it."""
    meshes: tuple[Mesh, ...]
    source: str
    """``"file"``, ``"stand-in"`` (ours, modelled) or ``"labelled box"`` (ours, a placeholder)."""
    sha256: str = ""
    """Hash of the file's bytes, or of the arrays when we made it."""
    files: tuple[InputFile, ...] = ()
    """The file and all that were read with it: materials, buffers, images."""
    asset: ColladaAsset | None = None
    """What a Collada file states of its unit and axes; its vertices are as in the file."""
    remarks: tuple[str, ...] = ()
    """What of the file cannot be read, and was left out or replaced."""
    box: Box = field(init=False)
    """Bounding box of all vertices."""

    def __post_init__(self) -> None:
        points = np.concatenate([mesh.vertices for mesh in self.meshes])
        low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        object.__setattr__(self, "box", Box(tuple(low), tuple(high)))

    @property
    def n_triangles(self) -> int:
        """Number of triangles."""
        return sum(len(mesh.triangles) for mesh in self.meshes)
