"""A projector of a pattern of laser light, or a lamp.

.. code-block:: xml

    <structuredLightProjector>
      <name>laser</name> <relativeTo>part0</relativeTo>
      <fov>21</fov> <image_name>data/textures/laser_lines.png</image_name> <laser>1</laser>
    </structuredLightProjector>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..schema import MAX_DISTANCE, element
from .sensor import OPTICAL_AXES, LookAt, SensorSpec


@dataclass(frozen=True, kw_only=True)
class StructuredLightProjectorSpec(SensorSpec):
    """A ``<structuredLightProjector>``: a laser or lamp; it shines an image along -z."""

    frame_rpy: ClassVar[tuple[float, float, float]] = OPTICAL_AXES

    fov: float = element(above=0, below=180)
    """Vertical field of view [deg]; the aspect is the image's."""
    image_name: str = element("image_name")
    """The image: transparent and pure white pixels shine nothing."""
    laser: bool = True
    """1: laser, neither lit nor attenuated on its way; 0: lamp, falling off with distance."""
    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """Position of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Orientation of the sensor in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """Viewing target at the start, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. It stays fixed to its link."""
