"""A red and a green lamp that flash on command.

.. code-block:: xml

    <LedArray>
      <name>leds</name> <relativeTo>base_link</relativeTo>
      <position> <x>0</x> <y>0</y> <z>0</z> </position>
      <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
      <radio>0.02</radio> <space>0.2</space>
    </LedArray>
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from ..base.geometry import Pose
from ..base.record import Record
from ..messages import LedLight
from ..schema import REQUIRED_BY_DTD, element
from ..world import Body, DeviceWorld
from .device import Device, DeviceSpec, DeviceTopic, DeviceVehicle
from .lamp import LampSpec

INTENSITY = 0.83
"""The radiance of a white surface that faces a lamp at 1 m, as in UWSim [1: full scale]."""
COLOURS = {"red": (1.0, 0.0, 0.0), "green": (0.0, 1.0, 0.0)}
"""The colours of the lamps by name; the first lamp is at +y."""


@dataclass(frozen=True, kw_only=True)
class LedArraySpec(DeviceSpec):
    """A ``<LedArray>``: two signal lamps; topics ``<name>/red`` and ``<name>/green``.

    After an ``underwater_sensor_msgs/LedLight``, a lamp emits light in all directions for the
    duration in the message.
    """

    OCCURS_ONCE: ClassVar[bool] = True
    is_left_out: ClassVar[bool] = True

    name: str
    """The name of the device, which begins its topics."""
    relative_to: str
    """The link on which the device is mounted."""
    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), original=REQUIRED_BY_DTD
    )
    """The position of the device in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), parts="rpy", original=REQUIRED_BY_DTD
    )
    """The orientation of the device in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    radio: float = element(default=0.02, exclusive_minimum=0)
    """The radius of each lamp [m]."""
    space: float = 0.2
    """The distance between the lamps, along y of the device [m]."""

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """The topics that switch the lamps on."""
        return tuple(
            DeviceTopic(name=f"{self.name}/{colour}", is_subscribed=True, message_type=LedLight)
            for colour in COLOURS
        )

    @property
    def positions(self) -> dict[str, tuple[float, float, float]]:
        """The position of each lamp in the link's frame, by its colour [m]."""
        link_from_array = Pose.from_rpy(self.position, self.orientation)
        half = 0.5 * self.space
        ends = np.array([[0.0, half, 0.0], [0.0, -half, 0.0]])
        red, green = link_from_array.transform(ends).tolist()
        return {"red": tuple(red), "green": tuple(green)}

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> LedArray:
        """Mount the lamps on their link; raise UnknownName if the vehicle has no such link."""
        leds = []
        for colour, position in self.positions.items():
            mount = vehicle.mount(replace(self, position=position))
            spec = LampSpec(
                name=f"{self.name}/{colour}",
                relative_to=self.relative_to,
                fov=360.0,
                softness=0.0,
                intensity=INTENSITY,
                color=COLOURS[colour],
                shadow=False,
            )
            led = Led(spec, mount, lambda: world.time)
            world.bus.subscribe(spec.name, LedLight, led.command)
            leds.append(led)
        return LedArray(tuple(leds))


@dataclass(slots=True)
class LedState(Record):
    """The state of a signal lamp."""

    end_time: float = 0.0
    """The time until which the lamp is on [s]."""


@dataclass(slots=True)
class LedArrayState(Record):
    """The state of an array of signal lamps."""

    leds: list[LedState]
    """The state of each lamp."""


class Led:
    """A signal lamp."""

    def __init__(self, spec: LampSpec, mount: Body, clock: Callable[[], float]) -> None:
        self.spec = spec
        """The properties of the lamp."""
        self._mount, self._clock = mount, clock
        self.state = LedState()
        """The state of the lamp."""

    @property
    def link(self) -> str:
        """The name of the link on which the lamp is mounted: ``vehicle/link``."""
        return self._mount.name

    @property
    def world_from_lamp(self) -> Pose:
        """The present pose of the lamp in W."""
        return self._mount.world_from_body

    @property
    def is_on(self) -> bool:
        """True if the lamp is on now."""
        return self._clock() < self.state.end_time

    @property
    def intensity(self) -> float:
        """The radiance of a white surface that faces the lamp at 1 m [1: full scale]."""
        return self.spec.intensity

    def command(self, message: LedLight) -> None:
        """Switch the lamp on for the commanded duration, which replaces an earlier one."""
        self.state.end_time = self._clock() + message.duration.sec + 1e-9 * message.duration.nanosec


class LedArray(Device):
    """A red and a green lamp."""

    def __init__(self, leds: tuple[Led, ...]) -> None:
        self.leds = leds
        """The lamps."""
        self.state: LedArrayState = LedArrayState([led.state for led in leds])
