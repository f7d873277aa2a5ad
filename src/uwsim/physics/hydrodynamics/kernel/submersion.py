"""The submerged fraction of a shape, and the centre of its submerged part.

Results are exact for spheres, ellipsoids and boxes at any attitude, and for cylinders that are
upright or whose end discs do not cross the surface. For other cylinders they are computed by a
quadrature over 24 chords, with an error of about a thousandth. The water surface is a plane.
"""

from __future__ import annotations

import math

import numpy as np

from ....base.numerics.jit import njit_borrowed
from ....base.numerics.memory import Floats
from ..columns import BOX, CYLINDER, ELLIPSOID, SHRINKING_SPHERE, SPHERE

CHORDS = 24
"""The number of chords of the quadrature over a cylinder."""
MEMORY = 28
"""The length of the scratch memory of `compute_submersion`."""
_POINTS, _HEIGHTS, _PIECE = 9, 21, 25
_CORNERS = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) - 0.5
_PATHS = np.array([[1, 3], [1, 5], [2, 3], [2, 6], [4, 5], [4, 6]])
"""The two middle corners of each of six tetrahedra that form a box; the others are 0 and 7."""


@njit_borrowed
def compute_submersion(
    shape: float,
    a: float,
    b: float,
    c: float,
    up_x: float,
    up_y: float,
    up_z: float,
    depth: float,
    memory: Floats,
) -> tuple[float, float, float, float]:
    """Return the fraction of a shape's volume that is under water, and the centre of that part.

    Args:
        shape: the index of the shape; see `columns`.
        a: the radius of a sphere or cylinder, the first semi-axis of an ellipsoid, or the first
            edge of a box [m].
        b: the second semi-axis or edge, or the length of a cylinder, whose axis is z [m].
        c: the third semi-axis or edge [m].
        up_x: the x component of the upward unit normal of the surface, in the axes of the shape.
        up_y: its y component.
        up_z: its z component.
        depth: the depth of the shape's centre below the surface [m].
        memory: scratch memory, (`MEMORY`,).

    Returns:
        The fraction 0..1, and the centre of the submerged part relative to the shape's centre, in
        the axes of the shape [m].
    """
    size, up, centre = memory[:3], memory[3:6], memory[6:_POINTS]
    centre[0] = centre[1] = centre[2] = 0.0
    size[0], size[1], size[2] = a, b, c
    up[0], up[1], up[2] = up_x, up_y, up_z
    fraction = _fraction(shape, size, up, depth, centre, memory)
    return fraction, centre[0], centre[1], centre[2]


@njit_borrowed
def _fraction(
    shape: float, size: Floats, up: Floats, depth: float, centre: Floats, memory: Floats
) -> float:
    if shape == SPHERE:
        return _ball(size[0], size[0], size[0], up, depth, centre)
    if shape == ELLIPSOID:
        return _ball(size[0], size[1], size[2], up, depth, centre)
    if shape == SHRINKING_SPHERE:
        height: float = min(max(1.0 + min(depth, 0.0) / size[0], 0.0), 1.0)
        return height**3
    if shape == BOX:
        reach = 0.5 * (abs(size[0] * up[0]) + abs(size[1] * up[1]) + abs(size[2] * up[2]))
    else:
        tilt = math.sqrt(up[0] * up[0] + up[1] * up[1])
        reach = size[0] * tilt + 0.5 * size[1] * abs(up[2])
    if depth >= reach:
        return 1.0
    if depth <= -reach:
        return 0.0
    if shape == BOX:
        return _box(size, up, depth, centre, memory)
    if shape == CYLINDER:
        return _cylinder(size[0], size[1], up, depth, centre, memory[_PIECE:])
    return 1.0


@njit_borrowed
def _ball(a: float, b: float, c: float, up: Floats, depth: float, centre: Floats) -> float:
    """Return the fraction of an ellipsoid, which is a stretched unit sphere."""
    reach = math.sqrt((a * up[0]) ** 2 + (b * up[1]) ** 2 + (c * up[2]) ** 2)
    if reach <= 0.0 or depth >= reach:
        return 1.0
    if depth <= -reach:
        return 0.0
    h = 1.0 + depth / reach  # height of the cap of the unit sphere
    fraction: float = h * h * (3.0 - h) / 4.0
    # distance of the cap's centroid below the centre of the unit sphere
    down = 3.0 * (2.0 - h) ** 2 / (4.0 * (3.0 - h))
    centre[0] = -down * a * a * up[0] / reach
    centre[1] = -down * b * b * up[1] / reach
    centre[2] = -down * c * c * up[2] / reach
    return fraction


