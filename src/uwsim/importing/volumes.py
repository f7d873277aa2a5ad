r"""Volumes and centres of volume of shapes, as Gazebo's buoyancy computes them.

Gazebo sums the volumes of all collision shapes of a link, overlaps included, and takes the mean of
their centres, weighted by volume. A plane has no volume. The volume of a mesh with the triangles
:math:`a, b, c` is :math:`\frac16 \sum a \cdot (b \times c)`, its centre the mean of the tetrahedra.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array, Pose
from ..world import Box
from .mesh_files import CopiedMesh
from .sdf.spec import Shape

UNIT_BOX = Box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))
"""The box of a shape of unit size."""


@dataclass(frozen=True, kw_only=True)
class Displacement:
    """The water that a link displaces when it is submerged."""

    volume: float
    """The volume [m3]."""
    centre: Array
    """The centre of the volume in the frame of the link, (3,) [m]."""
    box: tuple[Array, Array]
    """The least and greatest coordinates of all shapes, in the axes of the link, (3,) each [m]."""


def displacement_of(shapes: Iterable[tuple[Shape, Pose, CopiedMesh | None]]) -> Displacement | None:
    """Return the displaced water of the shapes of a link; None without any volume.

    Args:
        shapes: each shape, its pose in the frame of the link, and its mesh.
    """
    volumes, moments, lows, highs = [], [], [], []
    for shape, link_from_shape, mesh in shapes:
        volume, centre = shape_volume(shape, mesh)
        if volume <= 0.0:
            continue
        volumes.append(volume)
        moments.append(volume * link_from_shape.transform(centre))
        corners = link_from_shape.transform(_corners(shape, mesh))
        lows.append(corners.min(axis=0))
        highs.append(corners.max(axis=0))
    if not volumes:
        return None
    total = math.fsum(volumes)
    box = np.min(lows, axis=0), np.max(highs, axis=0)
    return Displacement(volume=total, centre=np.sum(moments, axis=0) / total, box=box)


def shape_volume(shape: Shape, mesh: CopiedMesh | None = None) -> tuple[float, Array]:
    """Return the volume of a shape [m3], and its centre in the frame of the shape, (3,) [m]."""
    x, y, z = shape.size
    centre = np.zeros(3)
    if shape.kind == "box":
        return x * y * z, centre
    if shape.kind in ("sphere", "ellipsoid"):
        return math.pi / 6.0 * x * y * z, centre
    if shape.kind == "cylinder":
        return math.pi / 4.0 * x * x * z, centre
    if shape.kind == "capsule":
        return math.pi / 4.0 * x * x * (z - x) + math.pi / 6.0 * x**3, centre
    if shape.kind == "cone":
        return math.pi / 12.0 * x * x * z, np.array([0.0, 0.0, -z / 4.0])
    if shape.kind == "mesh" and mesh is not None:
        return mesh_volume(mesh, shape.scale)
    return 0.0, centre


def mesh_volume(mesh: CopiedMesh, scale: tuple[float, float, float]) -> tuple[float, Array]:
    """Return the volume [m3] and the centre (3,) [m] of a closed mesh; 0 for an open sheet."""
    volume, moment = 0.0, np.zeros(3)
    for part in mesh.model.meshes:
        corners = (
            part.vertices[part.triangles].astype(np.float64) * np.array(scale) * mesh.model.unit
        )
        a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
        sixths = np.sum(a * np.cross(b, c), axis=1) / 6.0
        volume += float(sixths.sum())
        moment += np.sum((a + b + c) / 4.0 * sixths[:, None], axis=0)
    if abs(volume) < 1e-12:
        return 0.0, np.zeros(3)
    return abs(volume), moment / volume


def _corners(shape: Shape, mesh: CopiedMesh | None) -> Array:
    """Return the corners of the box around a shape in its frame, (8, 3) [m]."""
    box, size = UNIT_BOX, np.array(shape.size)
    if shape.kind == "mesh" and mesh is not None:
        box, size = mesh.model.box, np.array(shape.scale) * mesh.model.unit
    corners: Array = box.corners() * size
    return corners
