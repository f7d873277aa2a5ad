"""u:ROSCmdVelToPAT: moves a vehicle by ``cmd_vel``, as common teleoperation programs send it.

.. code-block:: xml

    <u:ROSCmdVelToPAT>
      <topic>/cmd_vel</topic> <vehicleName>girona500</vehicleName>
    </u:ROSCmdVelToPAT>

A Twist is in the axes of REP 103: x forward, y to the left, z up. A vehicle whose z axis points
down at the start, as those of UWSim do, has forward, right and down as its axes: y and z of both
vectors change sign. All else is as with ROSTwistToPAT. Not modelled: that a vehicle stops when the
program is silent; a simulated one holds the last twist.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from ..message_fields import odd_number
from ..messages import Twist, Vector3
from ..vehicle import MAX_COMMAND
from .interface import Interface, TopicWorld, VehicleTopicSpec
from .ros_twist_to_pat import Gap, TwistCommand

TWIST = tuple(f"{part}.{axis}" for part in ("linear", "angular") for axis in "xyz")
"""Numbers of a Twist."""


@dataclass(frozen=True, kw_only=True)
class ROSCmdVelToPATSpec(VehicleTopicSpec):
    """Moves a vehicle by geometry_msgs/Twist: x forward, y to the left, z up (REP 103).

    It goes on for the time since the message before; nothing is held after more than 1 s.
    """

    subscribes: ClassVar[bool] = True

    messages: ClassVar[Mapping[str, type]] = {"topic": Twist}

    def bind(self, world: TopicWorld) -> CmdVelCommand:
        """Listen from now on; raises UnknownName if there is no such vehicle."""
        vehicle = world.vehicle(self.vehicle_name)
        z_points_up = vehicle.world_from_base.rotation[2, 2] > 0.0
        command = CmdVelCommand(TwistCommand(vehicle, Gap(world)), 1.0 if z_points_up else -1.0)
        world.bus.subscribe(
            self.topic,
            Twist,
            lambda m: world.at_next_step(command.apply_command, m),
            remark=lambda m: odd_number(m, TWIST, MAX_COMMAND),
        )
        return command


class CmdVelCommand(Interface):
    """Moves a vehicle by twists in the axes of REP 103."""

    STATE = ("_twist",)
    """Attributes of its state, for snapshots."""

    def __init__(self, twist: TwistCommand, sign: float) -> None:
        self._twist, self._sign = twist, sign

    def apply_command(self, twist: Twist) -> None:
        """Apply a twist: forward, left, up."""
        v, w, sign = twist.linear, twist.angular, self._sign
        self._twist.obey(
            Twist(
                linear=Vector3(v.x, sign * v.y, sign * v.z),
                angular=Vector3(w.x, sign * w.y, sign * w.z),
            )
        )
