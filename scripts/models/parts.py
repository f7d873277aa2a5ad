"""The parts of a model as they are written: a mesh and the maps of its material."""

from __future__ import annotations

from dataclasses import dataclass

from uwsim.assets.mesh import Mesh, Texture


@dataclass(frozen=True, eq=False, kw_only=True)
class Maps:
    """The maps of a material beside its base colour; images share the coordinates of the mesh."""

    normal: Texture | None = None
    """The normal in the frame of the surface, as (rgb - 0.5) * 2; x along u, y along v upwards."""
    surface: Texture | None = None
    """The occlusion (red), the roughness (green) and the metallic share (blue), 0..255."""
    roughness: float = 1.0
    """The roughness, by which that of the image is multiplied."""
    metallic: float = 0.0
    """The metallic share, by which that of the image is multiplied."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Part:
    """A mesh with maps, whose images may be stored with loss."""

    mesh: Mesh
    """The triangles, with the texture of the base colour."""
    maps: Maps | None = None
    """The maps; without them the material is rough and dielectric."""
    is_lossless: bool = False
    """True if images are stored as PNG and texture coordinates to the last bit."""
