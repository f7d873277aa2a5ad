r"""The wrench of the contacts on a link, or the wrench on its joint.

.. code-block:: xml

    <ForceSensor>
      <name>ForceG500</name> <target>base_link</target>
      <offsetp> <x>-0.2</x> <y>0.75</y> <z>0</z> </offsetp>
      <offsetr> <x>-1.57</x> <y>0</y> <z>3.14</z> </offsetr>
    </ForceSensor>

The sensor measures the forces of contacts of other bodies with the link: for a box with the mass m
and the volume V that lies on the link, :math:`(m - \rho V) g`. The weight of the link, and forces
of the water and of joints are not measured. Without physics there are no contacts, and all values
are 0.

``<u:measures>joint</u:measures>`` makes it a force-torque sensor in the joint that carries the
link, as in a wrist. It measures the wrench that the link, all links beyond it and held objects
exert on that joint: by weight, contacts and inertia, and by buoyancy, drag and added mass of the
water. The weight of a held object points down. Only a vehicle with ``<u:dynamics>`` has such
forces.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from ..base.geometry import Array
from ..base.sampling import Sampler
from ..messages import Vector3, Wrench, WrenchStamped, header
from ..schema import REQUIRED_BY_DTD, element
from ..sensors.sensor import CompiledSensor
from ..world import DeviceWorld
from .device import Device, DeviceSpec, DeviceVehicle


@dataclass(frozen=True, kw_only=True)
class ForceSensorSpec(DeviceSpec):
    """A ``<ForceSensor>``; it is mounted on the link's visual frame.

    It measures the force [N] and the torque about the sensor's origin [N m] in the last step, in
    the axes of the sensor.
    """

    message_type: ClassVar[type] = WrenchStamped
    is_pure: ClassVar[bool] = True

    name: str
    """The name of the sensor."""
    target: str
    """The link on which the sensor is mounted."""
    offsetp: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), original=REQUIRED_BY_DTD)
    """The position of the sensor in the link's visual frame [m]."""
    offsetr: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), original=REQUIRED_BY_DTD)
    """The roll, pitch, yaw of the sensor in the link's visual frame: Rz Ry Rx [rad]."""
    measures: Literal["contacts", "joint"] = element(namespaced=True, default="contacts")
    """The measured wrench: that of the ``contacts`` on the link, or that on the ``joint`` that
    carries the link."""

    @property
    def relative_to(self) -> str:
        """The name of the link."""
        return self.target

    @property
    def position(self) -> tuple[float, float, float]:
        """The position in the link's visual frame [m]."""
        return self.offsetp

    @property
    def orientation(self) -> tuple[float, float, float]:
        """The fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
        return self.offsetr

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> ForceSensor:
        """Mount the sensor on its link; raise UnknownName if the vehicle has no such link."""
        at_joint = self.measures == "joint"
        return ForceSensor(self, vehicle.wrench_sampler(self, at_joint=at_joint, visual=True))


class ForceSensor(Device, CompiledSensor):
    """The force and torque of the contacts on a link, or on its joint."""

    def __init__(self, spec: ForceSensorSpec, sampler: Sampler) -> None:
        self._name = spec.name
        self.sampler = sampler
        """The sampler of force [N] and torque [N m], 6 numbers."""

    def message(self, time: float, values: Array) -> WrenchStamped:
        """Create the message of a sample taken at ``time`` [s]."""
        x, y, z, torque_x, torque_y, torque_z = values.tolist()
        torque = Vector3(x=torque_x, y=torque_y, z=torque_z)
        wrench = Wrench(force=Vector3(x=x, y=y, z=z), torque=torque)
        return WrenchStamped(header=header(time, self._name), wrench=wrench)
