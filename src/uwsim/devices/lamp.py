"""A dimmable lamp that lights the scene for cameras; an extension of the dialect.

.. code-block:: xml

    <u:lamp>
      <u:name>headlight</u:name> <u:relativeTo>base_link</u:relativeTo>
      <u:position> <x>0.7</x> <y>0</y> <z>0</z> </u:position>
      <u:orientation> <r>0</r> <p>M_PI</p> <y>M_PI_2</y> </u:orientation>
      <u:fov>60</u:fov> <u:intensity>2</u:intensity>
    </u:lamp>
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..base.geometry import Pose
from ..base.record import Record
from ..bus import Remark
from ..messages import Float64
from ..schema import element
from ..sensors.sensor import LookAt
from ..world import Body, DeviceWorld
from .device import Device, DeviceSpec, DeviceTopic, DeviceVehicle

MAX_LAMPS = 4
"""The greatest number of lamps in a scene."""


@dataclass(frozen=True, kw_only=True)
class LampSpec(DeviceSpec):
    """A ``<u:lamp>``: a round cone of light along -z; at most four in a scene.

    The brightness is 1 (the whole ``intensity``) until a std_msgs/Float64 on the topic
    ``<name>/brightness`` sets it to a value between 0 (off) and 1. Lamps with equal names share a
    topic. The light rate of the scene does not affect lamps. The lamp of a ghost (``vr``) is off.
    """

    name: str = element(namespaced=True)
    """The name of the lamp, which begins its topic."""
    relative_to: str = element(namespaced=True)
    """The link on which the lamp is mounted; its pose is relative to the link's kinematic frame."""
    position: tuple[float, float, float] = element(namespaced=True, default=(0.0, 0.0, 0.0))
    """The position of the lamp in the link's frame [m]; bodies within 0.1 m cast no shadow."""
    orientation: tuple[float, float, float] = element(
        namespaced=True, default=(0.0, 0.0, 0.0), parts="rpy"
    )
    """The orientation of the lamp in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """The target of the light at the start, instead of ``orientation``: a point in L [m], or a
    direction of the vehicle. The lamp stays fixed to its link."""
    fov: float = element(namespaced=True, default=60.0, exclusive_minimum=0, maximum=160)
    """The angle of the whole cone [deg]."""
    softness: float = element(namespaced=True, default=0.2, minimum=0, maximum=1)
    """The fraction of the half angle over which the light fades towards the edge [1]."""
    intensity: float = element(namespaced=True, default=1.0, minimum=0)
    """The radiance of a white surface that faces the lamp at 1 m, without water [1: full scale]."""
    color: tuple[float, float, float] = element(
        namespaced=True, default=(1.0, 1.0, 1.0), parts="rgb"
    )
    """The colour of the light [0..1]."""
    shadow: bool = element(namespaced=True, default=True)
    """True if bodies in the light cast shadows."""

    @property
    def brightness_topic(self) -> str:
        """The name of the topic that commands the brightness."""
        return f"{self.name}/brightness"

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """The topic that commands the brightness."""
        return (DeviceTopic(name=self.brightness_topic, is_subscribed=True, message_type=Float64),)

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> MountedLamp:
        """Mount the lamp on its link; raise UnknownName if the vehicle has no such link."""
        lamp = MountedLamp(self, vehicle.mount(self))
        world.bus.subscribe(self.brightness_topic, Float64, lamp.command, remark=check_brightness)
        return lamp


def check_brightness(message: Float64) -> Remark | None:
    """Report a brightness outside 0 to 1."""
    if math.isnan(message.data):
        return "data is nan", "0 to 1; it is ignored"
    if not 0.0 <= message.data <= 1.0:
        return f"data is {message.data:g}", "0 to 1; it is clamped"
    return None


@dataclass(slots=True)
class LampState(Record):
    """The state of a lamp."""

    brightness: float = 1.0
    """The fraction of the intensity at which the lamp shines, 0..1 [1]."""


class MountedLamp(Device):
    """A lamp on a link."""

    def __init__(self, spec: LampSpec, mount: Body) -> None:
        self.spec = spec
        """The properties of the lamp."""
        self.state: LampState = LampState()
        self._mount = mount

    @property
    def link(self) -> str:
        """The name of the link on which the lamp is mounted: ``vehicle/link``."""
        return self._mount.name

    @property
    def world_from_lamp(self) -> Pose:
        """The present pose of the lamp in W; its light points along -z."""
        return self._mount.world_from_body

    @property
    def is_on(self) -> bool:
        """True if the lamp is on now."""
        return self.state.brightness > 0.0

    @property
    def intensity(self) -> float:
        """The radiance of a white surface that faces the lamp at 1 m now [1: full scale]."""
        return self.state.brightness * self.spec.intensity

    def command(self, message: Float64) -> None:
        """Set the brightness, clamped to the range 0 to 1; ignore nan."""
        if not math.isnan(message.data):
            self.state.brightness = min(1.0, max(0.0, float(message.data)))
