"""The truth of recorded images, from a CSV file: ``<u:truth>`` of a ``<bagFogUpdater>``.

.. code-block:: text

    time [s],nw_x [px],nw_y [px]
    0.000,101.5,88.0
    0.033,101.9,88.2
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from ..errors import AssetError
from ..schema import Spec, element
from .number_table import read_numbers

MAX_LINES = 1_000_000
"""The greatest number of lines of the CSV file."""
TIME_TOLERANCE = 5e-4
"""The greatest difference between the time of an image and the time in its line [s]."""
TIME_COLUMN = "time"
"""The column with the time since the first image of the recording [s]."""


@dataclass(frozen=True, kw_only=True)
class RecordedTruthSpec(Spec):
    """A ``<u:truth>`` element."""

    file: str = element(namespaced=True)
    """The CSV file, in the folder of the benchmark."""
    topic: str = element(namespaced=True)
    """The topic of the truth (std_msgs/Float32MultiArray); hidden from the algorithm."""
    columns: str = element(namespaced=True, default="")
    """The columns to publish, separated by blanks; if absent, all columns except ``time``."""

    def read(self, benchmark: str) -> RecordedTruth:
        """Read the CSV file.

        Args:
            benchmark: the path of the benchmark file, in whose folder the CSV file is.

        Raises:
            AssetNotFound: the CSV file does not exist.
            AssetError: the CSV file lacks a column, has no line, or its times do not increase.
        """
        table = read_numbers(self.file, benchmark, max_rows=MAX_LINES)
        names: Sequence[str] = self.columns.split() or [n for n in table.header if n != TIME_COLUMN]
        times, values = table.columns([TIME_COLUMN], "s")[:, 0], table.columns(names)
        if not len(times) or not names:
            raise AssetError(f"{self.file}: has no line of numbers.", name=self.file)
        if not (np.isfinite(times).all() and (np.diff(times) > 0.0).all()):
            raise AssetError(f"{self.file}: the column 'time' does not increase.", name=self.file)
        return RecordedTruth(self.topic, names, times, values)


class RecordedTruth:
    """The truth of recorded images as a function of the time since the first image.

    Args:
        topic: the topic on which the numbers are published.
        columns: the names of the k columns that are published.
        times: the times of the n lines, which increase, (n,) [s].
        values: the numbers in these lines, (n, k); NaN for an empty cell.
    """

    def __init__(self, topic: str, columns: Sequence[str], times: Array, values: Array) -> None:
        self.topic = topic
        """The topic on which the numbers are published."""
        self.columns = tuple(columns)
        """The names of the columns that are published."""
        self._times, self._values = times, values

    @property
    def span(self) -> tuple[float, float]:
        """The first and the last time in the file [s]."""
        return float(self._times[0]), float(self._times[-1])

    def find_values(self, time: float) -> Array:
        """Return the numbers at a time [s], (k,), interpolated; (0,) if there is no truth then."""
        nearest_row = int(np.argmin(np.abs(self._times - time)))
        values = self._values[nearest_row]
        if abs(self._times[nearest_row] - time) > TIME_TOLERANCE:
            next_row = int(np.searchsorted(self._times, time))
            if not 0 < next_row < len(self._times):
                return np.zeros(0)
            last_time, next_time = self._times[next_row - 1], self._times[next_row]
            fraction = (time - last_time) / (next_time - last_time)
            start, end = self._values[next_row - 1], self._values[next_row]
            values = (1.0 - fraction) * start + fraction * end
        return values if np.isfinite(values).all() else np.zeros(0)
