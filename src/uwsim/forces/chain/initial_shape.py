"""The shape of a tether at the beginning: a straight line, or an arc if it is slack."""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import cross, dot

N_BISECTIONS = 60
"""The number of bisections by which the angle of an arc is found."""
MAX_HALF_ANGLE = 0.95 * math.pi
"""The largest half angle of an arc [rad]; a tether with more slack is compressed along it."""


def arc_between(start: Array, end: Array, length: float, shares: Array) -> Array:
    """Return points on an arc of a circle with a given length, or on a line if it is too short.

    The arc is level if its ends are; otherwise it is in the plane of the chord and the level
    direction across it. The tether thus neither begins in the ground nor rises above its ends.

    Args:
        start: the first point, (3,) [m].
        end: the last point, (3,) [m].
        length: the length of the arc [m].
        shares: the places along the arc, from 0 to 1, (n,).
    """
    chord = end - start
    distance = math.sqrt(dot(chord, chord))
    straight = start + shares[:, None] * chord
    if distance >= length:
        return straight
    direction = chord / distance if distance > 0.0 else np.array([1.0, 0.0, 0.0])
    level = cross(np.array([0.0, 0.0, 1.0]), direction)
    size = math.sqrt(dot(level, level))
    side = level / size if size > 1e-6 else np.array([0.0, 1.0, 0.0])
    low, high = 0.0, MAX_HALF_ANGLE
    for _ in range(N_BISECTIONS):
        middle = 0.5 * (low + high)
        if math.sin(middle) / middle > distance / length:
            low = middle
        else:
            high = middle
    half, radius = low, 0.5 * length / low
    points: list[Array] = []
    for share in shares.tolist():
        angle = (2.0 * share - 1.0) * half
        forward = radius * (math.sin(angle) + math.sin(half))
        side_offset = radius * (math.cos(angle) - math.cos(half))
        points.append(start + forward * direction + side_offset * side)
    curve = np.array(points)
    curve[0], curve[-1] = start, end
    return curve