@njit_borrowed
def _box(size: Floats, up: Floats, depth: float, centre: Floats, memory: Floats) -> float:
    """Return the fraction of a box, from the submerged parts of six tetrahedra."""
    points = memory[_POINTS:_HEIGHTS]  # of a tetrahedron, (4, 3) by rows [m]
    heights = memory[_HEIGHTS:_PIECE]  # above the surface [m]
    total = size[0] * size[1] * size[2] / 6.0
    volume: float = 0.0
    for path in range(6):
        for i in range(4):
            corner = 0 if i == 0 else (7 if i == 3 else _PATHS[path, i - 1])
            for axis in range(3):
                points[3 * i + axis] = _CORNERS[corner, axis] * size[axis]
            heights[i] = (
                points[3 * i] * up[0]
                + points[3 * i + 1] * up[1]
                + points[3 * i + 2] * up[2]
                - depth
            )
        volume += _tetrahedron(points, heights, total, centre)
    if volume <= 0.0:
        return 0.0
    for axis in range(3):
        centre[axis] /= volume
    fraction: float = volume / (6.0 * total)
    return fraction


@njit_borrowed
def _tetrahedron(points: Floats, heights: Floats, total: float, moment: Floats) -> float:
    """Return the volume of a tetrahedron below the surface.

    Args:
        points: the corners, which are sorted by height, (4, 3) by rows, (12,) [m].
        heights: the heights of the corners above the surface, (4,) [m].
        total: the volume of the tetrahedron [m3].
        moment: the sum to which the submerged volume times its centroid is added, (3,) [m4].
    """
    for i in range(1, 4):  # sort, lowest first
        j = i
        while j > 0 and heights[j] < heights[j - 1]:
            heights[j], heights[j - 1] = heights[j - 1], heights[j]
            for axis in range(3):
                points[3 * j + axis], points[3 * j - 3 + axis] = (
                    points[3 * j - 3 + axis],
                    points[3 * j + axis],
                )
            j -= 1
    if heights[0] >= 0.0:
        return 0.0
    if heights[3] <= 0.0:
        for axis in range(3):
            mean = (points[axis] + points[3 + axis] + points[6 + axis] + points[9 + axis]) / 4.0
            moment[axis] += total * mean
        return total
    if heights[1] >= 0.0:  # one corner in the water
        return _tip(points, heights, 0, total, moment)
    if heights[2] < 0.0:  # one corner out of the water
        for axis in range(3):
            mean = (points[axis] + points[3 + axis] + points[6 + axis] + points[9 + axis]) / 4.0
            moment[axis] += total * mean
        rest: float = total - _tip(points, heights, 3, -total, moment)
        return rest
    # two in, two out: a wedge of three tetrahedra, cut along its edges at shares of the total
    a = heights[0] / (heights[0] - heights[2])
    b = heights[0] / (heights[0] - heights[3])
    c = heights[1] / (heights[1] - heights[2])
    d = heights[1] / (heights[1] - heights[3])
    v1 = a * b * total
    v2 = (1.0 - a) * b * c * total
    v3 = (1.0 - b) * c * d * total
    for axis in range(3):
        p, q = points[axis], points[3 + axis]
        ac = p + a * (points[6 + axis] - p)
        ad = p + b * (points[9 + axis] - p)
        bc = q + c * (points[6 + axis] - q)
        bd = q + d * (points[9 + axis] - q)
        moment[axis] += v1 * (p + ac + ad + q) / 4.0
        moment[axis] += v2 * (ac + ad + q + bc) / 4.0
        moment[axis] += v3 * (ad + q + bc + bd) / 4.0
    wedge: float = v1 + v2 + v3
    return wedge


