"""The path that a body should follow, given by points or a file: ``<u:path>``.

.. code-block:: xml

    <u:path> <u:points> 0 0 4  2 0 4  2 1 4 </u:points> </u:path>
    <u:path> <u:file>survey.csv</u:file> </u:path>

The CSV file has a column for each of x, y and z [m], named in its first line; other columns are not
read. It is in the folder of the benchmark file. The coordinates are in the frame that the element
``<from>`` of `uwsim.benchmark.measures.path_following` names.
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
"""The greatest absolute value of a coordinate [m]."""
COLUMNS = ("x", "y", "z")
"""The columns of the CSV file that are read."""


@dataclass(frozen=True, kw_only=True)
class ReferencePathSpec(Spec):
    """A ``<u:path>`` element."""

    points: Numbers = element(namespaced=True, default=())
    """The x, y and z of each point, one after the other, in the frame ``<from>`` [m]."""
    file: str | None = element(namespaced=True, default=None)
    """A CSV file with the columns x, y and z in the frame ``<from>`` [m], instead of the points.
    The title of a column may state the unit (``x [m]``); any other unit is an error."""

    def errors(self) -> Sequence[str]:
        """Return errors: invalid points, or points and a file together, or neither."""
        if (self.file is not None) == bool(self.points):
            return ["<u:path> needs either <u:points> or <u:file>"]
        if len(self.points) % 3:
            n = len(self.points)
            return [f"<u:points> in <u:path> has {n} numbers; expected x y z of each point"]
        if any(not abs(number) <= MAX_COORDINATE for number in self.points):
            return [f"<u:points> in <u:path> has a number beyond {MAX_COORDINATE:g} m"]
        return []

    def read(self, benchmark: str) -> Array:
        """Return the points in the frame ``<from>``, (n, 3) [m].

        Args:
            benchmark: the path of the benchmark file, in whose folder the CSV file is.

        Raises:
            AssetNotFound: the CSV file does not exist.
            AssetError: the CSV file has no points, or numbers that are too large or not finite.
        """
        if self.file is None:
            return np.array(self.points, dtype=np.float64).reshape(-1, 3)
        table = read_numbers(self.file, benchmark, max_rows=MAX_POINTS)
        points = table.columns(COLUMNS, "m")
        if not len(points):
            raise AssetError(f"{self.file}: has no point.", name=self.file)
        if not (np.abs(points) <= MAX_COORDINATE).all():
            raise AssetError(
                f"{self.file}: expected finite numbers up to {MAX_COORDINATE:g} m.", name=self.file
            )
        return points


def path_message(points: Array) -> Path:
    """Return a nav_msgs/Path through points (n, 3) [m]."""
    poses = []
    for x, y, z in points.tolist():
        pose = PoseStamped()
        pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = x, y, z
        poses.append(pose)
    return Path(poses=poses)
