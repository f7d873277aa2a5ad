"""Collision shapes: boxes, spheres, cylinders and convex hulls made from meshes.

=================  ======================================================================
collisionShapeType  shape
=================  ======================================================================
box                the bounding box in the object's axes
sphere             the ball at the centre of that box, as wide as the box is long
compound box       a bounding box for each of the mesh's materials
compound cylinder  a cylinder in each of those boxes, along its longest edge
trimesh            loose: the convex hull of each material; fixed: the faces themselves
compound trimesh   as trimesh
=================  ======================================================================

A fixed trimesh becomes plates of the thickness `PLATE_THICKNESS` behind the front sides of its flat
faces (`convex_faces`): slabs behind rectangles, prisms behind other polygons. A large fixed trimesh
is simplified, or becomes tiles of a height field (`fixed_mesh`) that are `FIELD_DEPTH` thick. If
the faces of the ground mainly face down, they are flipped, as their file has the corners in reverse
order. Not modelled: hollows of loose objects, faces with two front sides.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from ...assets.mesh import Model
from ...base.geometry import Array, Pose
from ...base.numerics.linear import product, transform_points
from ...errors import UwsimError
from .fixed_mesh import FixedMesh
from .fixed_mesh_cache import cached_mesh
from .height_field import HeightField
from .polygon_cache import cached_faces

TRIMESHES = ("trimesh", "compound trimesh")
"""The collisionShapeTypes that use the faces of a fixed mesh."""
PLATE_THICKNESS = 0.1
"""The thickness of plates; at most the shortest extent of the mesh, unless that is flat [m]."""
FIELD_DEPTH = 1.0
"""The depth of a height field below its lowest point [m]."""
MAX_PLANE_THICKNESS = 0.01
"""The greatest thickness of a mesh that counts as flat [m]."""
MAX_PLATES = 10_000
"""The greatest number of plates of one fixed trimesh."""
MIN_HEIGHT_RANGE = 1e-6
"""The minimum height range of a height field in the engine [m]."""
MIN_EDGE = 1e-3
"""The minimum edge of a box [m]."""
MAX_BULGE = 0.01
"""The greatest deviation of a mesh that counts as convex, as a fraction of its longest extent
[1]."""
MAX_HULL_FACES = 1000
"""The greatest number of faces of a moving mesh whose hull is its collision shape."""
RECTANGLE_TOLERANCE = 1e-3
"""The tolerance of a rectangle: for the cosine of its angles, and relative for its edges [1]."""
MIN_DOWNWARD_SHARE = 0.5
"""The net fraction of the horizontal area that faces down, above which ground is flipped [1]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CollisionShape:
    """A convex shape on a body."""

    kind: Literal["box", "sphere", "cylinder", "hull", "height field"]
    """The kind of shape."""
    body_from_shape: Pose
    """The pose of the shape's centre on the body. The axis of a cylinder is z. The origin of a
    height field is at its centre, at the lowest height."""
    size: tuple[float, ...] = ()
    """The half edges of a box; the radius of a sphere; radius and half length of a cylinder; two
    half edges, greatest height and depth below the origin of a height field; empty for a hull
    [m]."""
    corners: Array | None = None
    """The corners of a hull, in the shape's frame, (n, 3) [m]."""
    heights: Array | None = None
    """The heights of a height field above its lowest, (rows, columns) [m]; each row is along x."""
    friction: float | None = None
    """The coefficient of sliding friction, which applies in all contacts [1]; None: that of the
    engine."""


def shapes_of(
    model: Model,
    body_from_mesh: npt.NDArray[np.float64],
    kind: str,
    *,
    is_fixed: bool,
    up: Array | None = None,
    error: float | None = None,
) -> tuple[CollisionShape, ...]:
    """Return the collision shapes of a body.

    Args:
        model: the meshes of the body.
        body_from_mesh: the pose of the meshes on the body, with their scale, (4, 4) [m].
        kind: the collisionShapeType; an unknown type is read as ``box``.
        is_fixed: True if the body never moves.
        up: the z axis of W in the body's axes, (3,), if the body is the ground; else None.
        error: the greatest distance of a fixed trimesh from its mesh [m]; None: the default.

    Raises:
        UwsimError: a fixed trimesh has too many faces.
    """
    matrix, shift = body_from_mesh[:3, :3], body_from_mesh[:3, 3]
    parts = [
        transform_points(mesh.vertices.astype(np.float64), matrix, shift) for mesh in model.meshes
    ]
    if kind in TRIMESHES:
        if not is_fixed:
            return tuple(_hull(part) for part in parts)
        mesh = fixed_mesh_of(model, body_from_mesh, up=up, error=error)
        tiles = [tile for field in mesh.fields for tile in _tiles(field)]
        return (*_plates(mesh.faces, model.name), *tiles)
    if kind == "compound box":
        return tuple(box_around(part) for part in parts)
    if kind == "compound cylinder":
        return tuple(_cylinder(box_around(part)) for part in parts)
    box = box_around(np.concatenate(parts))
    if kind == "sphere":
        return (
            CollisionShape(
                kind="sphere", body_from_shape=box.body_from_shape, size=(max(box.size),)
            ),
        )
    return (box,)


