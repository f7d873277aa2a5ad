"""The path that a body should follow, given by points or a file: ``<u:path>``.

.. code-block:: xml

    <u:path> <u:points> 0 0 4  2 0 4  2 1 4 </u:points> </u:path>
    <u:path> <u:file>survey.csv</u:file> </u:path>
    <u:path> <u:object>pipe</u:object> <u:height>1.2</u:height> </u:path>

The third one follows the line of an object with a ``<u:course>``, at a height above it. The CSV
file has a column for each of x, y and z [m], named in its first line; other columns are not read.
It is in the folder of the benchmark file. The coordinates are in the frame that the element
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
from ..world import World
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

    object: str | None = element(namespaced=True, default=None, refers_to="course")
    """The object with a `<u:course>` whose line is the path, instead of points; not with
    ``<from>``. Buried stretches count as if they were not buried."""
    height: float = element(
        namespaced=True, default=0.0, minimum=-MAX_COORDINATE, maximum=MAX_COORDINATE
    )
    """The height of the path above the object's line [m]."""
    points: Numbers = element(namespaced=True, default=())
    """The x, y and z of each point, one after the other, in the frame ``<from>`` [m]."""
    file: str | None = element(namespaced=True, default=None)
    """A CSV file with the columns x, y and z in the frame ``<from>`` [m], instead of the points.
    The title of a column may state the unit (``x [m]``); any other unit is an error."""

    def errors(self) -> Sequence[str]:
        """Return errors: invalid points, or other than one of points, file and object."""
        n_sources = (self.file is not None) + bool(self.points) + (self.object is not None)
        if n_sources != 1:
            return ["<u:path> needs one of <u:points>, <u:file> and <u:object>"]
        if self.object is None and self.height:
            return ["<u:height> in <u:path> is that above an <u:object>; remove it"]
        if len(self.points) % 3:
            n = len(self.points)
            return [f"<u:points> in <u:path> has {n} numbers; expected x y z of each point"]
        if any(not abs(number) <= MAX_COORDINATE for number in self.points):
            return [f"<u:points> in <u:path> has a number beyond {MAX_COORDINATE:g} m"]
        return []

    def read(self, benchmark: str, world: World) -> Array:
        """Return the points in the frame ``<from>``, (n, 3) [m]; those of an object are in W.

        Args:
            benchmark: the path of the benchmark file, in whose folder the CSV file is.
            world: the scene, which may have the object.

        Raises:
            UnknownName: the scene has no such object with a course.
            AssetNotFound: the CSV file does not exist.
            AssetError: the CSV file has no points, or numbers that are too large or not finite.
        """
        if self.object is not None:
            points: Array = world.surroundings.course(self.object) + np.array(
                [0.0, 0.0, self.height]
            )
            return points
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
