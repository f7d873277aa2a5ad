"""Inertias of one body, from its own axes to those of the world, on plain numbers and arrays.

Names and conventions are those of `equations`. An inertia here may also be what a drag that is
implicit over a step adds to it.
"""

from __future__ import annotations

from ....base.numerics.jit import njit
from ....base.numerics.memory import Floats
from ..columns import ADDED
from .equations import Six, Three

LITTLE = 0.01
"""Implicit drag below this share of the added mass counts as inertia in gyroscopic terms, too."""


@njit
def diagonal_inertia(table: Floats, slope: Six, wet: float, step: float) -> tuple[Six, Six]:
    """Added mass + step times the slope of the drag, of which a part is wet; then the latter."""
    h = wet * step
    a, b, c = h * slope[0], h * slope[1], h * slope[2]
    d, e, f = h * slope[3], h * slope[4], h * slope[5]
    return (
        wet * table[ADDED] + a, wet * table[ADDED + 7] + b, wet * table[ADDED + 14] + c,
        wet * table[ADDED + 21] + d, wet * table[ADDED + 28] + e, wet * table[ADDED + 35] + f,
    ), (a, b, c, d, e, f)  # fmt: skip


@njit
def is_felt(inertia: Six, drag: Six) -> bool:
    """Whether implicit drag is more than `LITTLE` of an inertia about or along any axis."""
    return (
        drag[0] > LITTLE * inertia[0]
        or drag[1] > LITTLE * inertia[1]
        or drag[2] > LITTLE * inertia[2]
        or drag[3] > LITTLE * inertia[3]
        or drag[4] > LITTLE * inertia[4]
        or drag[5] > LITTLE * inertia[5]
    )


@njit
def is_drag_left(table: Floats, work: Floats, full: int) -> bool:
    """Take the added mass off a full inertia (6, 6), in ``work``; whether the rest is felt."""
    felt = False
    for i in range(36):
        work[full + i] -= table[ADDED + i]
    for i in range(0, 36, 7):
        drag = work[full + i]
        felt = felt or drag > LITTLE * (table[ADDED + i] + drag)
    return felt


@njit
def add_diagonal_inertia(axes: Floats, lever: Three, inertia: Six, out: Floats, to: int) -> None:
    """Add a diagonal inertia at the origin of the sums, in world axes.

    Args:
        axes: world_from_body.
        lever: of the reference point.
        inertia: the diagonal.
        out: gets, from
        to: on, 21 numbers: force by velocity, symmetric (xx xy xz yy yz zz), force by rotation
            (3, 3), row by row, torque by rotation, symmetric.
    """
    rx, ry, rz = lever
    r00, r01, r02 = axes[0], axes[1], axes[2]
    r10, r11, r12 = axes[3], axes[4], axes[5]
    r20, r21, r22 = axes[6], axes[7], axes[8]
    a, b, c, d, e, f = inertia
    xx = a * (r00 * r00) + b * (r01 * r01) + c * (r02 * r02)
    xy = a * (r00 * r10) + b * (r01 * r11) + c * (r02 * r12)
    xz = a * (r00 * r20) + b * (r01 * r21) + c * (r02 * r22)
    yy = a * (r10 * r10) + b * (r11 * r11) + c * (r12 * r12)
    yz = a * (r10 * r20) + b * (r11 * r21) + c * (r12 * r22)
    zz = a * (r20 * r20) + b * (r21 * r21) + c * (r22 * r22)
    f0, f1, f2 = xz * ry - xy * rz, xx * rz - xz * rx, xy * rx - xx * ry
    f3, f4, f5 = yz * ry - yy * rz, xy * rz - yz * rx, yy * rx - xy * ry
    f6, f7, f8 = zz * ry - yz * rz, xz * rz - zz * rx, yz * rx - xz * ry
    out[to] += xx
    out[to + 1] += xy
    out[to + 2] += xz
    out[to + 3] += yy
    out[to + 4] += yz
    out[to + 5] += zz
    out[to + 6] += f0
    out[to + 7] += f1
    out[to + 8] += f2
    out[to + 9] += f3
    out[to + 10] += f4
    out[to + 11] += f5
    out[to + 12] += f6
    out[to + 13] += f7
    out[to + 14] += f8
    xx = d * (r00 * r00) + e * (r01 * r01) + f * (r02 * r02)
    xy = d * (r00 * r10) + e * (r01 * r11) + f * (r02 * r12)
    xz = d * (r00 * r20) + e * (r01 * r21) + f * (r02 * r22)
    yy = d * (r10 * r10) + e * (r11 * r11) + f * (r12 * r12)
    yz = d * (r10 * r20) + e * (r11 * r21) + f * (r12 * r22)
    zz = d * (r20 * r20) + e * (r21 * r21) + f * (r22 * r22)
    out[to + 15] += xx + ry * f6 - rz * f3
    out[to + 16] += xy + ry * f7 - rz * f4
    out[to + 17] += xz + ry * f8 - rz * f5
    out[to + 18] += yy + rz * f1 - rx * f7
    out[to + 19] += yz + rz * f2 - rx * f8
    out[to + 20] += zz + rx * f5 - ry * f2


