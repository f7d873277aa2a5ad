"""Depth below the origin of the file's frame.

.. code-block:: xml

    <pressureSensor>
      <name>pressureSensor</name> <relativeTo>base_link</relativeTo> <std>0.02</std>
    </pressureSensor>
"""

from __future__ import annotations

from dataclasses import dataclass

from ..schema import MAX_DISTANCE, element
from .sensor import SensorSpec


@dataclass(frozen=True, kw_only=True)
class PressureSensorSpec(SensorSpec):
    """A ``<pressureSensor>``."""

    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """Position of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Orientation of the sensor in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    std: float = element(default=0.0, minimum=0, maximum=10)
    """Noise of the depth, standard deviation [m]."""
