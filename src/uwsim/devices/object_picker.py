"""Picks up the first object that its ray along +x hits.

.. code-block:: xml

    <objectPicker>
      <name>picker</name> <relativeTo>part4_base</relativeTo> <range>0.5</range>
    </objectPicker>
"""

from __future__ import annotations

from dataclasses import dataclass

from ..schema import element
from ..sensors.sensor import LookAt


@dataclass(frozen=True, kw_only=True)
class ObjectPickerSpec:
    """An ``<objectPicker>``; it rides on the link's visual frame."""

    name: str
    """Its name."""
    relative_to: str
    """The link it rides on."""
    range: float = element(minimum=0)
    """Length of the ray [m]."""
    visible: bool = False
    """Read and not used: the ray is always drawn."""
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Position of the device in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Orientation of the device in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """Viewing target at the start, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. It stays fixed to its link."""
