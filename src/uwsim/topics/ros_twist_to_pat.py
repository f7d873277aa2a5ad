"""ROSTwistToPAT, u:ROSCmdVelToPAT: velocity commands (twists) for a vehicle.

.. code-block:: xml

    <u:ROSCmdVelToPAT>
      <topic>/cmd_vel</topic> <vehicleName>girona500</vehicleName>
    </u:ROSCmdVelToPAT>

A vehicle with ``u:dynamics`` holds the last twist, also when the program stops sending. Another
vehicle moves by the twist for the interval since the previous twist of the interface (0 for the
first, or after more than 1 s). The interval is in simulation time; the original uses wall time.

``cmd_vel``, as common teleoperation programs send it, is a Twist in the axes of REP 103: x forward,
y to the left, z up. A vehicle whose z axis points down at the start, as those of UWSim do, has
forward, right and down as its axes: y and z of both vectors change sign.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..base.external_values import MAX_COMMAND
from ..base.geometry import Pose, rotation_from_xyz
from ..base.message_fields import find_invalid_number
from ..base.record import Record
from ..messages import Twist, TwistStamped, Vector3
from ..vehicle import Vehicle
from .interface import Interface, TopicWorld, VehicleTopicSpec

TWIST = tuple(f"twist.{part}.{axis}" for part in ("linear", "angular") for axis in "xyz")
"""The paths of the numbers in a TwistStamped."""
CMD_VEL = tuple(f"{part}.{axis}" for part in ("linear", "angular") for axis in "xyz")
"""The paths of the numbers in a Twist."""
MAX_GAP = 1.0
"""The longest interval for which a twist moves a vehicle without ``u:dynamics`` [s]."""


@dataclass(frozen=True, kw_only=True)
class ROSTwistToPATSpec(VehicleTopicSpec):
    """A subscription that moves a vehicle by geometry_msgs/TwistStamped in the vehicle's axes.

    It moves for the interval since the previous message; after more than 1 s it does not move.
    """

    subscribes: ClassVar[bool] = True

    messages: ClassVar[Mapping[str, type]] = {"topic": TwistStamped}

    def bind(self, world: TopicWorld) -> TwistCommand:
        """Start to subscribe; raise UnknownName if there is no such vehicle."""
        command = TwistCommand(world.vehicle(self.vehicle_name), Gap(world))
        apply_command = world.defer_to_next_step(command.apply_command)
        world.bus.subscribe(
            self.topic,
            TwistStamped,
            lambda m: apply_command(m.twist),
            remark=lambda m: find_invalid_number(m, TWIST, MAX_COMMAND),
        )
        return command


class TwistCommand(Interface):
    """The application of twists in base axes to a vehicle or its autopilot."""

    def __init__(self, vehicle: Vehicle, gap: Gap) -> None:
        self._vehicle, self._gap = vehicle, gap
        self.state: GapState = gap.state

    def apply_command(self, twist: Twist) -> None:
        """Apply a twist, in the axes of the base; one that is not finite is ignored."""
        interval = self._gap.measure()
        v, w = twist.linear, twist.angular
        numbers = [float(x) for x in (v.x, v.y, v.z, w.x, w.y, w.z)]
        if not all(map(math.isfinite, numbers)):
            return
        if (autopilot := self._vehicle.autopilot) is not None:
            autopilot.set_twist(numbers[:3], numbers[3:])
            return
        motion = np.clip(numbers, -MAX_COMMAND, MAX_COMMAND) * interval  # (6,) [m, rad]
        before_from_after = Pose(motion[:3], rotation_from_xyz(*motion[3:].tolist()))
        self._vehicle.place(self._vehicle.world_from_base @ before_from_after)


@dataclass(frozen=True, kw_only=True)
class ROSCmdVelToPATSpec(VehicleTopicSpec):
    """A subscription that moves a vehicle by geometry_msgs/Twist: x forward, y left, z up.

    It moves for the interval since the previous message; after more than 1 s it does not move.
    """

    subscribes: ClassVar[bool] = True

    messages: ClassVar[Mapping[str, type]] = {"topic": Twist}

    def bind(self, world: TopicWorld) -> CmdVelCommand:
        """Start to subscribe; raise UnknownName if there is no such vehicle."""
        vehicle = world.vehicle(self.vehicle_name)
        z_points_up = vehicle.world_from_base.rotation[2, 2] > 0.0
        command = CmdVelCommand(TwistCommand(vehicle, Gap(world)), 1.0 if z_points_up else -1.0)
        world.bus.subscribe(
            self.topic,
            Twist,
            world.defer_to_next_step(command.apply_command),
            remark=lambda m: find_invalid_number(m, CMD_VEL, MAX_COMMAND),
        )
        return command


class CmdVelCommand(Interface):
    """The application of twists in the axes of REP 103.

    Args:
        twist: the application of twists in base axes.
        sign: -1 if the base's y and z axes point to the right and down, else 1.
    """

    def __init__(self, twist: TwistCommand, sign: float) -> None:
        self._twist, self._sign = twist, sign
        self.state: GapState = twist.state

    def apply_command(self, twist: Twist) -> None:
        """Apply a twist with the axes forward, left, up."""
        v, w, sign = twist.linear, twist.angular, self._sign
        self._twist.apply_command(
            Twist(
                linear=Vector3(v.x, sign * v.y, sign * v.z),
                angular=Vector3(w.x, sign * w.y, sign * w.z),
            )
        )


@dataclass(slots=True)
class GapState(Record):
    """The step of the last velocity command."""

    last_step: int | None = None
    """The step at which the command was applied; None before the first command."""


class Gap:
    """The interval between two velocity commands."""

    def __init__(self, world: TopicWorld) -> None:
        self._world = world
        self.state = GapState()
        """The step of the last velocity command."""

    def measure(self) -> float:
        """Return the time since the last call [s]; 0 for the first call or beyond `MAX_GAP`."""
        now, last_step = self._world.step, self.state.last_step
        self.state.last_step = now
        gap = 0.0 if last_step is None else (now - last_step) * self._world.timestep
        return gap if gap <= MAX_GAP else 0.0
