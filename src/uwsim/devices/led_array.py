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
"""What a lamp gives to a white surface facing it at 1 m, as in the original [1: full scale]."""
COLOURS = {"red": (1.0, 0.0, 0.0), "green": (0.0, 1.0, 0.0)}
"""Of the lamps, in their order; the first is at +y."""


@dataclass(frozen=True, kw_only=True)
class LedArraySpec(DeviceSpec):
    """A ``<LedArray>``: two signal lamps; topics ``<name>/red`` and ``<name>/green``.

    A lamp shines in all directions for the time that an ``underwater_sensor_msgs/LedLight`` says.
    """

    OCCURS_ONCE: ClassVar[bool] = True
    is_left_out: ClassVar[bool] = True

    name: str
    """Its name, which begins its topics."""
    relative_to: str
    """The link it rides on."""
    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), original=REQUIRED_BY_DTD
    )
    """Position of the device in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), parts="rpy", original=REQUIRED_BY_DTD
    )
    """Orientation of the device in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    radio: float = element(default=0.02, above=0)
    """Radius of each lamp [m]."""
    space: float = 0.2
    """Distance between the lamps, along y [m]."""

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """The topics of its lamps."""
        return tuple(DeviceTopic(name=f"{self.name}/{colour}", is_heard=True) for colour in COLOURS)

    @property
    def places(self) -> dict[str, tuple[float, float, float]]:
        """Where each lamp is in the link's frame, by its colour [m]."""
        link_from_array = Pose.from_rpy(self.position, self.orientation)
        half = 0.5 * self.space
        ends = np.array([[0.0, half, 0.0], [0.0, -half, 0.0]])
        red, green = link_from_array.transform(ends).tolist()
        return {"red": tuple(red), "green": tuple(green)}

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> LedArray:
        """Mount the lamps on their link; raises UnknownName if the vehicle has no such link."""
        leds = []
        for colour, place in self.places.items():
            mount = vehicle.mount(replace(self, position=place))
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
    """How long a signal lamp shines."""

    until: float = 0.0
    """The time before which it shines [s]."""


@dataclass(slots=True)
class LedArrayState(Record):
    """How long signal lamps shine."""

    leds: list[LedState]
    """How long each does."""


class Led:
    """One signal lamp."""

    def __init__(self, spec: LampSpec, mount: Body, clock: Callable[[], float]) -> None:
        self.spec = spec
        """How it shines."""
        self._mount, self._clock = mount, clock
        self.state = LedState()
        """How long it shines."""

    @property
    def link(self) -> str:
        """Name of the link that it rides on: ``vehicle/link``."""
        return self._mount.name

    @property
    def world_from_lamp(self) -> Pose:
        """The present pose of the lamp."""
        return self._mount.world_from_body

    @property
    def is_on(self) -> bool:
        """Whether it shines now."""
        return self._clock() < self.state.until

    @property
    def intensity(self) -> float:
        """What it gives to a white surface facing it at 1 m [1: full scale]."""
        return self.spec.intensity

    def command(self, message: LedLight) -> None:
        """Shine from now on for a time, whatever was said before."""
        self.state.until = self._clock() + message.duration.sec + 1e-9 * message.duration.nanosec


class LedArray(Device):
    """A red and a green lamp."""

    def __init__(self, leds: tuple[Led, ...]) -> None:
        self.leds = leds
        """The lamps."""
        self.state: LedArrayState = LedArrayState([led.state for led in leds])
