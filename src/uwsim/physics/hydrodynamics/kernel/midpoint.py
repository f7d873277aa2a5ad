r"""The Coriolis forces of a free body by the implicit midpoint rule, which conserves energy.

MuJoCo evaluates Coriolis forces, and the orientation of the added mass, at the start of a step: a
light slender body, or a tumbling body, would gain energy in every step. Here they are evaluated by
the implicit midpoint rule in body axes. With the twist :math:`\nu` of the body, its inertia
:math:`A` (rigid and added), its momentum :math:`p` and the rate :math:`\delta` of :math:`\nu` over
a step of length h,

.. math:: S\delta + \tfrac h2\bigl(\delta\times^*(p + \tfrac h2 A\delta) + \nu\times^* A\delta\bigr)
          = G

where :math:`S` is :math:`A` plus the drag that is implicit over the step, :math:`G = S\dot\nu` at
the start of the step, and :math:`\times^*` the cross product of a twist and a momentum. Implicit
drag is not part of the momentum: it would make a needle spin about its axis. Without other forces,
the rule conserves the energy, the length of the linear momentum, and the scalar product of linear
and angular momentum; without added mass, the length of the angular momentum, too (Hairer, Lubich,
Wanner, *Geometric Numerical Integration*, 2006, IV.2). The joints of the body count as fixed.
Twists, momenta and wrenches have the rotational part first, as in MuJoCo.
"""

from __future__ import annotations

import math

from ....base.numerics.jit import njit_borrowed
from ....base.numerics.memory import Floats

INERTIA, TWIST, MOMENTUM, FORCE, RATE, SUM = 0, 36, 42, 48, 54, 60
"""The indices in the array b of one body: A (6, 6), nu, p, G, the solution delta, S (6, 6)."""
_IMAGE, _BASIS, _MATRIX, CORRECTION = 96, 102, 108, 144
"""The indices of scratch: A delta, p + h/2 A delta, the matrix (6, 6), the residual or correction.
"""
NUMBERS = 150
"""The length of the array b of one body."""
_ROUNDS, _BOUND_ROUNDS = 16, 8
"""The largest number of iterations of `solve_rate`, and the number of iterations of `_bound_rate`.
"""
_TOLERANCE, _MAX_ERROR, _SLOW_RATIO = 1e-14, 1e-12, 1e-4
"""Limits of the energy of a correction: relative to the energy of the rate, at which the iteration
ends, and at which its result is valid; and relative to the energy of the last correction, above
which the matrix is computed again."""


@njit_borrowed
def solve_rate(b: Floats, h: float) -> None:
    """Solve for the rate over a step h [s] by Newton's method.

    The matrix is that of the first iteration as long as the iteration converges fast.
    """
    for i in range(6):
        b[RATE + i] = 0.0
        b[_IMAGE + i] = 0.0
        b[CORRECTION + i] = b[FORCE + i]
    _jacobian(b, h)
    _factorise(b)
    last_correction, correction, energy = math.inf, 0.0, 0.0
    for _ in range(_ROUNDS):
        correction = _solve_lower(b)
        _solve_upper(b)
        for i in range(6):
            b[RATE + i] += b[CORRECTION + i]
        if correction <= _TOLERANCE * energy:
            return
        multiply(b, INERTIA, RATE, _IMAGE)
        multiply(b, SUM, RATE, CORRECTION)
        energy = 0.0
        for i in range(6):
            energy += b[RATE + i] * b[CORRECTION + i]
        if correction > _SLOW_RATIO * last_correction:
            _jacobian(b, h)
            _factorise(b)
        _residual(b, h)
        last_correction = correction
    if not correction <= _MAX_ERROR * energy:
        _bound_rate(b, h)


@njit_borrowed
def _bound_rate(b: Floats, h: float) -> None:
    r"""Find a rate without a gain of energy, if Newton's method does not converge.

    The motion of a body that rotates by more than a radian in a step is inaccurate in any case, but
    must not gain energy. With the momentum :math:`p + \tfrac h2 A\delta` of the last iteration the
    equation is linear, and the cross product does no work on the twist
    :math:`\nu + \tfrac h2\delta`.
    """
    for i in range(6):
        b[_IMAGE + i] = 0.0
    for _ in range(_BOUND_ROUNDS):
        for i in range(36):
            b[_MATRIX + i] = b[SUM + i]
        _add_rate_derivative(b, 0.5 * h)
        _factorise(b)
        for i in range(6):
            b[CORRECTION + i] = b[FORCE + i]
        cross(b, TWIST, _IMAGE, CORRECTION, -0.5 * h)
        substitute(b)
        for i in range(6):
            b[RATE + i] = b[CORRECTION + i]
        multiply(b, INERTIA, RATE, _IMAGE)


