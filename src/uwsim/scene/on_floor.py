"""Placement of vehicles and objects on the ground, ``<u:onFloor>``.

.. code-block:: xml

    <object> <name>amphora</name> ... <position> <x>3</x> <y>1</y> <z>0</z> </position>
      <u:onFloor> <u:clearance>0.02</u:clearance> <u:alignToSlope>1</u:alignToSlope> </u:onFloor>
    </object>
"""

from __future__ import annotations

from dataclasses import dataclass

from ..schema import Spec, element

MAX_CLEARANCE = 1e4
"""The greatest distance from the ground [m]."""


@dataclass(frozen=True, kw_only=True)
class OnFloorSpec(Spec):
    """A ``<u:onFloor>``: placement on the ground at the x and y of the body's ``<position>``.

    The ground is `terrain` and other objects that are solid and fixed. Of several surfaces above
    one another, the body is placed on the highest below its position. Its collision shape touches
    the ground; for an object without `<physics>` this is the convex hull of its mesh.
    `<u:onFloor/>` is sufficient. The line of a `<u:course>` follows the ground instead, and
    `<u:clearance>` is its height above the ground.
    """

    clearance: float = element(
        namespaced=True, default=0.0, minimum=-MAX_CLEARANCE, maximum=MAX_CLEARANCE
    )
    """The height above the ground; below 0 the body is sunk into the ground [m]."""
    align_to_slope: bool = element(namespaced=True, default=False)
    """True if the body is tilted to the slope of the ground; else it keeps its orientation."""
