"""The commands of thrusters that an autopilot has applied, as a topic: recordings then hold them.

The topic ``<vehicle>/autopilot/thrusters`` carries std_msgs/Float64MultiArray: one value from -1 to
1 for each thruster, in the order of the vehicle's hydrodynamics file, at each exchange with the
autopilot. The message of an exchange has the time of the step that applies its commands.
"""

from __future__ import annotations

from ..base.geometry import Array
from ..bus import Bus
from ..messages import Float64MultiArray
from .device import DeviceVehicle


class AppliedCommands:
    """The publisher of the commands that an autopilot has applied to a vehicle.

    Args:
        bus: the topics.
        vehicle: the vehicle.
    """

    def __init__(self, bus: Bus, vehicle: DeviceVehicle) -> None:
        topic = f"{vehicle.name}/autopilot/thrusters"
        self._publish = bus.publisher(topic, Float64MultiArray, owner=self)
        self._has_subscribers = bus.make_subscriber_check(topic)

    def publish(self, commands: Array) -> None:
        """Publish the command of each thruster, (n,) [-1..1], if anything reads the topic."""
        if self._has_subscribers():
            self._publish(Float64MultiArray(data=commands.copy()))
