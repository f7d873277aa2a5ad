"""The windows of a log: the times at which the simulated vehicle gets the log's state."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from ..errors import BadSetting
from .log_motion import LogMotion

TIME_TOLERANCE = 1e-6
"""The tolerance of times [s]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Windows:
    """The windows of a log."""

    starts: Array
    """The times at which windows begin, ascending, (n,) [s]."""
    spacing: float
    """The interval between windows [s]."""
    fits: dict[float, tuple[int, ...]]
    """The indices of the windows that have the log's motion to each horizon."""
    n_left_out: int = 0
    """The number of windows that touch a gap before the shortest horizon, and are left out."""

    def block_length(self, horizon: float) -> int:
        """Return the number of successive windows of which the motions overlap."""
        return max(1, int(np.ceil(horizon / self.spacing - TIME_TOLERANCE)))


def choose_windows(
    motion: LogMotion, start: float, end: float, horizons: tuple[float, ...], n_max: int
) -> Windows:
    """Choose windows at equal intervals, each beginning at a sample of the motion.

    Windows of one horizon overlap if it is longer than their interval, which is at least the
    shortest horizon. No window spans a gap of the log.

    Args:
        motion: the motion of the log.
        start: the first time at which commands are known [s].
        end: the last time at which commands are known [s].
        horizons: the horizons, ascending [s].
        n_max: the greatest number of windows.

    Raises:
        BadSetting: the log is shorter than two windows of the shortest horizon.
    """
    first = max(start, float(motion.times[0]))
    end_time = min(end, float(motion.times[-1]))
    duration = end_time - first
    if duration < 2.0 * horizons[0]:
        raise BadSetting(
            f"The log has {max(0.0, duration):.3g} s with both motion and commands; expected at "
            f"least two windows of {horizons[0]:g} s. Choose shorter --horizons."
        )
    spacing = max(horizons[0], (duration - horizons[0]) / (n_max - 1))
    n_windows = int((duration - horizons[0]) / spacing + TIME_TOLERANCE) + 1
    times = first + spacing * np.arange(n_windows)
    samples = motion.times[
        (motion.times >= first) & (motion.times <= end_time - horizons[0] + 1e-9)
    ]
    indices = np.clip(np.searchsorted(samples, times - TIME_TOLERANCE), 0, len(samples) - 1)
    candidates = np.unique(samples[indices]) if len(samples) else samples
    starts = np.array([t for t in candidates.tolist() if not motion.has_gap(t, t + horizons[0])])
    if len(starts) < 2:
        raise BadSetting(
            f"Gaps of the motion and {motion.n_left_out} samples without a whole position or twist "
            f"leave fewer than two windows of {horizons[0]:g} s. Choose shorter --horizons."
        )
    fits = {
        horizon: tuple(
            index
            for index, t in enumerate(starts.tolist())
            if t + horizon <= end_time + TIME_TOLERANCE and not motion.has_gap(t, t + horizon)
        )
        for horizon in horizons
    }
    return Windows(
        starts=starts, spacing=spacing, fits=fits, n_left_out=len(candidates) - len(starts)
    )
