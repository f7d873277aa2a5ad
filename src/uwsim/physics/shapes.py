"""What is touched: boxes, balls, cylinders and convex hulls made from meshes.

=================  ======================================================================
collisionShapeType  shape
=================  ======================================================================
box                the bounding box in the object's axes
sphere             the ball around its centre that is as wide as the box is long
compound box       a bounding box for each of the mesh's materials
compound cylinder  a cylinder in each of those boxes, along its longest edge
trimesh            loose: the convex hull of each material; fixed: the faces themselves
compound trimesh   as trimesh
=================  ======================================================================

A fixed trimesh becomes plates behind its faces: a flat rectangle of triangles one slab, every
other triangle a prism, `THICKNESS` deep, away from the side the triangle is seen from. Not
modelled: hollows of loose things, faces seen from both sides.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from ..assets.mesh import Model
from ..errors import UwsimError
from ..geometry import Array, Pose

THICKNESS = 0.1
"""Of the plates of a fixed trimesh; not more than its shortest extent, unless it is `FLAT` [m]."""
FLAT = 0.01
"""A mesh no thicker than this is a plane [m]."""
MOST_PIECES = 3000
"""Plates of one fixed trimesh."""
THINNEST = 1e-3
"""Least edge of a box [m]."""
SAME = 1e-4
"""Corners nearer than this are one [m]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Shape:
    """A convex shape on a body."""

    kind: Literal["box", "sphere", "cylinder", "hull"]
    """What it is."""
    body_from_shape: Pose
    """Where its middle is; a cylinder's axis is z."""
    size: tuple[float, ...] = ()
    """Half edges of a box; radius of a ball; radius and half length of a cylinder [m]."""
    corners: Array | None = None
    """Of a hull, in the shape's frame, (n, 3) [m]."""


def shapes_of(
    model: Model, body_from_mesh: npt.NDArray[np.float64], kind: str, *, is_fixed: bool
) -> tuple[Shape, ...]:
    """Make the shapes of a body.

    Args:
        model: its meshes.
        body_from_mesh: where they are on the body, with their scale, (4, 4) [m].
        kind: collisionShapeType; an unknown one is read as box.
        is_fixed: whether the body never moves.

    Raises:
        UwsimError: a fixed trimesh has too many faces.
    """
    turn, shift = body_from_mesh[:3, :3], body_from_mesh[:3, 3]
    parts = [mesh.vertices.astype(np.float64) @ turn.T + shift for mesh in model.meshes]
    if kind in ("trimesh", "compound trimesh"):
        if not is_fixed:
            return tuple(_hull(part) for part in parts)
        triangles = [part[mesh.triangles] for part, mesh in zip(parts, model.meshes, strict=True)]
        return _plates(np.concatenate(triangles), model.name)
    if kind == "compound box":
        return tuple(box_around(part) for part in parts)
    if kind == "compound cylinder":
        return tuple(_cylinder(box_around(part)) for part in parts)
    box = box_around(np.concatenate(parts))
    if kind == "sphere":
        return (Shape(kind="sphere", body_from_shape=box.body_from_shape, size=(max(box.size),)),)
    return (box,)


def box_around(points: Array) -> Shape:
    """The box along the axes around points (n, 3) [m]."""
    low, high = points.min(axis=0), points.max(axis=0)
    half = np.maximum(0.5 * (high - low), 0.5 * THINNEST)
    middle = Pose(0.5 * (low + high), np.eye(3))
    return Shape(kind="box", body_from_shape=middle, size=tuple(half.tolist()))


def _cylinder(box: Shape) -> Shape:
    along = int(np.argmax(box.size))
    across = [half for axis, half in enumerate(box.size) if axis != along]
    turn = np.roll(np.eye(3), along - 2, axis=0)  # z becomes the longest axis
    place = Pose(box.body_from_shape.position, turn)
    return Shape(kind="cylinder", body_from_shape=place, size=(max(across), box.size[along]))


def _hull(points: Array) -> Shape:
    extent = points.max(axis=0) - points.min(axis=0)
    if extent.min() < THINNEST:  # flat: has no hull
        return box_around(points)
    return Shape(kind="hull", body_from_shape=Pose.identity(), corners=points)