@njit_borrowed
def multiply(b: Floats, matrix: int, vector: int, k: int) -> None:
    """Write the product of the symmetric matrix (6, 6) at ``matrix`` and a vector (6,) to ``k``."""
    t0, t1, t2, t3, t4, t5 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(6):
        x, row = b[vector + j], matrix + 6 * j
        t0 += b[row] * x
        t1 += b[row + 1] * x
        t2 += b[row + 2] * x
        t3 += b[row + 3] * x
        t4 += b[row + 4] * x
        t5 += b[row + 5] * x
    b[k], b[k + 1], b[k + 2], b[k + 3], b[k + 4], b[k + 5] = t0, t1, t2, t3, t4, t5


@njit_borrowed
def cross(b: Floats, twist: int, momentum: int, k: int, share: float) -> None:
    """Add ``share`` times the cross product of a twist and a momentum to the wrench at ``k``."""
    wx, wy, wz, vx, vy, vz = (
        b[twist], b[twist + 1], b[twist + 2], b[twist + 3], b[twist + 4], b[twist + 5]
    )  # fmt: skip
    hx, hy, hz, px, py, pz = (
        b[momentum], b[momentum + 1], b[momentum + 2],
        b[momentum + 3], b[momentum + 4], b[momentum + 5],
    )  # fmt: skip
    b[k] += share * (wy * hz - wz * hy + vy * pz - vz * py)
    b[k + 1] += share * (wz * hx - wx * hz + vz * px - vx * pz)
    b[k + 2] += share * (wx * hy - wy * hx + vx * py - vy * px)
    b[k + 3] += share * (wy * pz - wz * py)
    b[k + 4] += share * (wz * px - wx * pz)
    b[k + 5] += share * (wx * py - wy * px)


@njit_borrowed
def _residual(b: Floats, h: float) -> None:
    """Replace S delta at ``CORRECTION`` by the residual of the equation."""
    for i in range(6):
        b[CORRECTION + i] = b[FORCE + i] - b[CORRECTION + i]
        b[_BASIS + i] = b[MOMENTUM + i] + 0.5 * h * b[_IMAGE + i]
    cross(b, RATE, _BASIS, CORRECTION, -0.5 * h)
    cross(b, TWIST, _IMAGE, CORRECTION, -0.5 * h)


@njit_borrowed
def _jacobian(b: Floats, h: float) -> None:
    """Write the negative derivative of the residual with respect to the rate to ``_MATRIX``.

    The matrix is stored row by row.
    """
    g = 0.5 * h
    wx, wy, wz = g * b[TWIST], g * b[TWIST + 1], g * b[TWIST + 2]
    vx, vy, vz = g * b[TWIST + 3], g * b[TWIST + 4], g * b[TWIST + 5]
    wx, wy, wz = wx + g * g * b[RATE], wy + g * g * b[RATE + 1], wz + g * g * b[RATE + 2]
    vx, vy, vz = vx + g * g * b[RATE + 3], vy + g * g * b[RATE + 4], vz + g * g * b[RATE + 5]
    for j in range(6):
        a0, a1, a2 = b[INERTIA + j], b[INERTIA + 6 + j], b[INERTIA + 12 + j]
        a3, a4, a5 = b[INERTIA + 18 + j], b[INERTIA + 24 + j], b[INERTIA + 30 + j]
        b[_MATRIX + j] = b[SUM + j] + wy * a2 - wz * a1 + vy * a5 - vz * a4
        b[_MATRIX + 6 + j] = b[SUM + 6 + j] + wz * a0 - wx * a2 + vz * a3 - vx * a5
        b[_MATRIX + 12 + j] = b[SUM + 12 + j] + wx * a1 - wy * a0 + vx * a4 - vy * a3
        b[_MATRIX + 18 + j] = b[SUM + 18 + j] + wy * a5 - wz * a4
        b[_MATRIX + 24 + j] = b[SUM + 24 + j] + wz * a3 - wx * a5
        b[_MATRIX + 30 + j] = b[SUM + 30 + j] + wx * a4 - wy * a3
    _add_rate_derivative(b, g)


