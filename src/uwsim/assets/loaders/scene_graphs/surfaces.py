"""Surfaces of a scene graph, and their meshes for the reader of models."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..references import References
from .node import Numbers

Colour = tuple[float, float, float]


@dataclass(frozen=True, eq=False, kw_only=True)
class Surface:
    """Triangles of one material, corner by corner, in the frame of the file."""

    corners: Numbers
    """The corners of the triangles, three after three, (n, 3)."""
    uvs: Numbers | None = None
    """The texture coordinates of the corners, v up, (n, 2); None without any."""
    colour: Colour = (0.8, 0.8, 0.8)
    """The diffuse colour [0..1]."""
    images: tuple[str, ...] = ()
    """The names of the image; the first that is found is used."""


def make_parts(
    surfaces: list[Surface], references: References
) -> list[tuple[npt.NDArray[np.float64], Any]]:
    """Return a mesh of trimesh for each surface, each with the identity as pose."""
    import trimesh

    visuals: Any = trimesh.visual
    parts = []
    images: dict[str, Any] = {}
    for surface in surfaces:
        n = len(surface.corners) // 3
        if n == 0:
            continue
        mesh = trimesh.Trimesh(
            vertices=surface.corners[: 3 * n],
            faces=np.arange(3 * n).reshape(-1, 3),
            process=False,
        )
        picture = None
        for name in surface.images:
            if name not in images:
                images[name] = references.image(name)
            picture = picture or images[name]
        uvs = np.zeros((3 * n, 2)) if surface.uvs is None else surface.uvs[: 3 * n]
        if picture is not None and surface.uvs is not None:
            material = visuals.material.PBRMaterial(baseColorTexture=picture)
        else:
            colour = [round(255 * min(max(value, 0.0), 1.0)) for value in surface.colour]
            material = visuals.material.PBRMaterial(
                baseColorFactor=np.array([*colour, 255], dtype=np.uint8)
            )
        mesh.visual = visuals.TextureVisuals(uv=uvs, material=material)
        parts.append((np.eye(4), mesh))
    return parts
