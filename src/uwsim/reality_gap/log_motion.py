"""The motion of a log at any time between its samples."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from ..base.geometry import Array
from ..errors import BadSetting
from ..logs import MotionSeries, VehicleLog
from ..logs.frames import multiply_quaternions, rotate_vectors_back
from ..logs.samples import find_gaps
from ..logs.smoothing import estimate_twists, make_continuous


class LogMotion:
    """The motion of a log, linear between its samples; no orientation turns half around in one.

    Samples without a whole position and twist are left out. The rest has a gap where the samples
    are five times as far apart as usual, and 0.5 s at least (`logs.samples.find_gaps`).

    Args:
        motion: the motion.
    """

    def __init__(self, motion: MotionSeries) -> None:
        twists = motion.twists
        if twists is None:
            twists = estimate_twists(motion.times, motion.positions, motion.quaternions)
        is_whole = np.isfinite(np.hstack([motion.positions, twists])).all(axis=1)
        self.is_planar = motion.is_planar
        """True if depth, roll and pitch are constants."""
        self.n_samples = len(motion.times)
        """The number of samples of the log."""
        self.n_left_out = self.n_samples - int(is_whole.sum())
        """The number of samples without a whole position and twist."""
        self.times = motion.times[is_whole]
        """The times of the other samples, (n,) [s]."""
        self._positions, self._twists = motion.positions[is_whole], twists[is_whole]
        self._quaternions = make_continuous(motion.quaternions[is_whole])

    @cached_property
    def gaps(self) -> list[tuple[float, float]]:
        """The beginning and the end of each gap, ascending [s]."""
        return find_gaps(self.times)

    @cached_property
    def _gap_limits(self) -> Array:
        limits: Array = np.array(self.gaps, dtype=np.float64).reshape(-1, 2)
        return limits

    def has_gap(self, start: float, end: float) -> bool:
        """Return whether an interval overlaps a gap of the log."""
        limits = self._gap_limits
        return bool(((start < limits[:, 1]) & (end > limits[:, 0])).any())

    def positions(self, times: Array) -> Array:
        """Return the positions in L, (n, 3) [m]."""
        return self._interpolate(times, self._positions)

    def quaternions(self, times: Array) -> Array:
        """Return the orientations ``localized_from_base``, wxyz, (n, 4)."""
        rows = self._interpolate(times, self._quaternions)
        norms: Array = np.sqrt((rows * rows).sum(axis=1))[:, None]
        return rows / norms

    def twists(self, times: Array) -> Array:
        """Return the twists over ground in base axes, (n, 6) [m/s, rad/s]."""
        return self._interpolate(times, self._twists)

    def path_length(self, start: float, end: float) -> float:
        """Return the distance travelled between two times [m].

        It is the integral of the speed, which measurement noise of positions does not lengthen.
        """
        inner_times = self.times[(self.times > start) & (self.times < end)]
        times = np.concatenate([[start], inner_times, [end]])
        linear = self.twists(times)[:, :3]
        speeds = np.sqrt((linear * linear).sum(axis=1))
        return float((0.5 * (speeds[1:] + speeds[:-1]) * np.diff(times)).sum())

    def _interpolate(self, times: Array, columns: Array) -> Array:
        return np.array([np.interp(times, self.times, column) for column in columns.T]).T


def read_motion(log: VehicleLog) -> LogMotion:
    """Return the motion of a log.

    Raises:
        BadSetting: the log has fewer than two samples with a whole position and twist.
    """
    motion = log.motion
    if motion is None or len(motion.times) < 2:
        raise BadSetting(
            f"{log.path} has no motion of the vehicle; expected poses (odometry, or position and "
            "orientation)."
        )
    n_samples = len(motion.times)
    n_missing = int((~np.isfinite(motion.positions)).any(axis=1).sum())
    if n_missing > n_samples - 2:
        raise BadSetting(
            f"{log.path} has {n_missing} of {n_samples} positions without all three coordinates; "
            "the gap needs them."
        )
    log_motion = LogMotion(motion)
    if len(log_motion.times) < 2:
        raise BadSetting(
            f"{log.path} has no twists, and too few poses to estimate them: {n_samples}."
        )
    return log_motion


def relative_motion(
    positions: Array, quaternions: Array, from_positions: Array, from_quaternions: Array
) -> Array:
    """Return displacements and rotations between poses, in the axes of the first, (n, 6).

    The rotation is the rotation vector [rad], the displacement in m.

    Args:
        positions: the positions of the second poses, (n, 3) [m].
        quaternions: their orientations wxyz, (n, 4).
        from_positions: the positions of the first poses, (n, 3) [m].
        from_quaternions: their orientations wxyz, (n, 4).
    """
    displacements = rotate_vectors_back(from_quaternions, positions - from_positions)
    conjugates = from_quaternions * np.array([1.0, -1.0, -1.0, -1.0])
    turns = multiply_quaternions(conjugates, quaternions)
    return np.hstack([displacements, rotation_vectors(turns)])


def rotation_vectors(quaternions: Array) -> Array:
    """Return the rotation vectors (n, 3) of quaternions wxyz (n, 4), at most half a turn [rad]."""
    from ..base.numerics.elementwise import arctan2

    turns = quaternions * np.where(quaternions[:, :1] < 0.0, -1.0, 1.0)
    sines = np.sqrt((turns[:, 1:] * turns[:, 1:]).sum(axis=1))
    angles = 2.0 * arctan2(sines, turns[:, 0])
    factors = np.where(sines > 1e-12, angles / np.where(sines > 1e-12, sines, 1.0), 2.0)
    vectors: Array = turns[:, 1:] * factors[:, None]
    return vectors
