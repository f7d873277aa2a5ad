r"""The course of a pipe, a cable or a chain: a line along which a mesh is repeated and bent.

.. code-block:: xml

    <object> <name>pipe</name> <file>objects/pipe_flanged.glb</file>
      <u:course>
        <u:points> -9 0 15  -2 1 15  4 -3 15 </u:points> <u:bendRadius>2</u:bendRadius>
        <u:buriedShare>0.2</u:buriedShare> <u:buriedStretches>2</u:buriedStretches>
      </u:course>
    </object>

Copies of the mesh, end to end along its y axis, follow the line. They are stretched so that a whole
number of them is as long as the line. A vertex at :math:`(x, y, z)` of a copy comes to

.. math:: c(y) + x\, (t \times n) + z\, n

with the point c at the length y of the line, the direction t of the line there, and the unit vector
n across t that is nearest to the object's z axis. Not modelled: the change of length on the inner
and the outer side of a bend, bending stiffness, and motion; a course is fixed.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from ..base.numerics.polyline import round_corners
from ..schema import MAX_DISTANCE, Numbers, Spec, element

ARC_SPACING = 0.05
"""The greatest length of arc between two points of a bend [m]."""
MAX_LENGTH = 2000.0
"""The greatest length of a course [m]."""
MAX_STRETCHES = 1000
"""The greatest number of buried stretches."""


@dataclass(frozen=True, kw_only=True)
class CourseSpec(Spec):
    """A ``<u:course>`` of an object: the line along which its mesh is repeated and bent.

    With `<u:onFloor>`, the line lies on the ground, of which it evens out the relief over 2 m; its
    clearance is the height of the line above the ground.
    """

    points: Numbers = element(namespaced=True)
    """The x, y and z of each corner of the line, one after the other, in the object's frame [m]."""
    bend_radius: float = element(namespaced=True, default=0.0, minimum=0.0, maximum=MAX_DISTANCE)
    """The radius of the arc that replaces each corner, smaller where the line is too short [m]."""
    buried_share: float = element(namespaced=True, default=0.0, minimum=0.0, maximum=1.0)
    """The share of the line's length that is buried [1]."""
    buried_stretches: int = element(namespaced=True, default=1, minimum=1, maximum=MAX_STRETCHES)
    """The number of buried stretches, of equal length and at equal distances."""
    burial_depth: float = element(namespaced=True, default=0.4, minimum=0.0, maximum=MAX_DISTANCE)
    """The depth by which buried stretches are below the line [m]."""

    def errors(self) -> Iterator[str]:
        """Yield errors of points that are no line."""
        n = len(self.points)
        if n % 3 or n < 6:
            yield f"<u:points> has {n} numbers; expected x y z of two points at least"
            return
        if not all(abs(number) <= MAX_DISTANCE for number in self.points):
            yield f"<u:points> has a number beyond {MAX_DISTANCE:g} m"
            return
        steps = np.diff(np.array(self.points).reshape(-1, 3), axis=0)
        lengths = np.sqrt(np.sum(steps * steps, axis=1))
        if not lengths.all():
            yield "<u:points> repeats a point; expected each point away from the one before it"
        if lengths.sum() > MAX_LENGTH:
            yield f"<u:course> is {lengths.sum():.0f} m long; expected at most {MAX_LENGTH:g} m"

    @property
    def line(self) -> Array:
        """The points of the line with its bends, as if nothing were buried, (n, 3) [m]."""
        corners = np.array(self.points, dtype=np.float64).reshape(-1, 3)
        return round_corners(corners, self.bend_radius, ARC_SPACING)
