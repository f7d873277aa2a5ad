r"""The estimate of the pose of the box from the sightings in many images, by a Kalman filter.

The state of the filter is the pose vector of the box in the navigation frame (north, east, down):
position, heading, and tilts about the x and y axes of the box. A *sighting* is a measurement of
this vector from one image (`box_pose`). The box does not move, but the navigation drifts, so the
pose has the random walk `DRIFT`. A sighting is accepted if its squared Mahalanobis distance from
the estimate is at most `GATE`. After more than `MAX_REJECTED` rejected sightings in a row, the
filter restarts with the last of them. All sightings share some errors, for example of the camera's
calibration; their covariance is therefore increased by `SYSTEMATIC_ERROR`.
"""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import dot, inverse, product
from .box import BoxPose, wrap_half_turn
from .box_pose import Sighting

DRIFT = np.array([0.003, 0.003, 0.001, 0.001, 0.0005, 0.0005])
"""The random walk of the pose vector, (6,) [m/sqrt(s), rad/sqrt(s)]."""
SYSTEMATIC_ERROR = np.array([0.01, 0.01, 0.015, 0.02, 0.04, 0.04])
"""The standard deviation of the errors that all sightings share, (6,) [m, rad]."""
GATE = 30.0
"""The largest squared Mahalanobis distance of an accepted sighting."""
MAX_REJECTED = 8
"""The greatest number of sightings in a row that are rejected without a restart."""


class TargetEstimate:
    """The estimate of the pose of the box."""

    def __init__(self) -> None:
        self.pose: BoxPose | None = None
        """The pose of the box; None before the first sighting."""
        self.covariance: Array = np.eye(6)
        """The covariance of position, heading and tilt, (6, 6) [m, rad]."""
        self.n_sightings = 0
        """The number of accepted sightings."""
        self.last_sighting_time = -1e9
        """The time of the last accepted sighting [s]."""
        self._n_rejected = 0
        self._time = 0.0

    @property
    def deviation(self) -> float:
        """The standard deviation of the horizontal position, the larger of north and east [m].

        It is infinite before the first sighting.
        """
        if self.pose is None:
            return float("inf")
        return float(np.sqrt(max(self.covariance[0, 0], self.covariance[1, 1])))

    def reset(self) -> None:
        """Remove the estimate."""
        self.pose, self.n_sightings, self._n_rejected = None, 0, 0

    def update(self, sighting: Sighting, time: float) -> bool:
        """Update the estimate by a sighting at ``time`` [s]; return whether it is accepted."""
        if self.pose is None:
            self._start(sighting, time)
            return True
        self.covariance = self.covariance + np.diag((time - self._time) * DRIFT**2)
        self._time = time
        error = sighting.pose.vector - self.pose.vector
        error[3] = wrap_half_turn(float(error[3]))
        noise = sighting.covariance + np.diag(SYSTEMATIC_ERROR**2)
        weights = inverse(self.covariance + noise)
        if dot(error, product(weights, error)) > GATE:
            self._n_rejected += 1
            if self._n_rejected > MAX_REJECTED:
                self._start(sighting, time)
            return False
        gain = product(self.covariance, weights)
        self.pose = BoxPose.from_vector(self.pose.vector + product(gain, error))
        self.covariance = product(np.eye(6) - gain, self.covariance)
        self.covariance = 0.5 * (self.covariance + self.covariance.T)
        self.n_sightings, self.last_sighting_time, self._n_rejected = self.n_sightings + 1, time, 0
        return True

    def _start(self, sighting: Sighting, time: float) -> None:
        self.pose = sighting.pose
        self.covariance = sighting.covariance + np.diag(SYSTEMATIC_ERROR**2)
        self.n_sightings, self.last_sighting_time, self._time, self._n_rejected = 1, time, time, 0
