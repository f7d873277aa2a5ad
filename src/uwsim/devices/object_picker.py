"""Picks up the first object that its ray along +x hits.

.. code-block:: xml

    <objectPicker>
      <name>picker</name> <relativeTo>part4_base</relativeTo> <range>0.5</range>
    </objectPicker>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..base.record import Record
from ..messages import Bool, Range, header
from ..schema import element
from ..sensors.sensor import LookAt
from ..world import Body, DeviceWorld
from .device import Device, DeviceSpec, DeviceTopic, DeviceVehicle

RATE = 60.0
"""How often a picker looks for an object, as often as the original draws an image [Hz]."""
AHEAD = np.array([[1.0, 0.0, 0.0]])
"""Direction of the ray."""


@dataclass(frozen=True, kw_only=True)
class ObjectPickerSpec(DeviceSpec):
    """An ``<objectPicker>``; it rides on the link's visual frame.

    It releases what it holds, and picks nothing up, while the last ``std_msgs/Bool`` on the topic
    ``<name>/release`` was true.
    """

    is_left_out: ClassVar[bool] = True
    message_type: ClassVar[type] = Range

    name: str
    """Its name."""
    relative_to: str
    """The link it rides on."""
    range: float = element(minimum=0)
    """Length of the ray [m]."""
    visible: bool = False
    """Read and not used: the ray is always drawn."""
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Position of the device in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Orientation of the device in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """Viewing target at the start, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. It stays fixed to its link."""

    @property
    def release_topic(self) -> str:
        """Name of the topic on which it is told to release what it holds."""
        return f"{self.name}/release"

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """The topic of its release."""
        return (DeviceTopic(name=self.release_topic, is_heard=True),)

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> ObjectPicker:
        """Mount it on its link; raises UnknownName if the vehicle has no such link."""
        mount = vehicle.mount(self, visual=True)
        picker = ObjectPicker(self, mount, world, vehicle)
        world.bus.subscribe(self.release_topic, Bool, picker.command)
        world.every(RATE, picker.look)
        return picker


@dataclass(slots=True)
class PickerState(Record):
    """What an object picker holds."""

    distance: float
    """The distance at which it took it [m]."""
    held: int | None = None
    """The number of the object that it holds."""
    is_released: bool = False
    """Whether it takes nothing."""


class ObjectPicker(Device):
    """A ray that takes what it hits; it measures the distance to it, as a range sensor does.

    Not modelled: how it holds; whatever is within the range of its ray is fixed to its link.
    """

    def __init__(
        self, spec: ObjectPickerSpec, mount: Body, world: DeviceWorld, vehicle: DeviceVehicle
    ) -> None:
        self._spec, self._mount, self._world, self._vehicle = spec, mount, world, vehicle
        self.state: PickerState = PickerState(spec.range)

    def command(self, message: Bool) -> None:
        """Release what it holds, or look for an object again."""
        self.state.is_released = bool(message.data)
        if self.state.is_released and self.state.held is not None:
            self._vehicle.let_go(self.state.held)
            self.state.held = None

    def look(self) -> None:
        """Take the first object in its ray, if it holds none."""
        if self.state.held is not None or self.state.is_released:
            return
        distance, surface = self._cast()
        thing = self._world.catchable(surface)
        if thing is not None and distance <= self._spec.range:
            self._vehicle.hold(thing, self._spec.relative_to)
            self.state.held, self.state.distance = thing, distance

    def sample(self, time: float) -> Range:
        """Measure now, at ``time`` [s]: the distance at which it took what it holds."""
        spec, state = self._spec, self.state
        distance = min(self._cast()[0], spec.range) if state.held is None else state.distance
        return Range(
            header=header(time, spec.name),
            radiation_type=Range.ULTRASOUND,
            field_of_view=0.0,
            min_range=0.0,
            max_range=spec.range,
            range=distance,
        )

    def _cast(self) -> tuple[float, int]:
        """Distance to the first surface [m], and its number."""
        hits = self._world.rays.cast(self._mount.world_from_body, AHEAD, self._spec.range)
        return float(hits.distance[0]), int(hits.surface[0])
