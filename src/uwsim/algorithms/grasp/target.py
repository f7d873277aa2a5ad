r"""The estimate of where the box is, from many sightings.

A Kalman filter over place, heading and lean of the box in the navigation frame. The box does not
move; the navigation drifts, which is a random walk of the place of `DRIFT`. A sighting counts if
its squared Mahalanobis distance is below `GATE`; after `MAX_REJECTED` others in a row the filter
begins anew with the last one. Sightings have errors in common (of calibration, of the threshold):
their covariance is increased by `SYSTEMATIC`.
"""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import dot, inverse, product
from .box import BoxPose, half_turn
from .box_pose import Sighting

DRIFT = np.array([0.003, 0.003, 0.001, 0.001, 0.0005, 0.0005])
"""Random walk of place, heading and lean [m/sqrt(s), rad/sqrt(s)]."""
SYSTEMATIC = np.array([0.01, 0.01, 0.015, 0.02, 0.04, 0.04])
"""Deviation of errors that a fit does not know of [m, rad]."""
GATE = 30.0
"""Largest squared Mahalanobis distance of a sighting that counts."""
MAX_REJECTED = 8
"""So many sightings in a row do not count before the filter begins anew."""


class Target:
    """The estimate of the pose of the box."""

    def __init__(self) -> None:
        self.pose: BoxPose | None = None
        """Where the box is; None before the first sighting."""
        self.covariance: Array = np.eye(6)
        """Of place, heading and lean, (6, 6)."""
        self.count = 0
        """Sightings that the estimate is made of."""
        self.seen_at = -1e9
        """Time of the last one [s]."""
        self._rejected = 0
        self._time = 0.0

    @property
    def deviation(self) -> float:
        """Of the horizontal place [m]; infinite before the first sighting."""
        if self.pose is None:
            return float("inf")
        return float(np.sqrt(max(self.covariance[0, 0], self.covariance[1, 1])))

    def forget(self) -> None:
        """Begin anew."""
        self.pose, self.count, self._rejected = None, 0, 0

    def take(self, sighting: Sighting, time: float) -> bool:
        """Take a sighting at ``time`` [s]; whether it counts."""
        if self.pose is None:
            self._begin(sighting, time)
            return True
        self.covariance = self.covariance + np.diag((time - self._time) * DRIFT**2)
        self._time = time
        error = sighting.pose.numbers - self.pose.numbers
        error[3] = half_turn(float(error[3]))
        noise = sighting.covariance + np.diag(SYSTEMATIC**2)
        weights = inverse(self.covariance + noise)
        if dot(error, product(weights, error)) > GATE:
            self._rejected += 1
            if self._rejected > MAX_REJECTED:
                self._begin(sighting, time)
            return False
        gain = product(self.covariance, weights)
        self.pose = BoxPose.from_numbers(self.pose.numbers + product(gain, error))
        self.covariance = product(np.eye(6) - gain, self.covariance)
        self.covariance = 0.5 * (self.covariance + self.covariance.T)
        self.count, self.seen_at, self._rejected = self.count + 1, time, 0
        return True

    def _begin(self, sighting: Sighting, time: float) -> None:
        self.pose = sighting.pose
        self.covariance = sighting.covariance + np.diag(SYSTEMATIC**2)
        self.count, self.seen_at, self._time, self._rejected = 1, time, time, 0