@njit_borrowed
def _add_rate_derivative(b: Floats, g: float) -> None:
    """Add g times the derivative of rate x* P with respect to the rate to ``_MATRIX``; g = h/2.

    P is the momentum at the midpoint, p + h/2 A delta, which counts as constant.
    """
    for block, part in ((0, 0), (3, 3), (18, 3)):
        _subtract_skew(
            b, _MATRIX + block,
            g * (b[MOMENTUM + part] + g * b[_IMAGE + part]),
            g * (b[MOMENTUM + part + 1] + g * b[_IMAGE + part + 1]),
            g * (b[MOMENTUM + part + 2] + g * b[_IMAGE + part + 2]),
        )  # fmt: skip


@njit_borrowed
def _subtract_skew(b: Floats, k: int, x: float, y: float, z: float) -> None:
    """Subtract the skew-symmetric matrix of (x, y, z) from a block (3, 3) at k in rows of 6."""
    b[k + 1] += z
    b[k + 2] -= y
    b[k + 6] -= z
    b[k + 8] += x
    b[k + 12] += y
    b[k + 13] -= x


@njit_borrowed
def _factorise(b: Floats) -> None:
    """Replace ``_MATRIX`` by its LU factors in place, with the inverse pivots on the diagonal.

    No pivoting is needed: the matrix is S, which is positive definite, plus terms that are
    skew-symmetric or small, so that no pivot vanishes.
    """
    for k in range(6):
        row = _MATRIX + 6 * k
        inverse = 1.0 / b[row + k]
        for i in range(k + 1, 6):
            other = _MATRIX + 6 * i
            share = b[other + k] * inverse
            b[other + k] = share
            for j in range(k + 1, 6):
                b[other + j] -= share * b[row + j]
        b[row + k] = inverse


@njit_borrowed
def substitute(b: Floats) -> None:
    """Solve the linear equations with the factors in ``_MATRIX`` for ``CORRECTION``, in place."""
    _solve_lower(b)
    _solve_upper(b)


@njit_borrowed
def _solve_lower(b: Floats) -> float:
    """Solve with the factor L; return an estimate of twice the kinetic energy of the solution."""
    energy = 0.0
    for i in range(6):
        row = _MATRIX + 6 * i
        total = b[CORRECTION + i]
        for j in range(i):
            total -= b[row + j] * b[CORRECTION + j]
        b[CORRECTION + i] = total
        energy += total * total * abs(b[row + i])
    return energy


@njit_borrowed
def _solve_upper(b: Floats) -> None:
    for i in range(5, -1, -1):
        row = _MATRIX + 6 * i
        total = b[CORRECTION + i]
        for j in range(i + 1, 6):
            total -= b[row + j] * b[CORRECTION + j]
        b[CORRECTION + i] = total * b[row + i]


@njit_borrowed
def rotation_rate(
    wx: float,
    wy: float,
    wz: float,
    x: float,
    y: float,
    z: float,
    h: float,
) -> tuple[float, float, float]:
    r"""Return the mean rate of change of a vector that rotates for a time h [s].

    .. math:: (e^{h[\omega]_\times} - 1)\,x / h

    with the vector (x, y, z) and the angular velocity :math:`\omega` = (wx, wy, wz) [rad/s].
    """
    angle2 = h * h * (wx * wx + wy * wy + wz * wz)
    c1, c2 = 1.0 - angle2 / 6.0, 0.5 * h
    if angle2 > 1e-8:
        angle = math.sqrt(angle2)
        c1, c2 = math.sin(angle) / angle, h * (1.0 - math.cos(angle)) / angle2
    cx, cy, cz = wy * z - wz * y, wz * x - wx * z, wx * y - wy * x
    return (
        c1 * cx + c2 * (wy * cz - wz * cy),
        c1 * cy + c2 * (wz * cx - wx * cz),
        c1 * cz + c2 * (wx * cy - wy * cx),
    )