def _plates(triangles: Array, name: str) -> tuple[Shape, ...]:
    """Slabs and prisms behind the faces, (n, 3, 3) [m]."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    areas = 0.5 * np.linalg.norm(normals, axis=1)  # (n,) [m2]
    real = areas > SAME**2
    triangles, normals, areas = triangles[real], normals[real], areas[real]
    if not len(triangles):
        return ()
    normals = normals / (2.0 * areas[:, None])
    flat = triangles.reshape(-1, 3)
    thinnest = float(np.min(np.ptp(flat, axis=0)))
    depth = THICKNESS if thinnest < FLAT else min(THICKNESS, thinnest)
    plates: list[Shape] = []
    for patch in _patches(triangles, normals):
        normal = normals[patch[0]]
        slab = _slab(triangles[patch], normal, float(areas[patch].sum()), depth)
        if slab is not None:
            plates.append(slab)
            continue
        for corners in triangles[patch]:
            prism = np.concatenate([corners, corners - depth * normal])
            plates.append(Shape(kind="hull", body_from_shape=Pose.identity(), corners=prism))
    if len(plates) > MOST_PIECES:
        raise UwsimError(
            f"{name!r} as a fixed trimesh would be {len(plates)} plates; at most {MOST_PIECES}. "
            "Name a simpler mesh in <collisionShape>, or another <collisionShapeType>."
        )
    return tuple(plates)


def _patches(triangles: Array, normals: Array) -> list[list[int]]:
    """Numbers of triangles that lie in one plane and hang together, in the mesh's order."""
    offsets = np.einsum("ij,ij->i", normals, triangles[:, 0])
    planes = np.round(np.column_stack([normals, offsets]) / 1e-3).astype(np.int64)
    corners = np.round(triangles / SAME).astype(np.int64)
    leader = list(range(len(triangles)))

    def find(i: int) -> int:
        while leader[i] != i:
            leader[i] = leader[leader[i]]
            i = leader[i]
        return i

    seen: dict[tuple[int, ...], int] = {}
    for i in range(len(triangles)):
        plane = tuple(planes[i].tolist())
        for corner in corners[i].tolist():
            first = seen.setdefault((*plane, *corner), i)
            leader[find(i)] = find(first)
    patches: dict[int, list[int]] = {}
    for i in range(len(triangles)):
        patches.setdefault(find(i), []).append(i)
    return list(patches.values())


def _slab(triangles: Array, normal: Array, area: float, depth: float) -> Shape | None:
    """The slab behind a flat rectangle; None for any other patch (n, 3, 3) [m]."""
    points = triangles.reshape(-1, 3)
    for edge in _directions(triangles):
        frame = np.column_stack([edge, np.cross(normal, edge), normal])  # body_from_plane
        low, high = _ends(points @ frame)
        if abs((high[0] - low[0]) * (high[1] - low[1]) - area) <= 1e-3 * area:
            middle = 0.5 * (low + high)
            middle[2] = high[2] - 0.5 * depth
            half = (0.5 * (high[0] - low[0]), 0.5 * (high[1] - low[1]), 0.5 * depth)
            return Shape(kind="box", body_from_shape=Pose(frame @ middle, frame), size=half)
    return None


def _directions(triangles: Array) -> Iterable[Array]:
    """Directions of the first triangle's edges."""
    first = triangles[0]
    for a, b in ((0, 1), (1, 2), (2, 0)):
        edge = first[b] - first[a]
        yield edge / np.linalg.norm(edge)


def _ends(points: Array) -> tuple[Array, Array]:
    return points.min(axis=0), points.max(axis=0)


def bounds(shapes: Sequence[Shape]) -> Shape:
    """The box along the body's axes around several shapes."""
    points = []
    for shape in shapes:
        if shape.corners is not None:
            corners = shape.corners
        else:
            half = {
                "box": shape.size,
                "sphere": shape.size * 3,
                "cylinder": (shape.size[0], *shape.size) if len(shape.size) == 2 else (),
            }[shape.kind]
            signs = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) * 2.0 - 1.0
            corners = signs * np.array(half)
        points.append(shape.body_from_shape.transform(corners))
    return box_around(np.concatenate(points))
