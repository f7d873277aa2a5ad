r"""Passivity of drag: whether it takes energy from a body in every motion.

Drag :math:`D\nu` of a body that moves with :math:`\nu` takes the power :math:`\nu^T D \nu` from it,
quadratic drag the power

.. math:: P(\nu) = \sum_{ij} \nu_i\, Q_{ij}\, |\nu_j|\, \nu_j .

A body can lose energy to still water but never gain any, so neither may be below 0 at any
:math:`\nu` (Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control, 2011, property 6.2:
:math:`D(\nu) > 0`). For linear drag that is a symmetric part which is positive semi-definite. For
quadratic drag it is another condition, neither weaker nor stronger: P is of the third degree, and
its least value on the unit sphere is searched for, from many starts downhill.
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from ...base.geometry import Array
from ...base.rng import stream

TOLERANCE = 1e-6
"""Of a power below 0, where each axis alone takes 1 [1]."""
N_STARTS, N_BEST, N_STEPS = 4096, 64, 300
Kind = Literal["linear", "quadratic"]


def driving_motion(kind: Kind, drag: Array) -> tuple[Array, float] | None:
    """Return a motion that the drag (6, 6) drives, and the power it gives to it; or None.

    The motion has its greatest component 1 [m/s or rad/s]; the power is in W.
    """
    scale = _scale(kind, drag)
    if not (drag - np.diag(np.diag(drag))).any() and np.diag(drag).min() >= 0.0:
        return None
    if kind == "linear":
        scaled = drag * np.outer(scale, scale)
        values, vectors = np.linalg.eigh(0.5 * (scaled + scaled.T))
        least, worst = float(values[0]), vectors[:, 0]
    else:
        scaled = drag * np.outer(scale, scale**2)
        worst = _lowest(scaled)
        least = float(worst @ scaled @ (np.abs(worst) * worst))
    if least >= -TOLERANCE:
        return None
    motion = worst * scale
    motion = motion / motion[np.argmax(np.abs(motion))]
    moved = motion if kind == "linear" else np.abs(motion) * motion
    return motion, -float(motion @ drag @ moved)


def bearable_share(kind: Kind, drag: Array) -> float:
    """Return how large a share of the entries off the diagonal drag could have, to 0.01."""
    diagonal = np.diag(np.diag(drag))
    least, most = 0, 100
    while most - least > 1:
        middle = (least + most) // 2
        bears = driving_motion(kind, diagonal + 0.01 * middle * (drag - diagonal)) is None
        least, most = (middle, most) if bears else (least, middle)
    return 0.01 * least


def _scale(kind: Kind, drag: Array) -> Array:
    """Speeds at which each axis alone takes 1 W, or much, of axes without drag, (6,)."""
    floor = max(1e-6 * float(np.abs(drag).max()), 1e-300)
    power = 0.5 if kind == "linear" else 1.0 / 3.0
    scale: Array = np.maximum(np.diag(drag), floor) ** -power
    return scale


def _lowest(drag: Array) -> Array:
    """The unit motion (6,) of which quadratic drag takes least."""
    random = stream(0, "passivity")
    starts = random.standard_normal((N_STARTS, 6))
    starts[::2] *= random.random((N_STARTS // 2, 6)) < 0.4  # few axes at a time
    starts[np.abs(starts).max(axis=1) == 0.0] = 1.0
    motions = starts / np.linalg.norm(starts, axis=1, keepdims=True)
    best = np.argsort(_powers(drag, motions), kind="stable")[:N_BEST]
    motions = motions[best]
    stride = 0.25 / float(np.linalg.norm(drag))
    for _ in range(N_STEPS):
        size = np.abs(motions)
        slope = (size * motions) @ drag.T + 2.0 * size * (motions @ drag)
        motions = motions - stride * slope
        motions /= np.linalg.norm(motions, axis=1, keepdims=True)
    lowest: Array = motions[int(np.argmin(_powers(drag, motions)))]
    return lowest


def _powers(drag: Array, motions: Array) -> Array:
    """What quadratic drag takes of motions (n, 6), (n,)."""
    powers: Array = np.einsum("ni,ij,nj->n", motions, drag, np.abs(motions) * motions)
    return powers
