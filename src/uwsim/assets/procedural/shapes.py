"""Shapes: triangles with texture coordinates, made from a few numbers.

A shape is a set of triangles; `mesh` converts it to vertices with normals. Edges between faces at
an angle below `CREASE` are smoothed; sharper edges remain. Frames are right-handed, lengths are in
metres, and the corners of triangles are counter-clockwise as seen from outside.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Triple
from ...base.numerics.jit import njit
from ...base.numerics.linear import length, product
from ..mesh import Mesh, Texture

CREASE = 0.85
"""The angle between faces [rad] below which they are shaded as one curved surface."""


@dataclass(frozen=True, eq=False)
class Shape:
    """Triangles without shared vertices: simple to make, move and join."""

    corners: Array
    """The triangles, (m, 3, 3) [m]: triangle, corner, coordinate."""
    uvs: Array
    """The texture coordinates of the corners, (m, 3, 2)."""

    def shift(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Shape:
        """Return the shape, shifted [m]."""
        return Shape(self.corners + np.array([x, y, z]), self.uvs)

    def rotate(self, rotation: Array) -> Shape:
        """Return the shape under a rotation (3, 3) about the origin."""
        return Shape(product(self.corners, rotation.T), self.uvs)

    def scale(self, x: float, y: float, z: float) -> Shape:
        """Return the shape with its axes stretched; its triangles face outward, mirrored or not."""
        corners = self.corners * np.array([x, y, z])
        if x * y * z < 0.0:
            return Shape(corners[:, ::-1], self.uvs[:, ::-1])
        return Shape(corners, self.uvs)

    def flip(self) -> Shape:
        """Return the shape with its triangles facing inward."""
        return Shape(self.corners[:, ::-1], self.uvs[:, ::-1])

    def scale_uv(self, scale_u: float, scale_v: float) -> Shape:
        """Return the shape with the texture repeated along u and v."""
        return Shape(self.corners, self.uvs * np.array([scale_u, scale_v]))

    def project_uv(self, metres: float) -> Shape:
        """Project the texture along each triangle's main direction, one image every ``metres``."""
        normal = np.abs(_face_normals(self.corners))
        axis = np.argmax(normal, axis=1)  # (m,)
        keep = np.array([[1, 2], [0, 2], [0, 1]])[axis]  # (m, 2) coordinates that remain
        uvs = np.take_along_axis(self.corners, keep[:, None, :].repeat(3, axis=1), axis=2)
        return Shape(self.corners, uvs / metres)

    @property
    def area(self) -> float:
        """The area of all triangles [m^2]."""
        return float(np.linalg.norm(_face_normals(self.corners), axis=1).sum() / 2.0)

    @property
    def volume(self) -> float:
        """The signed volume [m^3]; positive for a closed shape that faces outward."""
        a, b, c = self.corners[:, 0], self.corners[:, 1], self.corners[:, 2]
        return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)


def _face_normals(corners: Array) -> Array:
    """Return the normals of triangles, (m, 3), as long as twice the area."""
    normals: Array = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return normals


def join(*shapes: Shape) -> Shape:
    """Join shapes to one."""
    return Shape(
        np.concatenate([shape.corners for shape in shapes]),
        np.concatenate([shape.uvs for shape in shapes]),
    )


_MIX = np.array(
    [
        0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB, 0xD6E8FEB86659FD93,
        0xA0761D6478BD642F, 0xE7037ED1A0B428DB, 0x8EBC6AF09C88C6E3, 0x589965CC75374CC3,
    ],
    dtype=np.uint64,
)  # fmt: skip
"""The weights of a hash: odd numbers without pattern."""


def _groups(cells: Array) -> npt.NDArray[np.int64]:
    """Return a number for every row, equal where the rounded rows are equal."""
    integers = np.round(cells).astype(np.int64).view(np.uint64)
    keys = (integers * _MIX[: integers.shape[1]]).sum(axis=1, dtype=np.uint64)
    numbers: npt.NDArray[np.int64] = np.unique(keys, return_inverse=True)[1].ravel()
    return numbers


