"""Samples of one series while a reader collects them, and the repair of their times.

Logs have defects: duplicated times, messages out of order, gaps, and numbers that are not finite.
`Samples.finish` repairs what does not change a measurement, and states each repair as a remark.
"""

from __future__ import annotations

from array import array
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..errors import AssetError
from .limits import MAX_SAMPLES

GAP_FACTOR = 5.0
"""The interval between samples that counts as a gap, in median intervals."""
MIN_GAP = 0.5
"""The shortest gap that is reported [s]."""
CLOCK_RESET = 1.0
"""The step backwards in time from which a log's clock was reset [s]."""
MAX_REPORTED_GAPS = 3
STEP = 0.02
"""The interval of interpolated commands [s]."""
MAX_STRETCH = 0.5
"""The longest interval between samples that commands are interpolated over [s]."""


class ClockReset(AssetError):
    """A log whose clock was set back, so that it has two time bases."""


class Samples:
    """The samples of one series, in the order of the file.

    Args:
        width: the number of columns.
        label: the name of the series in messages.
    """

    def __init__(self, width: int, label: str) -> None:
        self.width, self.label = width, label
        self._times, self._values = array("d"), array("d")

    def __len__(self) -> int:
        return len(self._times)

    def append(self, time: float, values: Sequence[float]) -> None:
        """Add a sample; raise AssetError if there are too many."""
        if len(self._times) >= MAX_SAMPLES:
            raise AssetError(f"{self.label} has more than {MAX_SAMPLES} samples.")
        self._times.append(time)
        self._values.extend(values)

    def retime(self) -> Samples:
        """Return the same samples with the first column as their times."""
        samples = Samples(self.width, self.label)
        samples._times, samples._values = self._values[:: self.width], self._values
        return samples

    def finish(self, remarks: list[str], *, is_motion: bool = False) -> tuple[Array, Array]:
        """Return the times (n,) [s] and the values (n, width), in the order of the times.

        Samples with an infinite time are removed. Samples out of order by less than `CLOCK_RESET`
        are sorted. Of samples with one time, the first is kept in a motion, the last in others.

        Args:
            remarks: the list to which each repair is added.
            is_motion: True if the times must be strictly increasing.

        Raises:
            ClockReset: the time goes back by more than `CLOCK_RESET`.
        """
        times = np.array(self._times, dtype=np.float64)
        values = np.array(self._values, dtype=np.float64).reshape(len(times), self.width)
        is_finite = np.isfinite(times)
        if not is_finite.all():
            remarks.append(f"{self.label}: {_count(~is_finite)} without a time; removed.")
            times, values = times[is_finite], values[is_finite]
        times, values = self._sort(times, values, remarks)
        is_same = np.diff(times) <= 0.0
        if is_same.any():
            keep = np.concatenate([[True], ~is_same])
            if not is_motion:
                keep = np.concatenate([~is_same, [True]])
            kept_name = "first" if is_motion else "last"
            remarks.append(
                f"{self.label}: {_count(is_same)} with the time of another; the {kept_name} is "
                "used."
            )
            times, values = times[keep], values[keep]
        self._report_gaps(times, remarks)
        return times, values

    def _sort(self, times: Array, values: Array, remarks: list[str]) -> tuple[Array, Array]:
        steps = np.diff(times)
        is_back = steps < 0.0
        if not is_back.any():
            return times, values
        index = int(np.argmin(steps))
        if steps[index] < -CLOCK_RESET:
            raise ClockReset(
                f"{self.label}: the time goes back from {times[index]:.6g} s to "
                f"{times[index + 1]:.6g} s. Split the log where its clock was set."
            )
        remarks.append(f"{self.label}: {_count(is_back)} out of order; sorted by time.")
        order = np.argsort(times, kind="stable")
        return times[order], values[order]

    def _report_gaps(self, times: Array, remarks: list[str]) -> None:
        gaps = find_gaps(times)
        if gaps:
            periods = ", ".join(
                f"{start:.2f} s to {end:.2f} s" for start, end in gaps[:MAX_REPORTED_GAPS]
            )
            remainder = f" and {len(gaps) - MAX_REPORTED_GAPS} more" if len(gaps) > 3 else ""
            remarks.append(f"{self.label}: no sample from {periods}{remainder}.")


def find_gaps(times: Array) -> list[tuple[float, float]]:
    """Return the beginning and the end of each gap of a series, on the clock of its times [s]."""
    if len(times) < 3:
        return []
    steps = np.diff(times)
    limit = max(GAP_FACTOR * float(np.median(steps)), MIN_GAP)
    return [
        (float(times[index]), float(times[index + 1])) for index in np.flatnonzero(steps > limit)
    ]


def interpolate_commands(times: Array, values: Array) -> tuple[Array, Array]:
    """Return commands that hold for at most `STEP`, on the lines between samples of outputs.

    A controller changes its outputs between two samples of them. A value that is held until the
    next sample is late by half of their interval on average; one on the line between them is not.
    Each interval gets equal parts, with the value of the line at the middle of the part. Intervals
    longer than `MAX_STRETCH` hold their first value.

    Args:
        times: the times of the samples, increasing, (n,) [s].
        values: the samples, (n, k).
    """
    if len(times) < 2:
        return times, values
    intervals = np.diff(times)
    counts = np.where(intervals <= MAX_STRETCH, np.ceil(intervals / STEP - 1e-6), 1.0)
    counts = np.maximum(counts, 1.0).astype(np.int64)
    first_indices = np.cumsum(counts) - counts
    rows = np.repeat(np.arange(len(counts)), counts)
    parts = np.arange(int(counts.sum())) - first_indices[rows]
    is_line = (intervals <= MAX_STRETCH)[rows]
    shares = np.where(is_line, (parts + 0.5) / counts[rows], 0.0)
    part_times = times[rows] + intervals[rows] * parts / counts[rows]
    part_values = values[rows] + shares[:, None] * (values[rows + 1] - values[rows])
    return np.append(part_times, times[-1]), np.vstack([part_values, values[-1:]])


def _count(mask: npt.NDArray[np.bool_]) -> str:
    n = int(mask.sum())
    return "1 sample" if n == 1 else f"{n} samples"
