"""A depth camera: metric distance along the optical axis, no water, no noise.

.. code-block:: xml

    <virtualRangeImage underwaterParticles="false">
      <name>rangeImage</name> <relativeTo>part0</relativeTo>
      <resw>320</resw> <resh>240</resh>
    </virtualRangeImage>
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from ..geometry import Intrinsics
from ..schema import MAX_DISTANCE, element
from .sensor import OPTICAL_AXES, LookAt, SensorSpec
from .virtual_camera import CameraParametersSpec


@dataclass(frozen=True, kw_only=True)
class VirtualRangeImageSpec(SensorSpec):
    """A ``<virtualRangeImage>``; geometry as that of a `VirtualCameraSpec`."""

    frame_rpy: ClassVar[tuple[float, float, float]] = OPTICAL_AXES

    resw: int = element(default=160, minimum=1, maximum=16384)
    """Columns of the image [px]."""
    resh: int = element(default=120, minimum=1, maximum=16384)
    """Rows of the image [px]."""
    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """Position of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Orientation of the sensor in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """Viewing target at the start, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. It stays fixed to its link."""
    frame_id: str = ""
    """Name of the frame in the headers of image and info."""
    fovy: float = element(default=50.0, above=0, below=180)
    """Vertical field of view [deg]; ignored when there are parameters."""
    parameters: CameraParametersSpec | None = None
    """The pinhole from a calibration."""
    underwater_particles: bool = element(attribute=True, default=False)
    """Whether particles drifting in the water are seen."""

    def intrinsics(self, compatibility: frozenset[str] = frozenset()) -> Intrinsics:
        """Its pinhole; with the compatibility ``y0`` the parameter y0 counts from the bottom."""
        if self.parameters is not None:
            return self.parameters.intrinsics(self.resw, self.resh, compatibility)
        return Intrinsics.from_fovy(self.resw, self.resh, math.radians(self.fovy))
