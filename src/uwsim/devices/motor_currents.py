r"""The currents that the motors of a vehicle draw, thrusters first, then joints.

.. code-block:: xml

    <u:motorCurrents> <name>currents</name> <voltage>24</voltage> <std>0.01</std> </u:motorCurrents>

A motor with the electric power P at a supply with the voltage V draws :math:`I = P / V`. P is the
power of the measure ``<u:energy>``: a function of a thruster's thrust, or of a joint's torque and
speed with the efficiency and copper loss of its drive in the vehicle's hydrodynamics file. Not
modelled: the currents of the windings, which differ where the electronics lower the voltage.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..base.record import RandomState
from ..messages import JointState, header
from ..schema import element
from ..world import Actuators, DeviceWorld
from .device import Device, DeviceSpec, DeviceVehicle


@dataclass(frozen=True, kw_only=True)
class MotorCurrentsSpec(DeviceSpec):
    """A ``<u:motorCurrents>``; currents [A] are the ``effort`` of sensor_msgs/JointState."""

    message_type: ClassVar[type] = JointState

    name: str
    """The name of the device."""
    voltage: float = element(default=24.0, exclusive_minimum=0.0, maximum=10000.0)
    """The voltage of the supply [V]."""
    std: float = element(default=0.0, minimum=0.0, maximum=1e6)
    """The standard deviation of the noise of each current [A]."""

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> MotorCurrents:
        """Resolve the motors; a kinematic vehicle has none."""
        rng = world.stream(f"{vehicle.name}/{self.name}/noise")
        return MotorCurrents(self, world.actuators(vehicle.name), rng)


class MotorCurrents(Device):
    """The currents of thrusters and joints."""

    def __init__(
        self, spec: MotorCurrentsSpec, actuators: Actuators | None, rng: np.random.Generator
    ) -> None:
        self._spec, self._actuators = spec, actuators
        self.state: RandomState = RandomState(rng)

    def sample(self, time: float) -> JointState:
        """Measure at ``time`` [s], which is now."""
        stamp = header(time, self._spec.name)
        if self._actuators is None:
            return JointState(header=stamp)
        currents = self._actuators.powers() / self._spec.voltage
        if self._spec.std > 0.0:
            currents += self._spec.std * self.state.rng.standard_normal(len(currents))
        names = [*self._actuators.thrusters, *self._actuators.joints]
        return JointState(header=stamp, name=names, effort=currents)