def fixed_mesh_of(
    model: Model,
    body_from_mesh: npt.NDArray[np.float64],
    *,
    up: Array | None,
    error: float | None,
) -> FixedMesh:
    """Return the collision surface of a fixed trimesh; for the arguments see `shapes_of`."""
    matrix, shift = body_from_mesh[:3, :3], body_from_mesh[:3, 3]
    parts = [
        transform_points(mesh.vertices.astype(np.float64), matrix, shift)[mesh.triangles]
        for mesh in model.meshes
    ]
    if up is not None:
        triangles = orient_upwards(up, np.concatenate(parts))
        parts = np.split(triangles, np.cumsum([len(part) for part in parts])[:-1])
    return cached_mesh(parts, error)


def convex_shapes(
    model: Model, body_from_mesh: npt.NDArray[np.float64]
) -> tuple[CollisionShape, ...] | None:
    """Return the convex hull, or box, of each material of a model; None if one is not convex.

    Args:
        model: the meshes of the body.
        body_from_mesh: the pose of the meshes on the body, with their scale, (4, 4) [m].
    """
    matrix, shift = body_from_mesh[:3, :3], body_from_mesh[:3, 3]
    hulls = []
    for mesh in model.meshes:
        points = transform_points(mesh.vertices.astype(np.float64), matrix, shift)
        if len(mesh.triangles) > MAX_HULL_FACES or not is_convex(points[mesh.triangles]):
            return None
        hulls.append(box_around(points) if _is_box(points) else _hull(points))
    return tuple(hulls)


def _is_box(points: Array) -> bool:
    """Return whether points are the corners of a box: grippers hold best with boxes."""
    low, high = points.min(axis=0), points.max(axis=0)
    tolerance = RECTANGLE_TOLERANCE * (high - low)
    is_high = high - points <= tolerance  # (n, 3)
    if not np.all(is_high | (points - low <= tolerance)):
        return False
    return len({tuple(corner) for corner in is_high.tolist()}) == 8


