"""Collision surface of a fixed mesh: flat faces, height fields, or a simpler mesh.

A mesh of up to `MAX_EXACT_FACES` flat faces is its own collision surface. In a larger mesh, each
material that is a sheet over a rectangle becomes a height field (`height_field`), and the rest is
simplified (`simplification`). Both are within the error that the scene file allows, by default
`DEFAULT_ERROR`. The default error grows if more than `MAX_TRIANGLES` triangles would remain.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from .convex_faces import count_patches
from .height_field import ROUNDING_ERROR, HeightField, height_field
from .simplification import simplify

MAX_EXACT_FACES = 2000
"""The greatest number of flat faces of an exact surface, unless the file gives an error."""
MAX_TRIANGLES = 8000
"""The greatest number of triangles after simplification, unless the file gives an error."""
DEFAULT_ERROR = 0.03
"""The default of the greatest distance of the collision surface from the mesh [m]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class FixedMesh:
    """The collision surface of a fixed mesh."""

    faces: Array
    """The triangles that become plates, (n, 3, 3) [m]."""
    fields: tuple[HeightField, ...] = ()
    """The height fields of the rest of the surface."""
    error: float = 0.0
    """The greatest distance from the mesh [m]."""

    @property
    def is_exact(self) -> bool:
        """True if the surface is the mesh itself, except for rounding."""
        return self.error <= ROUNDING_ERROR

    def triangles(self) -> Array:
        """Return the whole surface, (n, 3, 3) [m]."""
        return np.concatenate([self.faces, *(field.triangles() for field in self.fields)])


def fixed_mesh(parts: Sequence[Array], error: float | None) -> FixedMesh:
    """Compute the collision surface of a fixed mesh.

    Args:
        parts: the triangles of each material, counter-clockwise seen from outside, (n, 3, 3) [m].
        error: the greatest distance from the mesh that the file allows [m]; None: no limit given.
    """
    triangles = np.concatenate([np.zeros((0, 3, 3)), *parts])
    if len(triangles) <= MAX_EXACT_FACES and not error:
        return FixedMesh(faces=triangles)
    max_error = DEFAULT_ERROR if error is None else error
    fields: list[HeightField] = []
    other_parts = [np.zeros((0, 3, 3))]
    for part in parts:
        field = height_field(part, max_error) if len(part) > MAX_EXACT_FACES else None
        if field is None:
            other_parts.append(part)
        else:
            fields.append(field)
    rest = np.concatenate(other_parts)
    field_error = max((field.error for field in fields), default=0.0)
    if error == 0.0 or (error is None and count_patches(rest) <= MAX_EXACT_FACES):
        return FixedMesh(faces=rest, fields=tuple(fields), error=field_error)
    simple_mesh = simplify(rest, max_error, MAX_TRIANGLES if error is None else len(rest))
    total_error = max(field_error, simple_mesh.error)
    return FixedMesh(faces=simple_mesh.triangles, fields=tuple(fields), error=total_error)
