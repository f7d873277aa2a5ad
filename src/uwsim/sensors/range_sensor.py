"""One ray along +x: the distance to the first surface.

.. code-block:: xml

    <rangeSensor>
      <name>sonar</name> <relativeTo>part0</relativeTo> <range>10</range> <visible>0</visible>
    </rangeSensor>
"""

from __future__ import annotations

from dataclasses import dataclass

from ..schema import MAX_DISTANCE, element
from .sensor import LookAt, SensorSpec


@dataclass(frozen=True, kw_only=True)
class RangeSensorSpec(SensorSpec):
    """A ``<rangeSensor>``."""

    range: float = element(minimum=0, maximum=MAX_DISTANCE)
    """Length of the ray; the value when nothing is hit [m]."""
    visible: bool = False
    """Whether the viewer draws the ray."""
    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """Of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Of the sensor in the link's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """Where it looks at the start, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. It stays fixed to its link."""
