"""The transformation of inertias of the water from body axes to world axes, on plain numbers.

Names and conventions are those of `equations`. An inertia here is an added mass, to which drag that
is implicit over a step (step times slope of the drag) may be added.
"""

from __future__ import annotations

from ....base.numerics.jit import njit_borrowed
from ....base.numerics.memory import Floats
from ..columns import M_A
from .equations import Six, Three

MAX_DRAG_SHARE = 0.01
"""The fraction of an inertia up to which implicit drag also counts as inertia in gyroscopic
terms."""


@njit_borrowed
def diagonal_inertia(table: Floats, slope: Six, p: float, step: float) -> tuple[Six, Six]:
    """Return the diagonal inertia with implicit drag, and the implicit drag alone.

    Args:
        table: the row of the body.
        slope: the slopes of `equations.drag_slopes`.
        p: the submerged fraction, which scales both.
        step: the step over which drag is implicit [s].
    """
    h = p * step
    a, b, c = h * slope[0], h * slope[1], h * slope[2]
    d, e, f = h * slope[3], h * slope[4], h * slope[5]
    return (
        p * table[M_A] + a, p * table[M_A + 7] + b, p * table[M_A + 14] + c,
        p * table[M_A + 21] + d, p * table[M_A + 28] + e, p * table[M_A + 35] + f,
    ), (a, b, c, d, e, f)  # fmt: skip


@njit_borrowed
def is_significant(inertia: Six, drag: Six) -> bool:
    """Return whether implicit drag exceeds `MAX_DRAG_SHARE` of the inertia of any axis."""
    return (
        drag[0] > MAX_DRAG_SHARE * inertia[0]
        or drag[1] > MAX_DRAG_SHARE * inertia[1]
        or drag[2] > MAX_DRAG_SHARE * inertia[2]
        or drag[3] > MAX_DRAG_SHARE * inertia[3]
        or drag[4] > MAX_DRAG_SHARE * inertia[4]
        or drag[5] > MAX_DRAG_SHARE * inertia[5]
    )


@njit_borrowed
def subtract_added_mass(table: Floats, work: Floats, start: int) -> bool:
    """Subtract the added mass from a full inertia (6, 6); return if the drag is significant."""
    has_drag = False
    for i in range(36):
        work[start + i] -= table[M_A + i]
    for i in range(0, 36, 7):
        drag = work[start + i]
        has_drag = has_drag or drag > MAX_DRAG_SHARE * (table[M_A + i] + drag)
    return has_drag


