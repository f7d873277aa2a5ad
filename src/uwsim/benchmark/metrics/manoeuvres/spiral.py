r"""The spiral manoeuvre: whether a vehicle holds a course without a helmsman.

*Direct spiral* (Dieudonné 1949): the rudder goes in steps from one side to the other and back; at
each angle it is held until the yaw rate r is steady. *Reverse spiral* (Bech 1966): a helmsman holds
a yaw rate, and the mean rudder angle is noted. The curve :math:`r(\delta)` of a vehicle that is
stable on its course is single. An unstable vehicle has a *loop*: with the rudder between two angles
it turns to either side, depending on where it came from.

- *loop width*: the difference of the two rudder angles at which the direct spiral changes from one
  side to the other, each in the middle between two steps. The steps there limit its accuracy;
- *loop height*: the difference of the yaw rates of both ways in the middle of the loop;
- *neutral angle*: the middle of the two angles: the rudder for a straight course;
- *reverse width*: the same width on the curve of a reverse spiral, between its turning points.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np


@dataclass(frozen=True, kw_only=True)
class SpiralPoint:
    """A steady state of a spiral."""

    rudder: float
    """The rudder angle, positive to starboard [rad]."""
    yaw_rate: float
    """The steady yaw rate, positive to starboard [rad/s]."""
    spread: float = 0.0
    """The difference of the extremes over the time of the mean [rad/s; of a reverse spiral rad]."""


@dataclass(frozen=True, kw_only=True)
class Spiral:
    """The numbers of a spiral."""

    points: tuple[SpiralPoint, ...]
    """The points of the direct spiral, in the order of time."""
    reverse_points: tuple[SpiralPoint, ...]
    """The points of the reverse spiral; empty if none was made."""
    loop_width: float | None
    """The width of the loop, 0 for a vehicle that is stable on its course [rad]; None if the
    vehicle turned to one side only."""
    loop_height: float | None
    """The height of the loop [rad/s]."""
    neutral_angle: float | None
    """The neutral rudder angle [rad]."""
    resolution: float
    """The accuracy of the loop's width, from the steps of the rudder [rad]."""
    reverse_width: float | None
    """The width of the loop of the reverse spiral [rad]; None without one."""


def measure_spiral(
    points: Sequence[SpiralPoint], reverse_points: Sequence[SpiralPoint] = ()
) -> Spiral:
    """Compute the numbers of a spiral.

    Args:
        points: the points of the direct spiral, from one side to the other and back.
        reverse_points: the points of a reverse spiral.
    """
    turns = [
        (0.5 * (a.rudder + b.rudder), abs(a.rudder - b.rudder))
        for a, b in pairwise(points)
        if a.yaw_rate * b.yaw_rate < 0.0
    ]
    sorted_points = tuple(sorted(reverse_points, key=lambda point: point.yaw_rate))
    width = reverse_loop_width(sorted_points) if len(sorted_points) > 2 else None
    if len(turns) < 2:
        return Spiral(
            points=tuple(points), reverse_points=sorted_points, loop_width=None, loop_height=None,
            neutral_angle=None, resolution=0.0, reverse_width=width,
        )  # fmt: skip
    (down, step), (up, other_step) = turns[0], turns[-1]
    middle = 0.5 * (down + up)
    n_down = _turning_index(points)
    first = _rate_at(points[: n_down + 1], middle)
    second = _rate_at(points[n_down:], middle)
    is_loop = abs(first - second) > 1e-9 and (up - down) * (points[0].rudder - middle) > 0.0
    return Spiral(
        points=tuple(points),
        reverse_points=sorted_points,
        loop_width=abs(up - down) if is_loop else 0.0,
        loop_height=abs(first - second) if is_loop else 0.0,
        neutral_angle=middle,
        resolution=0.5 * (step + other_step),
        reverse_width=width,
    )


def reverse_loop_width(points: Sequence[SpiralPoint]) -> float:
    """Return the width between the turning points of a curve over the yaw rate, 0 without [rad].

    A stable vehicle needs more rudder to starboard for a greater yaw rate to starboard. Where the
    rudder falls with the yaw rate, the curve has the S of an unstable vehicle.
    """
    rudders = np.array([point.rudder for point in points])
    highest_rudders = np.maximum.accumulate(rudders)
    return float((highest_rudders - rudders).max())


def _turning_index(points: Sequence[SpiralPoint]) -> int:
    """Return the index of the point at which the rudder is reversed, farthest from the first."""
    first = points[0].rudder
    return int(np.argmax([abs(point.rudder - first) for point in points]))


def _rate_at(points: Sequence[SpiralPoint], rudder: float) -> float:
    """Return the yaw rate of one way at a rudder angle, by linear interpolation."""
    sorted_points = sorted(points, key=lambda point: point.rudder)
    return float(
        np.interp(rudder, [p.rudder for p in sorted_points], [p.yaw_rate for p in sorted_points])
    )
