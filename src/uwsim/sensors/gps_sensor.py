"""Position at the surface.

.. code-block:: xml

    <gpsSensor>
      <name>gpsSensor</name> <relativeTo>base_link</relativeTo> <std>0.02</std>
    </gpsSensor>
"""

from __future__ import annotations

from dataclasses import dataclass

from ..schema import MAX_DISTANCE, element
from .sensor import SensorSpec


@dataclass(frozen=True, kw_only=True)
class GpsSensorSpec(SensorSpec):
    """A ``<gpsSensor>``."""

    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """Position of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Orientation of the sensor in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    std: float = element(default=0.0, minimum=0, maximum=10)
    """Noise of each coordinate, standard deviation [m]."""