@njit_borrowed
def _tip(points: Floats, heights: Floats, corner: int, total: float, moment: Floats) -> float:
    """Return the positive volume of the corner that the surface cuts off a tetrahedron.

    With a negative ``total``, the corner is subtracted from ``moment``; see `_tetrahedron`.
    """
    share = 1.0
    for i in range(4):
        if i != corner:
            share *= heights[corner] / (heights[corner] - heights[i])
    volume: float = share * total
    for axis in range(3):
        moment_arm = 4.0 * points[3 * corner + axis]
        for i in range(4):
            if i != corner:
                cut = heights[corner] / (heights[corner] - heights[i])
                moment_arm += cut * (points[3 * i + axis] - points[3 * corner + axis])
        moment[axis] += volume * moment_arm / 4.0
    return abs(volume)


@njit_borrowed
def _cylinder(
    radius: float, length: float, up: Floats, depth: float, centre: Floats, piece: Floats
) -> float:
    """Return the fraction of a cylinder, by a quadrature over rectangles parallel to its axis."""
    tilt = math.sqrt(up[0] * up[0] + up[1] * up[1])
    x, y = (up[0] / tilt, up[1] / tilt) if tilt > 1e-12 else (1.0, 0.0)
    volume, x_moment, z_moment = 0.0, 0.0, 0.0
    for i in range(CHORDS):
        angle = math.pi * (i + 1) / (CHORDS + 1)
        half = radius * math.sin(angle)
        _rectangle(half, 0.5 * length, tilt, up[2], depth, piece)
        weight = math.sin(angle)
        volume += weight * piece[0]
        x_moment += weight * piece[1]
        z_moment += weight * piece[2]
    if volume <= 0.0:
        return 0.0
    centre[0] = x * x_moment / volume
    centre[1] = y * x_moment / volume
    centre[2] = z_moment / volume
    # divided by the volume of the whole cylinder by the same quadrature
    return volume / (length * radius * (CHORDS + 1))


@njit_borrowed
def _rectangle(a: float, b: float, up_x: float, up_z: float, depth: float, piece: Floats) -> None:
    """Compute the submerged part of the rectangle [-a, a] x [-b, b], where up . p <= depth.

    Its area and its first moments along x and z are written into ``piece``, (3,).
    """
    piece[0] = piece[1] = piece[2] = 0.0
    px, pz, ph = -a, -b, -a * up_x - b * up_z - depth
    for i in range(1, 5):
        qx = a if i in (1, 2) else -a
        qz = b if i in (2, 3) else -b
        qh = qx * up_x + qz * up_z - depth
        if ph <= 0.0 or qh <= 0.0:
            sx, sz, ex, ez = px, pz, qx, qz
            if ph > 0.0:
                share = ph / (ph - qh)
                sx, sz = px + share * (qx - px), pz + share * (qz - pz)
            if qh > 0.0:
                share = ph / (ph - qh)
                ex, ez = px + share * (qx - px), pz + share * (qz - pz)
            _edge(sx, sz, ex, ez, piece)
        px, pz, ph = qx, qz, qh
    # close the outline along the waterline, from where it leaves the water to where it enters it
    _waterline(a, b, up_x, up_z, depth, piece)
    piece[1] /= 3.0
    piece[2] /= 3.0


@njit_borrowed
def _edge(sx: float, sz: float, ex: float, ez: float, piece: Floats) -> None:
    """Add the area, and three times the first moments, of one edge by Green's theorem."""
    triangle_area = 0.5 * (sx * ez - ex * sz)
    piece[0] += triangle_area
    piece[1] += triangle_area * (sx + ex)
    piece[2] += triangle_area * (sz + ez)


@njit_borrowed
def _waterline(a: float, b: float, up_x: float, up_z: float, depth: float, piece: Floats) -> None:
    """Add the edge along the waterline, if the surface crosses the rectangle."""
    leave_x, leave_z, back_x, back_z, n_crossings = 0.0, 0.0, 0.0, 0.0, 0
    px, pz, ph = -a, -b, -a * up_x - b * up_z - depth
    for i in range(1, 5):
        qx = a if i in (1, 2) else -a
        qz = b if i in (2, 3) else -b
        qh = qx * up_x + qz * up_z - depth
        if (ph <= 0.0) != (qh <= 0.0):
            share = ph / (ph - qh)
            x, z = px + share * (qx - px), pz + share * (qz - pz)
            if ph <= 0.0:
                leave_x, leave_z = x, z
            else:
                back_x, back_z = x, z
            n_crossings += 1
        px, pz, ph = qx, qz, qh
    if n_crossings == 2:
        _edge(leave_x, leave_z, back_x, back_z, piece)
