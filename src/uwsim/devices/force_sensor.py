r"""The wrench of contacts on a link, or that at its joint.

.. code-block:: xml

    <ForceSensor>
      <name>ForceG500</name> <target>base_link</target>
      <offsetp> <x>-0.2</x> <y>0.75</y> <z>0</z> </offsetp>
      <offsetr> <x>-1.57</x> <y>0</y> <z>3.14</z> </offsetr>
    </ForceSensor>

It measures what other bodies do to the link where they touch it: a box of mass m and volume V that
rests on it weighs :math:`(m - \rho V) g`. The link's own weight, the water and its joints are not
measured. Without physics nothing is touched, and all is 0.

``<u:measures>joint</u:measures>`` makes it a force-torque sensor in the joint that carries the
link, as in a wrist: it measures what the link, and all that is beyond it or held by it, does to
that joint by weight, contacts and inertia, and by the water's buoyancy, drag and added mass. A
weight that hangs on it pulls down. Only a vehicle with ``<u:dynamics>`` has such forces.
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
    """A ``<ForceSensor>``; it rides on the link's visual frame.

    Force [N] and torque about the sensor [N m] of the contacts on the link in the last step, in
    the sensor's axes.
    """

    message_type: ClassVar[type] = WrenchStamped
    is_pure: ClassVar[bool] = True

    name: str
    """Its name."""
    target: str
    """The link it belongs to."""
    offsetp: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), original=REQUIRED_BY_DTD)
    """Of the sensor on the link [m]."""
    offsetr: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), original=REQUIRED_BY_DTD)
    """Of the sensor on the link, about x, y, z: Rz Ry Rx [rad]."""
    measures: Literal["contacts", "joint"] = element(namespaced=True, default="contacts")
    """The wrench of the ``contacts`` on the link, or that of the link on the ``joint`` that carries
    it."""

    @property
    def relative_to(self) -> str:
        """The link."""
        return self.target

    @property
    def position(self) -> tuple[float, float, float]:
        """In the link's visual frame [m]."""
        return self.offsetp

    @property
    def orientation(self) -> tuple[float, float, float]:
        """Fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
        return self.offsetr

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> ForceSensor:
        """Mount it on its link; raises UnknownName if the vehicle has no such link."""
        at_joint = self.measures == "joint"
        return ForceSensor(self, vehicle.wrench_sampler(self, at_joint=at_joint, visual=True))


class ForceSensor(Device, CompiledSensor):
    """Force and torque of the contacts on a link, or at its joint."""

    def __init__(self, spec: ForceSensorSpec, sampler: Sampler) -> None:
        self._name = spec.name
        self.sampler = sampler
        """The sampler of force [N] and torque [N m], 6 numbers."""

    def message(self, time: float, values: Array) -> WrenchStamped:
        """Make the message of a sample taken at ``time`` [s]."""
        x, y, z, roll, pitch, yaw = values.tolist()
        wrench = Wrench(force=Vector3(x=x, y=y, z=z), torque=Vector3(x=roll, y=pitch, z=yaw))
        return WrenchStamped(header=header(time, self._name), wrench=wrench)
