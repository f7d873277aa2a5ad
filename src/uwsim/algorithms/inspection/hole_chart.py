"""The places at which holes were seen, merged to one place for each hole."""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import length


class HoleChart:
    """The mean places of sightings that lie near each other.

    Args:
        merge_distance: the distance within which sightings are of one hole [m].
        min_sightings: the number of sightings from which on a hole is reported.
    """

    def __init__(self, merge_distance: float, min_sightings: int) -> None:
        self._merge_distance, self._min_sightings = merge_distance, min_sightings
        self._sums: list[Array] = []  # of the places, (3,) each [m]
        self._counts: list[int] = []

    def add(self, place: Array) -> None:
        """Add a sighting at a place in the navigation frame, (3,) [m]."""
        for i, (total, count) in enumerate(zip(self._sums, self._counts, strict=True)):
            if length(total / count - place) < self._merge_distance:
                self._sums[i], self._counts[i] = total + place, count + 1
                return
        self._sums.append(place)
        self._counts.append(1)

    def places(self) -> Array:
        """Return the place of each hole that was seen often enough, (n, 3) [m]."""
        pairs = zip(self._sums, self._counts, strict=True)
        means = [total / count for total, count in pairs if count >= self._min_sightings]
        return np.array(means, dtype=np.float64).reshape(-1, 3)
