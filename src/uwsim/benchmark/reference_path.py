"""The path that a body should follow, given by points or a file: ``<u:path>``.

.. code-block:: xml

    <u:path> <u:points> 0 0 4  2 0 4  2 1 4 </u:points> </u:path>
    <u:path> <u:file>survey.csv</u:file> </u:path>

The file has a column for each of x, y and z [m], named in its first line; other columns are not
read. It is searched in the folder of the benchmark.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from ..errors import AssetError
from ..messages import Path, PoseStamped
from ..schema import Numbers, Spec, element
from .number_table import read_numbers

MAX_POINTS = 100_000
"""The greatest number of points."""
MAX_COORDINATE = 1e6
"""The greatest coordinate [m]."""
COLUMNS = ("x", "y", "z")


@dataclass(frozen=True, kw_only=True)
class ReferencePathSpec(Spec):
    """A ``<u:path>`` element."""

    points: Numbers = element(namespaced=True, default=())
    """The x, y and z of each point, one after the other [m]."""
    file: str | None = element(namespaced=True, default=None)
    """A CSV file with the columns x, y and z [m], instead of the points. A header may state the
    unit (`x [m]`); another one is an error."""

    def errors(self) -> Sequence[str]:
        """Return errors of the points, and of the choice between points and file."""
        if (self.file is not None) == bool(self.points):
            return ["<u:path> needs either <u:points> or <u:file>"]
        if len(self.points) % 3:
            n = len(self.points)
            return [f"<u:points> in <u:path> has {n} numbers; expected x y z of each point"]
        if any(not abs(number) <= MAX_COORDINATE for number in self.points):
            return [f"<u:points> in <u:path> has a number beyond {MAX_COORDINATE:g} m"]
        return []

    def read(self, benchmark: str) -> Array:
        """Return the points, (n, 3) [m].

        Args:
            benchmark: the benchmark file, in whose folder the file of points is searched.

        Raises:
            AssetNotFound: the file does not exist.
            AssetError: it has no points, or numbers that are not finite.
        """
        if self.file is None:
            return np.array(self.points, dtype=np.float64).reshape(-1, 3)
        table = read_numbers(self.file, benchmark, at_most=MAX_POINTS)
        points = table.columns(COLUMNS, "m")
        if not len(points):
            raise AssetError(f"{self.file}: has no point.", name=self.file)
        if not (np.abs(points) <= MAX_COORDINATE).all():
            raise AssetError(
                f"{self.file}: expected finite numbers up to {MAX_COORDINATE:g} m.", name=self.file
            )
        return points


def path_message(points: Array) -> Path:
    """Return points (n, 3) [m] as a message."""
    poses = []
    for x, y, z in points.tolist():
        pose = PoseStamped()
        pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = x, y, z
        poses.append(pose)
    return Path(poses=poses)
