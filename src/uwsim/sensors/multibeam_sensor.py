"""A fan of beams in the sensor's y-z plane.

.. code-block:: xml

    <multibeamSensor underwaterParticles="false">
      <name>multibeam</name> <relativeTo>part0</relativeTo>
      <initAngle>-60</initAngle> <finalAngle>60</finalAngle> <angleIncr>0.1</angleIncr>
      <range>10</range>
    </multibeamSensor>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..schema import MAX_DISTANCE, element
from .sensor import SCAN_AXES, LookAt, SensorSpec


@dataclass(frozen=True, kw_only=True)
class MultibeamSensorSpec(SensorSpec):
    """A ``<multibeamSensor>``."""

    frame_rpy: ClassVar[tuple[float, float, float]] = SCAN_AXES

    visible: bool = False
    """Whether the viewer draws the beams."""
    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """Of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Of the sensor in the link's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """Where it looks at the start, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. It stays fixed to its link."""
    init_angle: float
    """Angle of the first beam; 0 is -z, positive towards +y [deg]."""
    final_angle: float
    """Angle of the last beam [deg]."""
    angle_incr: float = element(above=0)
    """Angle between beams [deg]."""
    range: float = element(above=0, maximum=MAX_DISTANCE)
    """Longest distance measured; the value of a beam that hits nothing [m]."""
    underwater_particles: bool = element(attribute=True, default=False)
    """Whether particles drifting in the water are seen."""

    @property
    def n_beams(self) -> int:
        """Number of beams, as the original counts them."""
        return int(abs(self.final_angle - self.init_angle) / self.angle_incr) + 1
