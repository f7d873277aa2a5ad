"""The track of a vehicle in a manoeuvre: what the numbers of all manoeuvres are computed from."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ....base.geometry import Array

STEADY_SHARE = 0.2
"""The fraction of a record, at its end, over which a steady value is averaged [1]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ManoeuvreTrack:
    """The track of a vehicle; the manoeuvre begins at time 0, samples before it are the approach.

    Angles are positive to starboard: a positive rudder turns the bow to starboard. The position is
    that of the vehicle's base, seen from above.
    """

    length: float
    """The length L of the vehicle [m]."""
    times: Array
    """The times, rising, (n,) [s]."""
    positions: Array
    """The positions, (n, 2) [m]; a heading of 0 is along the first axis, 90° along the second."""
    headings: Array
    """The headings without jumps, (n,) [rad]."""
    surge: Array
    """The forward speeds, (n,) [m/s]."""
    sway: Array
    """The speeds to starboard, horizontal, (n,) [m/s]."""
    yaw_rates: Array
    """The yaw rates, (n,) [rad/s]."""
    rudders: Array
    """The ordered rudder angles, (n,) [rad]."""
    depths: Array
    """The depths, (n,) [m]."""

    @cached_property
    def start(self) -> int:
        """The index of the last sample that is not after the beginning of the manoeuvre."""
        return max(int(np.searchsorted(self.times, 1e-9, side="right")) - 1, 0)

    @cached_property
    def approach_speed(self) -> float:
        """The speed at the beginning of the manoeuvre [m/s]."""
        return float(self.speeds[self.start])

    @cached_property
    def speeds(self) -> Array:
        """The horizontal speeds, (n,) [m/s]."""
        speeds: Array = np.sqrt(self.surge**2 + self.sway**2)
        return speeds

    @cached_property
    def course(self) -> Array:
        """The positions from the beginning on, along and to starboard of its heading, (n, 2) [m].

        The first sample is at the origin.
        """
        heading = float(self.headings[self.start])
        east, north = math.sin(heading), math.cos(heading)
        x, y = (self.positions[self.start :] - self.positions[self.start]).T
        return np.column_stack([x * north + y * east, y * north - x * east])

    @cached_property
    def heading_change(self) -> Array:
        """The change of heading from the beginning on, (n,) [rad]."""
        return np.asarray(self.headings[self.start :] - self.headings[self.start])

    @cached_property
    def run_times(self) -> Array:
        """The times from the beginning on, (n,) [s]."""
        return np.asarray(self.times[self.start :] - self.times[self.start])

    @cached_property
    def path_lengths(self) -> Array:
        """The distance travelled from the beginning on, (n,) [m]."""
        steps = np.diff(self.positions[self.start :], axis=0)
        return np.concatenate([[0.0], np.cumsum(np.sqrt((steps**2).sum(axis=1)))])

    @property
    def steady_speed(self) -> float:
        """The mean horizontal speed over the end of the manoeuvre [m/s]."""
        return self.compute_steady_mean(self.speeds)

    @property
    def depth_change(self) -> float:
        """The greatest change of depth since the beginning [m]."""
        return float(np.abs(self.depths[self.start :] - self.depths[self.start]).max())

    def compute_steady_mean(self, values: Array) -> float:
        """Return the mean of values over the last `STEADY_SHARE` of the manoeuvre.

        Args:
            values: one value for each sample of the track, (n,).
        """
        n = max(1, round(STEADY_SHARE * (len(self.times) - self.start)))
        return float(np.mean(values[-n:]))


def first_crossing(values: Array, level: float) -> float | None:
    """Return where values first reach a level from below, as a fractional index; None if never."""
    indices = np.flatnonzero(values >= level)
    if not len(indices):
        return None
    k = int(indices[0])
    if k == 0:
        return 0.0
    return k - 1 + float((level - values[k - 1]) / (values[k] - values[k - 1]))


def value_at(values: Array, position: float) -> float:
    """Return a value at a fractional index, by linear interpolation."""
    k = min(int(position), len(values) - 1)
    rest = position - k
    if rest <= 0.0 or k + 1 >= len(values):
        return float(values[k])
    return float(values[k] + rest * (values[k + 1] - values[k]))


def unwrap(angles: Array) -> Array:
    """Return angles (n,) without jumps of whole turns [rad]."""
    return np.asarray(np.unwrap(angles))