@njit_borrowed
def add_diagonal_inertia(axes: Floats, lever: Three, inertia: Six, out: Floats, k: int) -> None:
    """Transform a diagonal inertia to world axes and the centre of mass of the tree, and add it.

    Args:
        axes: ``world_from_body``.
        lever: the lever to the reference point.
        inertia: the diagonal of the inertia in body axes.
        out: the array to which the blocks FF, FT and TT (`fields`) are added.
        k: the index of their first element.
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
    out[k] += xx
    out[k + 1] += xy
    out[k + 2] += xz
    out[k + 3] += yy
    out[k + 4] += yz
    out[k + 5] += zz
    out[k + 6] += f0
    out[k + 7] += f1
    out[k + 8] += f2
    out[k + 9] += f3
    out[k + 10] += f4
    out[k + 11] += f5
    out[k + 12] += f6
    out[k + 13] += f7
    out[k + 14] += f8
    xx = d * (r00 * r00) + e * (r01 * r01) + f * (r02 * r02)
    xy = d * (r00 * r10) + e * (r01 * r11) + f * (r02 * r12)
    xz = d * (r00 * r20) + e * (r01 * r21) + f * (r02 * r22)
    yy = d * (r10 * r10) + e * (r11 * r11) + f * (r12 * r12)
    yz = d * (r10 * r20) + e * (r11 * r21) + f * (r12 * r22)
    zz = d * (r20 * r20) + e * (r21 * r21) + f * (r22 * r22)
    out[k + 15] += xx + ry * f6 - rz * f3
    out[k + 16] += xy + ry * f7 - rz * f4
    out[k + 17] += xz + ry * f8 - rz * f5
    out[k + 18] += yy + rz * f1 - rx * f7
    out[k + 19] += yz + rz * f2 - rx * f8
    out[k + 20] += zz + rx * f5 - ry * f2


@njit_borrowed
def _rotate_block(axes: Floats, work: Floats, block: int, k: int) -> None:
    """Rotate a block (3, 3) of a matrix (6, 6) to world axes, R B R^T.

    Args:
        axes: ``world_from_body``, R.
        work: the array with the matrix, and with the result.
        block: the index of the first element of the block B.
        k: the index of the first element of the result, (3, 3) by rows.
    """
    for j in range(3):
        x, y, z = axes[3 * j], axes[3 * j + 1], axes[3 * j + 2]
        a = work[block] * x + work[block + 1] * y + work[block + 2] * z
        b = work[block + 6] * x + work[block + 7] * y + work[block + 8] * z
        c = work[block + 12] * x + work[block + 13] * y + work[block + 14] * z
        work[k + j] = axes[0] * a + axes[1] * b + axes[2] * c
        work[k + 3 + j] = axes[3] * a + axes[4] * b + axes[5] * c
        work[k + 6 + j] = axes[6] * a + axes[7] * b + axes[8] * c


@njit_borrowed
def add_full_inertia(axes: Floats, lever: Three, p: float, out: Floats, start: int, k: int) -> None:
    """Transform a full inertia to world axes and the centre of mass of the tree, and add it.

    Args:
        axes: ``world_from_body``.
        lever: the lever to the reference point.
        p: the submerged fraction, which scales the inertia.
        out: the array with the inertia, and with the blocks to which it is added.
        start: the index of the inertia (6, 6), followed by 9 elements of scratch memory.
        k: the index of the blocks FF, FT and TT (`fields`).
    """
    rx, ry, rz = lever
    block = start + 36
    _rotate_block(axes, out, start, block)
    xx, xy, xz = p * out[block], p * out[block + 1], p * out[block + 2]
    yy, yz, zz = p * out[block + 4], p * out[block + 5], p * out[block + 8]
    out[k] += xx
    out[k + 1] += xy
    out[k + 2] += xz
    out[k + 3] += yy
    out[k + 4] += yz
    out[k + 5] += zz
    # force by rotation: B12 - B11 S(r)
    _rotate_block(axes, out, start + 3, block)
    a, b, c = p * out[block], p * out[block + 1], p * out[block + 2]
    d, e, f = p * out[block + 3], p * out[block + 4], p * out[block + 5]
    g, h, i = p * out[block + 6], p * out[block + 7], p * out[block + 8]
    f0, f1, f2 = a - xy * rz + xz * ry, b - xz * rx + xx * rz, c - xx * ry + xy * rx
    f3, f4, f5 = d - yy * rz + yz * ry, e - yz * rx + xy * rz, f - xy * ry + yy * rx
    f6, f7, f8 = g - yz * rz + zz * ry, h - zz * rx + xz * rz, i - xz * ry + yz * rx
    out[k + 6] += f0
    out[k + 7] += f1
    out[k + 8] += f2
    out[k + 9] += f3
    out[k + 10] += f4
    out[k + 11] += f5
    out[k + 12] += f6
    out[k + 13] += f7
    out[k + 14] += f8
    # torque by rotation: B22 + S(r) (force by rotation) - B12^T S(r)
    _rotate_block(axes, out, start + 21, block)
    out[k + 15] += p * out[block] + ry * f6 - rz * f3 - (d * rz - g * ry)
    out[k + 16] += p * out[block + 1] + ry * f7 - rz * f4 - (g * rx - a * rz)
    out[k + 17] += p * out[block + 2] + ry * f8 - rz * f5 - (a * ry - d * rx)
    out[k + 18] += p * out[block + 4] + rz * f1 - rx * f7 - (h * rx - b * rz)
    out[k + 19] += p * out[block + 5] + rz * f2 - rx * f8 - (b * ry - e * rx)
    out[k + 20] += p * out[block + 8] + rx * f5 - ry * f2 - (c * ry - f * rx)
