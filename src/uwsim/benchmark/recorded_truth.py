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
"""The greatest number of lines."""
SAME_TIME = 5e-4
"""An image is of a line whose time differs by less than this [s]."""
TIME = "time"


@dataclass(frozen=True, kw_only=True)
class RecordedTruthSpec(Spec):
    """A ``<u:truth>`` element."""

    file: str = element(namespaced=True)
    """The CSV file, in the folder of the benchmark."""
    topic: str = element(namespaced=True)
    """Topic on which the truth is published (std_msgs/Float32MultiArray); hidden from the
    algorithm."""
    columns: str = element(namespaced=True, default="")
    """The columns to publish, separated by blanks; without: all but ``time``, in their order."""

    def read(self, benchmark: str) -> RecordedTruth:
        """Read the file.

        Raises:
            AssetNotFound: it is not there.
            AssetError: it lacks a column or a line, or its times do not rise.
        """
        table = read_numbers(self.file, benchmark, at_most=MAX_LINES)
        names: Sequence[str] = self.columns.split() or [n for n in table.header if n != TIME]
        times, values = table.columns([TIME], "s")[:, 0], table.columns(names)
        if not len(times) or not names:
            raise AssetError(f"{self.file}: has no line of numbers.", name=self.file)
        if not (np.isfinite(times).all() and (np.diff(times) > 0.0).all()):
            raise AssetError(f"{self.file}: the column 'time' does not rise.", name=self.file)
        return RecordedTruth(self.topic, names, times, values)


class RecordedTruth:
    """Numbers over the time of a recording.

    Args:
        topic: on which they are published.
        columns: their names.
        times: of the lines, rising, (n,) [s].
        values: at these times, (n, k); NaN: none.
    """

    def __init__(self, topic: str, columns: Sequence[str], times: Array, values: Array) -> None:
        self.topic = topic
        """The topic on which they are published."""
        self.columns = tuple(columns)
        """Their names."""
        self._times, self._values = times, values

    @property
    def span(self) -> tuple[float, float]:
        """The first and the last time of which there are numbers [s]."""
        return float(self._times[0]), float(self._times[-1])

    def at(self, time: float) -> Array:
        """Return the numbers at a time [s] of the recording, (k,); (0,) where there are none."""
        nearest = int(np.argmin(np.abs(self._times - time)))
        found = self._values[nearest]
        if abs(self._times[nearest] - time) > SAME_TIME:
            after = int(np.searchsorted(self._times, time))
            if not 0 < after < len(self._times):
                return np.zeros(0)
            first, second = self._times[after - 1], self._times[after]
            share = (time - first) / (second - first)
            found = (1.0 - share) * self._values[after - 1] + share * self._values[after]
        return found if np.isfinite(found).all() else np.zeros(0)
