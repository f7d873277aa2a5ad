"""A device that picks up the first object on its ray along +x.

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
"""The rate of the search for an object: the rate of images of the original UWSim [Hz]."""
RAY_DIRECTION = np.array([[1.0, 0.0, 0.0]])
"""The direction of the ray in the picker's frame, (1, 3)."""


@dataclass(frozen=True, kw_only=True)
class ObjectPickerSpec(DeviceSpec):
    """An ``<objectPicker>``; it is mounted on the link's visual frame.

    It releases the held object, and picks nothing up, while the last ``std_msgs/Bool`` on the topic
    ``<name>/release`` was true.
    """

    is_left_out: ClassVar[bool] = True
    message_type: ClassVar[type] = Range

    name: str
    """The name of the device."""
    relative_to: str
    """The link on which the device is mounted."""
    range: float = element(minimum=0)
    """The length of the ray [m]."""
    visible: bool = False
    """True if the ray is visible; read but not used, as the ray is always drawn."""
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The position of the device in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """The orientation of the device in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """The viewing target at the start, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. The device stays fixed to its link."""

    @property
    def release_topic(self) -> str:
        """The name of the topic that commands the release of the held object."""
        return f"{self.name}/release"

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """The topic that commands the release."""
        return (DeviceTopic(name=self.release_topic, is_subscribed=True, message_type=Bool),)

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> ObjectPicker:
        """Mount the device on its link; raise UnknownName if the vehicle has no such link."""
        mount = vehicle.mount(self, visual=True)
        picker = ObjectPicker(self, mount, world, vehicle)
        world.bus.subscribe(self.release_topic, Bool, picker.command)
        world.create_timer(RATE, picker.pick_up)
        return picker


@dataclass(slots=True)
class PickerState(Record):
    """The state of an object picker."""

    distance: float
    """The distance along the ray at which the picker picked the last object up [m]."""
    held_object: int | None = None
    """The index of the held object; None without one."""
    is_released: bool = False
    """True if the picker is commanded to pick nothing up."""


class ObjectPicker(Device):
    """A picker of the first object on a ray, and a sensor of the range along this ray.

    Not modelled: the mechanism of the grip. An object within the range is fixed to the link.
    """

    def __init__(
        self, spec: ObjectPickerSpec, mount: Body, world: DeviceWorld, vehicle: DeviceVehicle
    ) -> None:
        self._spec, self._mount, self._world, self._vehicle = spec, mount, world, vehicle
        self.state: PickerState = PickerState(spec.range)

    def command(self, message: Bool) -> None:
        """Release the held object, or search for an object again."""
        self.state.is_released = bool(message.data)
        if self.state.is_released and self.state.held_object is not None:
            self._vehicle.release(self.state.held_object)
            self.state.held_object = None

    def pick_up(self) -> None:
        """Pick up the first object on the ray, unless the picker holds one."""
        if self.state.held_object is not None or self.state.is_released:
            return
        distance, surface = self._cast()
        object_index = self._world.pickable_object(surface)
        if object_index is not None and distance <= self._spec.range:
            self._vehicle.hold(object_index, self._spec.relative_to)
            self.state.held_object, self.state.distance = object_index, distance

    def sample(self, time: float) -> Range:
        """Measure at ``time`` [s], which is now; with a held object, the distance at pick-up."""
        spec, state = self._spec, self.state
        distance = min(self._cast()[0], spec.range) if state.held_object is None else state.distance
        return Range(
            header=header(time, spec.name),
            radiation_type=Range.ULTRASOUND,
            field_of_view=0.0,
            min_range=0.0,
            max_range=spec.range,
            range=distance,
        )

    def _cast(self) -> tuple[float, int]:
        """Return the distance to the first surface [m] and its index."""
        hits = self._world.rays.cast(self._mount.world_from_body, RAY_DIRECTION, self._spec.range)
        return float(hits.distance[0]), int(hits.surface[0])