def is_convex(triangles: Array) -> bool:
    """Return whether triangles (n, 3, 3) are convex within the tolerance `MAX_BULGE`."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    sizes = np.linalg.norm(normals, axis=1)  # (n,) [m2]
    has_area = sizes > 0.0
    if not has_area.any():
        return False
    normals = normals[has_area] / sizes[has_area, None]
    offsets = np.sum(normals * triangles[has_area, 0], axis=1)  # (n,) [m]
    corners = triangles.reshape(-1, 3)
    bulge = float((product(corners, normals.T) - offsets).max())
    return bulge <= MAX_BULGE * float(np.ptp(corners, axis=0).max())


def box_around(points: Array) -> CollisionShape:
    """Return the axis-aligned box around points (n, 3) [m]."""
    low, high = points.min(axis=0), points.max(axis=0)
    half = np.maximum(0.5 * (high - low), 0.5 * MIN_EDGE)
    body_from_box = Pose(0.5 * (low + high), np.eye(3))
    return CollisionShape(kind="box", body_from_shape=body_from_box, size=tuple(half.tolist()))


def _cylinder(box: CollisionShape) -> CollisionShape:
    axis_index = int(np.argmax(box.size))
    radii = [half for axis, half in enumerate(box.size) if axis != axis_index]
    rotation = np.roll(
        np.eye(3), axis_index - 2, axis=0
    )  # the z axis of the cylinder is the longest axis of the box
    body_from_cylinder = Pose(box.body_from_shape.position, rotation)
    return CollisionShape(
        kind="cylinder", body_from_shape=body_from_cylinder, size=(max(radii), box.size[axis_index])
    )


def _hull(points: Array) -> CollisionShape:
    extent = points.max(axis=0) - points.min(axis=0)
    if extent.min() < MIN_EDGE:  # a flat mesh has no convex hull
        return box_around(points)
    return CollisionShape(kind="hull", body_from_shape=Pose.identity(), corners=points)


def orient_upwards(up: Array, triangles: Array) -> Array:
    """Return triangles (n, 3, 3) of the ground, flipped if they are a sheet that faces down.

    A closed mesh has equal areas that face up and down, and is not changed.

    Args:
        up: the upward direction in the frame of the triangles, (3,).
        triangles: the triangles.
    """
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    upward_parts = product(normals, up)
    oriented_triangles: Array = (
        triangles[:, ::-1]
        if upward_parts.sum() < -MIN_DOWNWARD_SHARE * np.abs(upward_parts).sum()
        else triangles
    )
    return oriented_triangles


def _plates(triangles: Array, name: str) -> tuple[CollisionShape, ...]:
    """Return slabs and prisms behind the flat faces of triangles (n, 3, 3) [m]."""
    faces = cached_faces(triangles)
    if len(faces) > MAX_PLATES:
        raise UwsimError(
            f"{name!r} as a fixed trimesh has {len(faces)} plates; expected at most {MAX_PLATES}. "
            "Set a greater <u:contactError>, name a simpler mesh in <collisionShape>, or another "
            "<collisionShapeType>."
        )
    if not faces:
        return ()
    min_extent = float(np.min(np.ptp(triangles.reshape(-1, 3), axis=0)))
    depth = (
        PLATE_THICKNESS if min_extent < MAX_PLANE_THICKNESS else min(PLATE_THICKNESS, min_extent)
    )
    plates: dict[int, CollisionShape] = {}
    sizes = np.array([len(face) for face in faces])
    for size in np.unique(sizes):
        indices = np.flatnonzero(sizes == size).tolist()
        polygons = np.stack([faces[i] for i in indices])
        plates.update(zip(indices, _plates_of(polygons, depth), strict=True))
    return tuple(plates[i] for i in range(len(faces)))


def _plates_of(faces: Array, depth: float) -> Iterator[CollisionShape]:
    """Yield the plate behind each of n flat convex polygons of k corners, (n, k, 3) [m]."""
    edges = np.roll(faces, -1, axis=1) - faces
    spokes = faces[:, 1:] - faces[:, :1]
    normals = _sum(np.cross(spokes[:, :-1], spokes[:, 1:]))
    normals /= np.sqrt(_dots(normals, normals))[:, None]
    lengths = np.sqrt(_dots(edges, edges))  # (n, k)
    if faces.shape[1] == 4:
        edge_0, edge_1, edge_2 = edges[:, 0], edges[:, 1], edges[:, 2]
        is_square = (
            np.abs(_dots(edge_0, edge_1)) <= RECTANGLE_TOLERANCE * lengths[:, 0] * lengths[:, 1]
        )
        difference = edge_0 + edge_2
        is_slab = is_square & (
            np.sqrt(_dots(difference, difference)) <= RECTANGLE_TOLERANCE * lengths[:, 0]
        )
    else:
        is_slab = np.zeros(len(faces), bool)
    x_axes = edges[:, 0] / np.where(is_slab, lengths[:, 0], 1.0)[:, None]
    rotations = np.stack([x_axes, np.cross(normals, x_axes), normals], axis=2)  # body_from_shape
    centres = _sum(faces) / faces.shape[1] - 0.5 * depth * normals
    prisms = np.concatenate([faces, faces - (depth * normals)[:, None]], axis=1)
    for n in range(len(faces)):
        if is_slab[n]:
            half = (0.5 * float(lengths[n, 0]), 0.5 * float(lengths[n, 1]), 0.5 * depth)
            pose = Pose(centres[n], rotations[n])
            yield CollisionShape(kind="box", body_from_shape=pose, size=half)
        else:
            pose = Pose.identity()
            yield CollisionShape(kind="hull", body_from_shape=pose, corners=prisms[n])


def _tiles(field: HeightField) -> Iterator[CollisionShape]:
    half_cell = 0.5 * field.spacing
    for centre, heights in field.tiles():
        low, high = float(heights.min()), float(heights.max())
        rows, columns = heights.shape
        half = (columns - 1) * half_cell[0], (rows - 1) * half_cell[1]
        yield CollisionShape(
            kind="height field",
            body_from_shape=Pose(centre + low * field.body_from_field[:, 2], field.body_from_field),
            size=(float(half[0]), float(half[1]), max(high - low, MIN_HEIGHT_RANGE), FIELD_DEPTH),
            heights=heights - low,
        )


def _sum(vectors: Array) -> Array:
    """Add vectors (n, k, 3) from first to last, (n, 3)."""
    total: Array = vectors[:, 0]
    for i in range(1, vectors.shape[1]):
        total = total + vectors[:, i]
    return total


def _dots(left: Array, right: Array) -> Array:
    products = left * right
    sums: Array = products[..., 0] + products[..., 1] + products[..., 2]
    return sums


def bounding_box(shapes: Sequence[CollisionShape]) -> CollisionShape:
    """Return the box around several shapes, with the axes of the body."""
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
