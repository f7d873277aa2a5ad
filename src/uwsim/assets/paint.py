"""The colour of a material in a robot file, applied to a mesh in place of its own colour."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

from .mesh import Model

Colour = tuple[float, float, float, float]


@lru_cache(maxsize=1024)
def paint_model(model: Model, colour: Colour) -> Model:
    """Return the model in another colour; calls with equal arguments return one object.

    The colour replaces that of the mesh and is multiplied with its texture. (UWSim and RViz prefer
    the mesh's own materials, so that the file's colour shows on meshes without any.)

    Args:
        model: the model to paint.
        colour: red, green, blue, opacity, 0..1.
    """
    red, green, blue, opacity = colour
    meshes = tuple(
        replace(mesh, colour=(red, green, blue), opacity=opacity) for mesh in model.meshes
    )
    return replace(model, meshes=meshes)
