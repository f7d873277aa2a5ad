r"""Check of the passivity of drag: drag must take energy from a body in every motion.

Linear drag :math:`D\nu` takes the power :math:`\nu^T D \nu` from a body that moves with the
velocity :math:`\nu`, and quadratic drag takes the power

.. math:: P(\nu) = \sum_{ij} \nu_i\, Q_{ij}\, |\nu_j|\, \nu_j .

A body can lose energy to still water but not gain energy, so neither power may be negative at any
:math:`\nu` (Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control, 2011, property 6.2:
:math:`D(\nu) > 0`). For linear drag this means that the symmetric part of D is positive
semi-definite. For quadratic drag the condition is different, neither weaker nor stronger: P is a
polynomial of the third degree, and gradient descent from many starts searches for its least value
on the unit sphere.
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from ...base.geometry import Array
from ...base.rng import stream

TOLERANCE = 1e-6
"""The tolerance of negative power [W], for motions scaled so that each axis alone takes 1 W."""
N_STARTS, N_BEST, N_STEPS = 4096, 64, 300
"""The number of random motions, of the best of them that are improved, and of descent steps."""
Kind = Literal["linear", "quadratic"]


def driving_motion(kind: Kind, drag: Array) -> tuple[Array, float] | None:
    """Return a motion that the drag drives instead of damping it; None if the drag is passive.

    Args:
        kind: the drag law.
        drag: the matrix of its coefficients, (6, 6).

    Returns:
        The motion (6,), whose greatest component is 1 [m/s or rad/s], and the power that the drag
        supplies [W].
    """
    scale = _scale(kind, drag)
    if not (drag - np.diag(np.diag(drag))).any() and np.diag(drag).min() >= 0.0:
        return None
    if kind == "linear":
        scaled_drag = drag * np.outer(scale, scale)
        values, vectors = np.linalg.eigh(0.5 * (scaled_drag + scaled_drag.T))
        min_power, scaled_motion = float(values[0]), vectors[:, 0]
    else:
        scaled_drag = drag * np.outer(scale, scale**2)
        scaled_motion = _min_power_motion(scaled_drag)
        min_power = float(scaled_motion @ scaled_drag @ (np.abs(scaled_motion) * scaled_motion))
    if min_power >= -TOLERANCE:
        return None
    motion = scaled_motion * scale
    motion = motion / motion[np.argmax(np.abs(motion))]
    drag_speeds = motion if kind == "linear" else np.abs(motion) * motion
    return motion, -float(motion @ drag @ drag_speeds)


def passive_share(kind: Kind, drag: Array) -> float:
    """Return the greatest factor on the off-diagonal entries with which the drag is passive.

    It is computed in steps of 0.01, from 0 to 1.
    """
    diagonal = np.diag(np.diag(drag))
    lower, upper = 0, 100
    while upper - lower > 1:
        middle = (lower + upper) // 2
        is_passive = driving_motion(kind, diagonal + 0.01 * middle * (drag - diagonal)) is None
        lower, upper = (middle, upper) if is_passive else (lower, middle)
    return 0.01 * lower


def _scale(kind: Kind, drag: Array) -> Array:
    """Return the speed at which drag along each axis alone takes 1 W, (6,) [m/s, rad/s].

    Axes without drag have a large finite speed.
    """
    floor = max(1e-6 * float(np.abs(drag).max()), 1e-300)
    power = 0.5 if kind == "linear" else 1.0 / 3.0
    scale: Array = np.maximum(np.diag(drag), floor) ** -power
    return scale


def _min_power_motion(drag: Array) -> Array:
    """Return the unit motion (6,) from which quadratic drag takes the minimum power."""
    rng = stream(0, "passivity")
    starts = rng.standard_normal((N_STARTS, 6))
    starts[::2] *= rng.random((N_STARTS // 2, 6)) < 0.4  # few axes at a time
    starts[np.abs(starts).max(axis=1) == 0.0] = 1.0
    motions = starts / np.linalg.norm(starts, axis=1, keepdims=True)
    order = np.argsort(_powers(drag, motions), kind="stable")[:N_BEST]
    motions = motions[order]
    stride = 0.25 / float(np.linalg.norm(drag))
    for _ in range(N_STEPS):
        size = np.abs(motions)
        slope = (size * motions) @ drag.T + 2.0 * size * (motions @ drag)
        motions = motions - stride * slope
        motions /= np.linalg.norm(motions, axis=1, keepdims=True)
    motion: Array = motions[int(np.argmin(_powers(drag, motions)))]
    return motion


def _powers(drag: Array, motions: Array) -> Array:
    """Return the power [W] that quadratic drag takes from motions (n, 6), as (n,)."""
    powers: Array = np.einsum("ni,ij,nj->n", motions, drag, np.abs(motions) * motions)
    return powers
