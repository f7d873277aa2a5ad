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
    """A ``<structuredLightProjector>``: a laser or a lamp that projects an image along -z.

    Only the last projector of a scene emits light, as in the original UWSim. The projector of a
    ghost (``vr``) never does.
    """

    is_left_out: ClassVar[bool] = True
    frame_rpy: ClassVar[tuple[float, float, float]] = OPTICAL_AXES

    name: str
    """The name of the device."""
    relative_to: str
    """The link on which the device is mounted; its pose is relative to the link's kinematic
    frame."""
    fov: float = element(exclusive_minimum=0, exclusive_maximum=180)
    """The vertical field of view [deg]; the aspect ratio is that of the image."""
    image_name: str = element("image_name")
    """The image file; transparent pixels emit no light, and of a laser no black or white ones."""
    laser: bool = True
    """The kind of light: 1 is a laser, which water alone attenuates; 0 is a lamp, whose light falls
    off with distance."""
    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position of the device in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """The orientation of the device in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """The viewing target at the start, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. The device stays fixed to its link."""

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> MountedProjector:
        """Mount the device on its link; raise UnknownName if the vehicle has no such link."""
        mount = vehicle.mount(self, visual="visual-frames" in world.compatibility)
        return MountedProjector(self, mount)


class MountedProjector(Device):
    """A projector on a link."""

    def __init__(self, spec: StructuredLightProjectorSpec, mount: Body) -> None:
        self.spec = spec
        """The properties of the projector."""
        self._mount = mount

    @property
    def link(self) -> str:
        """The name of the link on which the device is mounted: ``vehicle/link``."""
        return self._mount.name

    @property
    def world_from_projector(self) -> Pose:
        """The present pose of the projector in W; its light points along -z."""
        return self._mount.world_from_body
