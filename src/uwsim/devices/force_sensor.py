r"""The wrench of contacts on a link, or that at its joint.

.. code-block:: xml

    <ForceSensor>
      <name>ForceG500</name> <target>base_link</target>
      <offsetp> <x>-0.2</x> <y>0.75</y> <z>0</z> </offsetp>
      <offsetr> <x>-1.57</x> <y>0</y> <z>3.14</z> </offsetr>
    </ForceSensor>

It measures the contact forces of other bodies on the link: for a box of mass m and volume V on it
the weight :math:`(m - \rho V) g`. The link's own weight, the water and its joints are not measured.
Without physics there are no contacts, and all is 0.

``<u:measures>joint</u:measures>`` makes it a force-torque sensor in the joint that carries the
link, as in a wrist. It measures the wrench on that joint of the link and of all that is beyond it
or held by it: weight, contacts, inertia, and the water's buoyancy, drag and added mass. The weight
of a held object points down. Only a vehicle with ``<u:dynamics>`` has such forces.
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

    Force [N] and torque about the sensor [N m] of the contacts on the link in the last step, in
    the sensor's axes.
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
    """The orientation of the sensor in the link's visual frame, about x, y, z: Rz Ry Rx [rad]."""
    measures: Literal["contacts", "joint"] = element(namespaced=True, default="contacts")
    """The measured wrench: that of the ``contacts`` on the link, or that of the link on the
    ``joint`` that carries it."""

    @property
    def relative_to(self) -> str:
        """The link."""
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
        """Mount the sensor on its link; raises UnknownName if the vehicle has no such link."""
        at_joint = self.measures == "joint"
        return ForceSensor(self, vehicle.wrench_sampler(self, at_joint=at_joint, visual=True))


class ForceSensor(Device, CompiledSensor):
    """The force and torque of the contacts on a link, or at its joint."""

    def __init__(self, spec: ForceSensorSpec, sampler: Sampler) -> None:
        self._name = spec.name
        self.sampler = sampler
        """The sampler of force [N] and torque [N m], 6 numbers."""

    def message(self, time: float, values: Array) -> WrenchStamped:
        """Create the message of a sample taken at ``time`` [s]."""
        x, y, z, roll, pitch, yaw = values.tolist()
        wrench = Wrench(force=Vector3(x=x, y=y, z=z), torque=Vector3(x=roll, y=pitch, z=yaw))
        return WrenchStamped(header=header(time, self._name), wrench=wrench)
