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

from ..base.geometry import Pose
from ..schema import MAX_DISTANCE, element
from ..sensors.sensor import OPTICAL_AXES, LookAt
from ..world import Body, DeviceWorld
from .device import Device, DeviceSpec, DeviceVehicle


@dataclass(frozen=True, kw_only=True)
class StructuredLightProjectorSpec(DeviceSpec):
    """A ``<structuredLightProjector>``: a laser or lamp; it shines an image along -z.

    Of several in a scene the last one shines, as in the original; that of a ghost (``vr``) never.
    """

    is_left_out: ClassVar[bool] = True
    frame_rpy: ClassVar[tuple[float, float, float]] = OPTICAL_AXES

    name: str
    """Its name."""
    relative_to: str
    """The link it rides on; its place counts from the link's kinematic frame."""
    fov: float = element(above=0, below=180)
    """Vertical field of view [deg]; the aspect is the image's."""
    image_name: str = element("image_name")
    """The image; its transparent pixels shine nothing, nor the black and white ones of a laser."""
    laser: bool = True
    """1: laser, as bright at any distance but for the water; 0: lamp, falling off with distance."""
    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """Position of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Orientation of the sensor in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """Viewing target at the start, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. It stays fixed to its link."""

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> MountedProjector:
        """Mount it on its link; raises UnknownName if the vehicle has no such link."""
        mount = vehicle.mount(self, visual="visual-frames" in world.compatibility)
        return MountedProjector(self, mount)


class MountedProjector(Device):
    """A projector on a link."""

    def __init__(self, spec: StructuredLightProjectorSpec, mount: Body) -> None:
        self.spec = spec
        """How it shines."""
        self._mount = mount

    @property
    def link(self) -> str:
        """Name of the link that it rides on: ``vehicle/link``."""
        return self._mount.name

    @property
    def world_from_projector(self) -> Pose:
        """The present pose of the projector; it shines along -z."""
        return self._mount.world_from_body
