"""The wrench of contacts on a link.

.. code-block:: xml

    <ForceSensor>
      <name>ForceG500</name> <target>base_link</target>
      <offsetp> <x>-0.2</x> <y>0.75</y> <z>0</z> </offsetp>
      <offsetr> <x>-1.57</x> <y>0</y> <z>3.14</z> </offsetr>
    </ForceSensor>
"""

from __future__ import annotations

from dataclasses import dataclass

from ..schema import REQUIRED, element


@dataclass(frozen=True, kw_only=True)
class ForceSensorSpec:
    """A ``<ForceSensor>``; it rides on the link's visual frame."""

    name: str
    """Its name."""
    target: str
    """The link it belongs to."""
    offsetp: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), original=REQUIRED)
    """Of the sensor on the link [m]."""
    offsetr: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), original=REQUIRED)
    """Of the sensor on the link, about x, y, z: Rz Ry Rx [rad]."""
