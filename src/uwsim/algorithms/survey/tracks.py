r"""Parallel tracks over a rectangle, and guidance along them for a vehicle that moves sideways.

The velocity over ground aims at a point of the track ahead, by the line-of-sight law of
`uwsim.algorithms.pipe.guidance` without its integral: u = U (d t + c) / |d t + c| with the speed U,
the look-ahead distance d, the unit vector t along the track and the vector c to its nearest point.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import dot

ARRIVAL = 0.5
"""The distance along a track from its end at which the next track begins [m]."""


def plan_tracks(length: float, width: float, spacing: float, margin: float) -> list[Array]:
    """Return the corners of tracks along x that cover a rectangle from the origin, (2,) each [m].

    Args:
        length: the extent of the rectangle along x [m].
        width: the extent of the rectangle along y [m].
        spacing: the greatest distance of neighbouring tracks [m].
        margin: the distance of the first and the last track from the sides of the rectangle [m].
    """
    span = max(0.0, width - 2.0 * margin)
    n = math.ceil(span / spacing - 1e-9) + 1
    offsets = np.linspace(margin, margin + span, n).tolist() if n > 1 else [0.5 * width]
    corners = []
    for i, y in enumerate(offsets):
        ends = (0.0, length) if i % 2 == 0 else (length, 0.0)
        corners += [np.array([x, y]) for x in ends]
    return corners


class TrackGuidance:
    """A guidance along the lines between corners.

    Args:
        corners: the corners, the first of which is approached from the first position, (2,) [m].
        speed: the speed over ground [m/s].
        look_ahead: the look-ahead distance [m].
    """

    def __init__(self, corners: Sequence[Array], speed: float, look_ahead: float) -> None:
        self._corners, self._speed, self._look_ahead = list(corners), speed, look_ahead
        self._start: Array | None = None

    @property
    def has_arrived(self) -> bool:
        """True if the last corner was reached."""
        return not self._corners

    def command(self, position: Array) -> Array:
        """Return the velocity over ground at a position (2,) [m]: (2,) [m/s]."""
        if self._start is None:
            self._start = position
        while self._corners:
            track = self._corners[0] - self._start
            length = math.hypot(*track.tolist())
            direction = track / length if length > 0.0 else np.array([1.0, 0.0])
            progress = dot(direction, position - self._start)
            if progress < length - ARRIVAL:
                offset = self._start + progress * direction - position
                aim = min(self._look_ahead, length - progress) * direction + offset
                velocity: Array = self._speed * aim / math.hypot(*aim.tolist())
                return velocity
            self._start = self._corners.pop(0)
        return np.zeros(2)
