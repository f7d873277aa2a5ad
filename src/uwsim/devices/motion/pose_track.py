r"""Poses at given times, interpolated between them.

Between the samples i and i + 1, with the fraction :math:`s` of the time between them,

.. math::
    p = (1 - s)\, p_i + s\, p_{i+1}, \qquad
    q = \frac{\sin((1 - s)\, \theta)\, q_i + \sin(s\, \theta)\, q_{i+1}}{\sin \theta}, \quad
    \cos \theta = \lvert q_i \cdot q_{i+1} \rvert

(spherical linear interpolation, K. Shoemake, "Animating rotation with quaternion curves", SIGGRAPH
1985), on the shorter of both arcs. The velocity is constant between two samples and jumps at each.
Not modelled: the acceleration between the samples, so an inertial sensor that follows a track
measures none.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from ...base.external_values import MAX_COORDINATE
from ...base.geometry import Array, Pose
from ...base.numerics.elementwise import arccos
from ...errors import BadSetting

GapPolicy = Literal["hold", "interpolate", "refuse"]
"""The treatment of gaps: ``hold`` keeps the last pose, ``interpolate`` moves on uniformly, and
``refuse`` is an error."""
SMALL_ANGLE = 1e-6
"""The angle below which quaternions are interpolated linearly [rad]."""
MIN_NORM = 1e-9
"""The smallest length of a quaternion that is accepted [1]."""


class PoseTrack:
    """The poses of a body at increasing times.

    Samples whose position or orientation is not finite are left out: they are part of a gap.

    Args:
        times: the times of the samples, strictly increasing, (n,) [s].
        positions: the positions, (n, 3) [m].
        quaternions: the orientations wxyz, (n, 4); they are normalised.
        max_gap: the longest time between two samples that is no gap [s].
        gaps: the treatment of longer ones.

    Raises:
        BadSetting: there is no valid sample, the times do not increase, a coordinate is beyond 1e6
            m, or there is a gap that ``gaps`` refuses.
    """

    def __init__(
        self,
        times: Array,
        positions: Array,
        quaternions: Array,
        *,
        max_gap: float = math.inf,
        gaps: GapPolicy = "hold",
    ) -> None:
        norms = np.sqrt((quaternions * quaternions).sum(axis=1))
        with np.errstate(invalid="ignore"):
            is_valid = (
                np.isfinite(times)
                & (np.abs(positions) <= MAX_COORDINATE).all(axis=1)
                & (norms > MIN_NORM)
                & np.isfinite(norms)
            )
        self.n_left_out = int(len(times) - is_valid.sum())
        """The number of samples without a finite pose, which are left out."""
        if not is_valid.any():
            raise BadSetting(
                f"No pose of {len(times)} is finite, with coordinates of at most "
                f"{MAX_COORDINATE:g} m; expected at least one."
            )
        self.times = np.ascontiguousarray(times[is_valid], dtype=np.float64)
        """The times of the valid samples, (n,) [s]."""
        self._positions = np.ascontiguousarray(positions[is_valid], dtype=np.float64)
        self._quaternions = quaternions[is_valid] / norms[is_valid, None]
        steps = np.diff(self.times)
        if not (steps > 0.0).all():
            index = int(np.flatnonzero(steps <= 0.0)[0])
            raise BadSetting(
                f"The times of poses do not increase: {self.times[index + 1]:g} s follows "
                f"{self.times[index]:g} s."
            )
        self.gap_starts = np.flatnonzero(steps > max_gap)
        """The indices of the samples before a gap."""
        self._has_hold = gaps == "hold"
        if gaps == "refuse" and len(self.gap_starts):
            index = int(self.gap_starts[0])
            raise BadSetting(
                f"{len(self.gap_starts)} gaps of more than {max_gap:g} s are in the poses, the "
                f"first from {self.times[index]:g} s to {self.times[index + 1]:g} s; hold or "
                "interpolate accepts them."
            )
        self._is_gap = np.zeros(len(self.times), dtype=bool)
        self._is_gap[self.gap_starts] = True

    @property
    def duration(self) -> float:
        """The time of the last sample [s]."""
        return float(self.times[-1])

    def has_gap(self, time: float) -> bool:
        """Return whether a time [s] is in a gap, or before the first sample or after the last."""
        index = int(np.searchsorted(self.times, time, side="right")) - 1
        if index < 0 or index >= len(self.times) - 1:
            return not self.times[0] <= time <= self.times[-1]
        return bool(self._is_gap[index]) and time > self.times[index]

    def pose(self, time: float) -> Pose:
        """Return the pose at a time [s]; before the first and after the last sample, theirs."""
        index = int(np.searchsorted(self.times, time, side="right")) - 1
        index = max(index, 0)
        last_index = len(self.times) - 1
        is_held = (
            index >= last_index
            or time <= self.times[index]
            or (self._has_hold and self._is_gap[index])
        )
        if is_held:
            return Pose.from_quaternion(self._positions[index], self._quaternions[index])
        start_time, end_time = float(self.times[index]), float(self.times[index + 1])
        fraction = (time - start_time) / (end_time - start_time)
        start, end = self._positions[index], self._positions[index + 1]
        position = (1.0 - fraction) * start + fraction * end
        quaternion = interpolate_rotation(
            self._quaternions[index], self._quaternions[index + 1], fraction
        )
        return Pose.from_quaternion(position, quaternion)


def interpolate_rotation(start: Array, end: Array, fraction: float) -> Array:
    """Return the rotation on the shorter arc between two unit quaternions wxyz, (4,).

    Args:
        start: the rotation at the fraction 0, (4,).
        end: the rotation at the fraction 1, (4,).
        fraction: the fraction of the arc [0..1].
    """
    products = (start * end).tolist()
    cosine = products[0] + products[1] + products[2] + products[3]
    end = -end if cosine < 0.0 else end
    angle = float(arccos(min(abs(cosine), 1.0)))
    if angle < SMALL_ANGLE:
        return (1.0 - fraction) * start + fraction * end
    sine = float(np.sin(angle))
    start_weight = float(np.sin((1.0 - fraction) * angle)) / sine
    end_weight = float(np.sin(fraction * angle)) / sine
    mixture: Array = start_weight * start + end_weight * end
    return mixture
