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
    """A ``<u:onFloor>``: placement on the ground at the x and y of its ``<position>``.

    Of several floors, one over another, the next one below the height of the position is chosen.
    The ground is `terrain` and other scenery that is solid and fixed. The contacts of a placed body
    are those of its collision shape, for an object without `<physics>` of the hull of its mesh.
    `<u:onFloor/>` is sufficient.
    """

    clearance: float = element(
        namespaced=True, default=0.0, minimum=-MAX_CLEARANCE, maximum=MAX_CLEARANCE
    )
    """The height above the ground; below 0 it is sunk in [m]."""
    align_to_slope: bool = element(namespaced=True, default=False)
    """True if it has the slope of the ground under it; else its orientation does not change."""
