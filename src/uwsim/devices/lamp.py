"""A dimmable lamp that lights what its vehicle's cameras see; an extension of the dialect.

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
"""Number of lamps that a scene may have."""


@dataclass(frozen=True, kw_only=True)
class LampSpec(DeviceSpec):
    """A ``<u:lamp>``: a round cone of light along -z, as cameras look; at most four in a scene.

    It shines fully until a std_msgs/Float64 on the topic ``<name>/brightness`` dims it: 0 is off,
    1 its whole ``intensity``. Lamps of one name have one topic. The light rate of the scene does
    not dim it. The lamp of a ghost (``vr``) does not shine.
    """

    name: str = element(namespaced=True)
    """Its name, which begins its topic."""
    relative_to: str = element(namespaced=True)
    """The link it rides on; its place counts from the link's kinematic frame."""
    position: tuple[float, float, float] = element(namespaced=True, default=(0.0, 0.0, 0.0))
    """Of the lamp in the link's frame [m]; what is nearer than 0.1 m to it casts no shadow."""
    orientation: tuple[float, float, float] = element(
        namespaced=True, default=(0.0, 0.0, 0.0), parts="rpy"
    )
    """Orientation of the lamp in the link's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """Target of its light at first, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. It stays fixed to its link."""
    fov: float = element(namespaced=True, default=60.0, above=0, maximum=160)
    """Angle of the whole cone [deg]."""
    softness: float = element(namespaced=True, default=0.2, minimum=0, maximum=1)
    """Share of the half angle over which the light fades towards the edge [1]."""
    intensity: float = element(namespaced=True, default=1.0, minimum=0)
    """What it gives to a white surface facing it at 1 m, without water [1: full scale]."""
    color: tuple[float, float, float] = element(
        namespaced=True, default=(1.0, 1.0, 1.0), parts="rgb"
    )
    """Of its light [0..1]."""
    shadow: bool = element(namespaced=True, default=True)
    """Whether bodies in its light cast a shadow."""

    @property
    def brightness_topic(self) -> str:
        """Name of the topic on which its brightness is commanded."""
        return f"{self.name}/brightness"

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """The topic of its brightness."""
        return (DeviceTopic(name=self.brightness_topic, is_heard=True),)

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> MountedLamp:
        """Mount the lamp on its link; raises UnknownName if the vehicle has no such link."""
        lamp = MountedLamp(self, vehicle.mount(self))
        world.bus.subscribe(self.brightness_topic, Float64, lamp.command, remark=odd_brightness)
        return lamp


def odd_brightness(message: Float64) -> Remark | None:
    """Report a brightness that is no share."""
    if math.isnan(message.data):
        return "data is nan", "0 to 1; it is not followed"
    if not 0.0 <= message.data <= 1.0:
        return f"data is {message.data:g}", "0 to 1; the nearest is taken"
    return None


@dataclass(slots=True)
class LampState(Record):
    """How a lamp shines."""

    brightness: float = 1.0
    """The share of its intensity that it gives, 0..1."""


class MountedLamp(Device):
    """A lamp on a link."""

    def __init__(self, spec: LampSpec, mount: Body) -> None:
        self.spec = spec
        """How it shines."""
        self.state: LampState = LampState()
        self._mount = mount

    @property
    def link(self) -> str:
        """Name of the link that it rides on: ``vehicle/link``."""
        return self._mount.name

    @property
    def world_from_lamp(self) -> Pose:
        """The present pose of the lamp; it shines along -z."""
        return self._mount.world_from_body

    @property
    def is_on(self) -> bool:
        """Whether it shines now."""
        return self.state.brightness > 0.0

    @property
    def intensity(self) -> float:
        """What it gives to a white surface facing it at 1 m now [1: full scale]."""
        return self.state.brightness * self.spec.intensity

    def command(self, message: Float64) -> None:
        """Shine as brightly as told, from 0 to 1; what is no number is passed over."""
        if not math.isnan(message.data):
            self.state.brightness = min(1.0, max(0.0, float(message.data)))
