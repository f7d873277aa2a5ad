"""The upright plane of a net, from the scan of a sonar with a level fan ahead."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array

MIN_HITS = 6
"""The smallest number of hits of a plane."""
MAX_SPREAD = 0.15
"""The greatest distance of a hit from the line that is fitted [m]."""


@dataclass(frozen=True)
class NetPlane:
    """The line of a net in the level plane of the base: forward = distance + slope * starboard."""

    distance: float
    """The distance straight ahead of the base [m]."""
    slope: float
    """The distance forward that it gains in a metre to starboard [1]."""


def fit_net(hits: Array) -> NetPlane | None:
    """Fit a line by least squares to hits (n, 2), forward and to starboard [m]; None if too few.

    Hits that are far from the line of a first fit are left out, twice.
    """
    plane: NetPlane | None = None
    for limit in (3.0 * MAX_SPREAD, MAX_SPREAD, MAX_SPREAD):
        if plane is not None:
            error = hits[:, 0] - plane.distance - plane.slope * hits[:, 1]
            hits = hits[np.abs(error) < limit]
        if len(hits) < MIN_HITS or float(np.ptp(hits[:, 1])) < MAX_SPREAD:
            return None
        starboard = hits[:, 1] - hits[:, 1].mean()
        slope = float((starboard * hits[:, 0]).sum() / (starboard * starboard).sum())
        plane = NetPlane(float(hits[:, 0].mean() - slope * hits[:, 1].mean()), slope)
    return plane