@njit
def _turn(axes: Floats, work: Floats, block: int, to: int) -> None:
    """One 3x3 block, at ``block`` in rows of 6, into world axes: R B R^T, in rows of 3."""
    for j in range(3):
        x, y, z = axes[3 * j], axes[3 * j + 1], axes[3 * j + 2]
        a = work[block] * x + work[block + 1] * y + work[block + 2] * z
        b = work[block + 6] * x + work[block + 7] * y + work[block + 8] * z
        c = work[block + 12] * x + work[block + 13] * y + work[block + 14] * z
        work[to + j] = axes[0] * a + axes[1] * b + axes[2] * c
        work[to + 3 + j] = axes[3] * a + axes[4] * b + axes[5] * c
        work[to + 6 + j] = axes[6] * a + axes[7] * b + axes[8] * c


@njit
def add_full_inertia(
    axes: Floats, lever: Three, wet: float, out: Floats, full: int, to: int
) -> None:
    """The same with a full one (6, 6), which lies in ``out`` from ``full`` on; 9 more follow."""
    rx, ry, rz = lever
    at = full + 36
    _turn(axes, out, full, at)
    xx, xy, xz = wet * out[at], wet * out[at + 1], wet * out[at + 2]
    yy, yz, zz = wet * out[at + 4], wet * out[at + 5], wet * out[at + 8]
    out[to] += xx
    out[to + 1] += xy
    out[to + 2] += xz
    out[to + 3] += yy
    out[to + 4] += yz
    out[to + 5] += zz
    # force by rotation: B12 - B11 S(r)
    _turn(axes, out, full + 3, at)
    a, b, c = wet * out[at], wet * out[at + 1], wet * out[at + 2]
    d, e, f = wet * out[at + 3], wet * out[at + 4], wet * out[at + 5]
    g, h, i = wet * out[at + 6], wet * out[at + 7], wet * out[at + 8]
    f0, f1, f2 = a - xy * rz + xz * ry, b - xz * rx + xx * rz, c - xx * ry + xy * rx
    f3, f4, f5 = d - yy * rz + yz * ry, e - yz * rx + xy * rz, f - xy * ry + yy * rx
    f6, f7, f8 = g - yz * rz + zz * ry, h - zz * rx + xz * rz, i - xz * ry + yz * rx
    out[to + 6] += f0
    out[to + 7] += f1
    out[to + 8] += f2
    out[to + 9] += f3
    out[to + 10] += f4
    out[to + 11] += f5
    out[to + 12] += f6
    out[to + 13] += f7
    out[to + 14] += f8
    # torque by rotation: B22 + S(r) (force by rotation) - B12^T S(r)
    _turn(axes, out, full + 21, at)
    out[to + 15] += wet * out[at] + ry * f6 - rz * f3 - (d * rz - g * ry)
    out[to + 16] += wet * out[at + 1] + ry * f7 - rz * f4 - (g * rx - a * rz)
    out[to + 17] += wet * out[at + 2] + ry * f8 - rz * f5 - (a * ry - d * rx)
    out[to + 18] += wet * out[at + 4] + rz * f1 - rx * f7 - (h * rx - b * rz)
    out[to + 19] += wet * out[at + 5] + rz * f2 - rx * f8 - (b * ry - e * rx)
    out[to + 20] += wet * out[at + 8] + rx * f5 - ry * f2 - (c * ry - f * rx)