def _normals(corners: Array, crease: float) -> Array:
    """Return the normals at the corners, (3m, 3): mean of the faces that meet there, up to creases.

    The weight of a face is its area times its angle at the corner.
    """
    face = _face_normals(corners)
    unit = face / np.linalg.norm(face, axis=1, keepdims=True)
    sides = np.roll(corners, -1, axis=1) - corners  # (m, 3, 3) from each corner to the next
    sides /= np.linalg.norm(sides, axis=2, keepdims=True)
    cosine = -np.einsum("ijk,ijk->ij", sides, np.roll(sides, 1, axis=1))
    weighted_sums = face[:, None] * _angles(np.clip(cosine, -1.0, 1.0))[..., None]
    weighted_sums = weighted_sums.reshape(-1, 3)  # (3m, 3)
    point = _groups(corners.reshape(-1, 3) / _tolerance(corners))
    order = by_point = np.argsort(point, kind="stable")
    size = np.bincount(point)
    start = np.concatenate([[0], np.cumsum(size)[:-1]])
    # Pairs of corners that share a point: each corner beside every corner of its group. Points
    # where very many faces meet (fans of broken files) keep the faces' own normals.
    order = order[size[point[order]] <= 128]
    n_neighbours = size[point[order]]
    corner = np.repeat(order, n_neighbours)
    step = np.arange(len(corner)) - np.repeat(np.cumsum(n_neighbours) - n_neighbours, n_neighbours)
    neighbour = by_point[np.repeat(start[point[order]], n_neighbours) + step]
    is_smooth = np.einsum("ij,ij->i", unit[corner // 3], unit[neighbour // 3]) > math.cos(crease)
    corner, neighbour = corner[is_smooth], neighbour[is_smooth]
    total = np.stack(
        [
            np.bincount(corner, weights=weighted_sums[neighbour, k], minlength=len(point))
            for k in range(3)
        ],
        axis=1,
    )
    lengths = np.linalg.norm(total, axis=1, keepdims=True)
    normals: Array = np.where(lengths > 0.0, total / np.where(lengths > 0.0, lengths, 1.0),
                              np.repeat(unit, 3, axis=0))  # fmt: skip
    return normals


@njit
def _angles(cosines: Array) -> Array:
    """Return the angles of cosines (m, 3) [rad]; every scene with a mesh needs them."""
    angles = np.empty(cosines.shape)
    for row in range(cosines.shape[0]):
        for corner in range(cosines.shape[1]):
            angles[row, corner] = math.acos(cosines[row, corner])
    return angles


def _tolerance(corners: Array) -> float:
    """Return the distance below which points are one [m]: 1e-6 of the shape, at most 1 um."""
    return float(min(1e-6, max(np.ptp(corners.reshape(-1, 3), axis=0).max() * 1e-6, 1e-12)))


def mesh(
    *shapes: Shape,
    colour: tuple[float, float, float] = (1.0, 1.0, 1.0),
    texture: Texture | None = None,
    crease: float = CREASE,
    two_sided: bool = False,
) -> Mesh:
    """Convert shapes of one material to a mesh with shared vertices and unit normals."""
    shape = join(*shapes)
    areas = np.linalg.norm(_face_normals(shape.corners), axis=1)
    is_valid = areas > min(_tolerance(shape.corners) ** 2, 1e-9 * float(areas.max()))
    corners, uvs = shape.corners[is_valid], shape.uvs[is_valid].reshape(-1, 2)
    normals = _normals(corners, crease)
    points = corners.reshape(-1, 3)
    tolerances = np.array([_tolerance(corners)] * 3 + [1e-3] * 3 + [1e-5] * 2)
    groups = _groups(np.hstack([points, normals, uvs]) / tolerances)
    _, representatives = np.unique(groups, return_index=True)
    return Mesh(
        vertices=points[representatives].astype(np.float32),
        normals=normals[representatives].astype(np.float32),
        uvs=uvs[representatives].astype(np.float32),
        triangles=groups.reshape(-1, 3).astype(np.uint32),
        colour=colour,
        texture=texture,
        two_sided=two_sided,
    )


def surface(points: Array, uvs: Array | None = None) -> Shape:
    """Return a grid of points (k, n, 3) as triangles that face ``d/dn x d/dk``."""
    k, n = points.shape[:2]
    if uvs is None:
        v, u = np.meshgrid(np.linspace(0, 1, k), np.linspace(0, 1, n), indexing="ij")
        uvs = np.stack([u, v], axis=2)
    grid = np.concatenate([points, uvs], axis=2)  # (k, n, 5)
    a, b, c, d = grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]
    triangles = np.stack([np.stack([a, b, c], axis=2), np.stack([a, c, d], axis=2)], axis=2)
    corners = triangles.reshape(-1, 3, 5)
    has_area = np.linalg.norm(_face_normals(corners[:, :, :3]), axis=1) > 1e-12
    return Shape(corners[has_area, :, :3], corners[has_area, :, 3:])


def quad(
    a: Triple,
    b: Triple,
    c: Triple,
    d: Triple,
    *,
    uv: tuple[float, float, float, float] = (0.0, 0.0, 1.0, 1.0),
    cuts: tuple[int, int] = (1, 1),
) -> Shape:
    """A four-cornered face, counter-clockwise from bottom left; ``uv`` is (u0, v0, u1, v1).

    ``cuts`` has the numbers of its pieces along a-b and along a-d.
    """
    s, t = np.linspace(0, 1, cuts[0] + 1), np.linspace(0, 1, cuts[1] + 1)
    t_, s_ = (g[..., None] for g in np.meshgrid(t, s, indexing="ij"))
    pa, pb, pc, pd = (np.array(p) for p in (a, b, c, d))
    points = (1 - t_) * ((1 - s_) * pa + s_ * pb) + t_ * ((1 - s_) * pd + s_ * pc)
    u0, v0, u1, v1 = uv
    return surface(points, np.concatenate([u0 + s_ * (u1 - u0), v0 + t_ * (v1 - v0)], axis=2))


def box(lower: Triple, upper: Triple) -> Shape:
    """Return a box; every face shows the whole texture, upright on the sides."""
    (x0, y0, z0), (x1, y1, z1) = lower, upper
    return join(
        quad((x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)),  # -y
        quad((x1, y0, z0), (x1, y1, z0), (x1, y1, z1), (x1, y0, z1)),  # +x
        quad((x1, y1, z0), (x0, y1, z0), (x0, y1, z1), (x1, y1, z1)),  # +y
        quad((x0, y1, z0), (x0, y0, z0), (x0, y0, z1), (x0, y1, z1)),  # -x
        quad((x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)),  # +z
        quad((x0, y1, z0), (x1, y1, z0), (x1, y0, z0), (x0, y0, z0)),  # -z
    )


def lathe(profile: Sequence[tuple[float, float]] | Array, *, n: int = 24) -> Shape:
    """Rotate a profile of (radius, z) from bottom to top about z."""
    curve = np.asarray(profile, dtype=np.float64)
    angle = np.linspace(0, 2 * math.pi, n + 1)
    angle[-1] = 0.0
    radius, z = curve[:, :1], curve[:, 1:]
    points = np.stack(
        [radius * np.cos(angle), radius * np.sin(angle), np.broadcast_to(z, (len(z), n + 1))],
        axis=2,
    )
    distance = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
    v, u = np.meshgrid(distance / distance[-1], np.linspace(0, 1, n + 1), indexing="ij")
    return surface(points, np.stack([u, v], axis=2))


def sphere(radius: float, *, n: int = 24) -> Shape:
    """Return a sphere about the origin."""
    a = np.linspace(-math.pi / 2, math.pi / 2, max(3, n // 2) + 1)
    profile = radius * np.stack([np.cos(a), np.sin(a)], axis=1)
    profile[[0, -1], 0] = 0.0
    return lathe(profile, n=n)


def rotation_to(direction: Array) -> Array:
    """Return a rotation (3, 3) of z to ``direction`` (3,)."""
    z = np.asarray(direction, dtype=np.float64)
    z = z / length(z)
    helper = np.array([1.0, 0.0, 0.0]) if abs(z[0]) < 0.9 else np.array([0.0, 1.0, 0.0])
    y = np.cross(z, helper)
    y /= length(y)
    return np.stack([np.cross(y, z), y, z], axis=1)


def cylinder(
    start: Triple, end: Triple, radius: float, *, n: int = 20, bevel: float = 0.0, top: float = 1.0
) -> Shape:
    """Return a rod from ``start`` to ``end``, ``top`` times as thick at the end (0 is a cone)."""
    a, b = np.array(start), np.array(end)
    height, end_radius = length(b - a), radius * top
    if bevel > 0.0:
        sides = [
            (radius - bevel, 0.0),
            (radius, bevel),
            (end_radius, height - bevel),
            (end_radius - bevel, height),
        ]
    else:
        sides = [(radius, 0.0), (end_radius, height)]
    rod = lathe([(0.0, 0.0), *sides, (0.0, height)], n=n)
    return rod.rotate(rotation_to(b - a)).shift(*start)
