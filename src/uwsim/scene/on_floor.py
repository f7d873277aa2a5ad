"""Placing vehicles and objects on the ground, ``<u:onFloor>``.

.. code-block:: xml

    <object> <name>amphora</name> ... <position> <x>3</x> <y>1</y> <z>0</z> </position>
      <u:onFloor> <u:clearance>0.02</u:clearance> <u:alignToSlope>1</u:alignToSlope> </u:onFloor>
    </object>
"""

from __future__ import annotations

from dataclasses import dataclass

from ..schema import Spec, element

MAX_CLEARANCE = 1e4
"""[m]"""


@dataclass(frozen=True, kw_only=True)
class OnFloorSpec(Spec):
    """A ``<u:onFloor>``: it stands on the ground at the x and y of its ``<position>``.

    Whatever height the position says; that chooses the floor where several lie one over another:
    the next one below it. The ground is `terrain` and other scenery that is solid and fixed. What
    stands on it touches it with its collision shape, an object without `<physics>` with the hull of
    its mesh. `<u:onFloor/>` is enough.
    """

    clearance: float = element(
        namespaced=True, default=0.0, minimum=-MAX_CLEARANCE, maximum=MAX_CLEARANCE
    )
    """Height above the ground; below 0 it is sunk in [m]."""
    align_to_slope: bool = element(namespaced=True, default=False)
    """Whether it leans as the ground under it does; else its orientation stays."""
