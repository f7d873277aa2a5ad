"""A sonar whose beam steps over a sector (from a branch of UWSim that users run).

.. code-block:: xml

    <ProfilingSonar>
      <name>profiler</name> <relativeTo>base_link</relativeTo>
      <initAngle>-60</initAngle> <finalAngle>60</finalAngle> <angleIncr>1</angleIncr>
      <range>10</range> <fov>2</fov>
    </ProfilingSonar>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..schema import MAX_DISTANCE, element
from .sensor import SCAN_AXES, LookAt, SensorSpec


@dataclass(frozen=True, kw_only=True)
class ProfilingSonarSpec(SensorSpec):
    """A ``<ProfilingSonar>``."""

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
    fov: float = element(above=0)
    """Width of the beam [deg]."""
