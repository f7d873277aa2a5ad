"""A red and a green lamp that flash on command.

.. code-block:: xml

    <LedArray>
      <name>leds</name> <relativeTo>base_link</relativeTo>
      <position> <x>0</x> <y>0</y> <z>0</z> </position>
      <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
      <radio>0.02</radio> <space>0.2</space>
    </LedArray>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..schema import REQUIRED, element


@dataclass(frozen=True, kw_only=True)
class LedArraySpec:
    """A ``<LedArray>``: two signal lamps; topics ``<name>/red`` and ``<name>/green``."""

    STANDS_ONCE: ClassVar[bool] = True

    name: str
    """Its name, which begins its topics."""
    relative_to: str
    """The link it rides on."""
    position: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), original=REQUIRED)
    """Position of the device in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), parts="rpy", original=REQUIRED
    )
    """Orientation of the device in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    radio: float = element(default=0.02, above=0)
    """Radius of each lamp [m]."""
    space: float = 0.2
    """Distance between the lamps, along y [m]."""
