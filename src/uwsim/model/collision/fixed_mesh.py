"""What is touched of a mesh that stands fixed: flat faces, height fields, or a simpler mesh.

A mesh of up to `MAX_EXACT` flat faces is touched as it is. Of a larger one each material that is a
sheet over a rectangle becomes a height field (`height_field`), and the rest is simplified
(`simplification`), both by the error that the file allows, `ERROR` by default. Without one in the
file the error grows where it would leave more than `MAX_LEFT` triangles.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from .convex_faces import n_patches
from .height_field import EXACT, HeightField, height_field
from .simplification import simplified

MAX_EXACT = 2000
"""Flat faces of a mesh that is touched as it is, unless the file gives an error."""
MAX_LEFT = 8000
"""Triangles that are left of a mesh at most, unless the file gives an error."""
ERROR = 0.03
"""Greatest distance of what is touched from the mesh, unless the file gives another [m]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class FixedMesh:
    """The surface of a fixed mesh that others touch."""

    faces: Array
    """Triangles that are touched as plates, (n, 3, 3) [m]."""
    fields: tuple[HeightField, ...] = ()
    """Height fields that are touched beside them."""
    error: float = 0.0
    """Greatest distance from the mesh [m]."""

    @property
    def is_exact(self) -> bool:
        """Whether it is the mesh itself, but for rounding."""
        return self.error <= EXACT

    def triangles(self) -> Array:
        """The whole surface, (n, 3, 3) [m]."""
        return np.concatenate([self.faces, *(field.triangles() for field in self.fields)])


def fixed_mesh(parts: Sequence[Array], error: float | None) -> FixedMesh:
    """Find what is touched of a mesh.

    Args:
        parts: triangles of each material, counter-clockwise from where they are seen,
            (n, 3, 3) [m].
        error: greatest distance from the mesh that the file allows [m]; None: it gives none.
    """
    whole = np.concatenate([np.zeros((0, 3, 3)), *parts])
    if len(whole) <= MAX_EXACT and not error:
        return FixedMesh(faces=whole)
    allowed = ERROR if error is None else error
    fields: list[HeightField] = []
    others = [np.zeros((0, 3, 3))]
    for part in parts:
        field = height_field(part, allowed) if len(part) > MAX_EXACT else None
        if field is None:
            others.append(part)
        else:
            fields.append(field)
    rest = np.concatenate(others)
    worst = max((field.error for field in fields), default=0.0)
    if error == 0.0 or (error is None and n_patches(rest) <= MAX_EXACT):
        return FixedMesh(faces=rest, fields=tuple(fields), error=worst)
    left = simplified(rest, allowed, MAX_LEFT if error is None else len(rest))
    return FixedMesh(faces=left.triangles, fields=tuple(fields), error=max(worst, left.error))
