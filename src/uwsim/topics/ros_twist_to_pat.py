"""ROSTwistToPAT, u:ROSCmdVelToPAT: twists for a vehicle; a simulated one holds the last twist.

.. code-block:: xml

    <u:ROSCmdVelToPAT>
      <topic>/cmd_vel</topic> <vehicleName>girona500</vehicleName>
    </u:ROSCmdVelToPAT>

A velocity moves a vehicle that is not simulated for the interval since the previous velocity of its
interface (0 for the first, or after more than 1 s). The interval is in simulation time; the
original uses wall time.

``cmd_vel``, as common teleoperation programs send it, is a Twist in the axes of REP 103: x forward,
y to the left, z up. A vehicle whose z axis points down at the start, as those of UWSim do, has
forward, right and down as its axes: y and z of both vectors change sign. Not modelled: a stop of
the vehicle when the program stops sending; a simulated one holds the last twist.
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
"""The fields of a TwistStamped."""
CMD_VEL = tuple(f"{part}.{axis}" for part in ("linear", "angular") for axis in "xyz")
"""The fields of a Twist."""
MAX_GAP = 1.0
"""The longest interval between two velocities after which the second moves the vehicle [s]."""


@dataclass(frozen=True, kw_only=True)
class ROSTwistToPATSpec(VehicleTopicSpec):
    """A subscription that moves a vehicle by geometry_msgs/TwistStamped in its own axes.

    It moves for the interval since the previous message; after more than 1 s it does not move.
    """

    subscribes: ClassVar[bool] = True

    messages: ClassVar[Mapping[str, type]] = {"topic": TwistStamped}

    def bind(self, world: TopicWorld) -> TwistCommand:
        """Start to subscribe; raises UnknownName if there is no such vehicle."""
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
    """A command that moves a vehicle by one step of a twist, or that its autopilot holds."""

    def __init__(self, vehicle: Vehicle, gap: Gap) -> None:
        self._vehicle, self._gap = vehicle, gap
        self.state: GapState = gap.state

    def apply_command(self, twist: Twist) -> None:
        """Apply a twist in the base's axes; one that is not finite is ignored."""
        time = self._gap.measure()
        v, w = twist.linear, twist.angular
        numbers = [float(x) for x in (v.x, v.y, v.z, w.x, w.y, w.z)]
        if not all(map(math.isfinite, numbers)):
            return
        if (autopilot := self._vehicle.autopilot) is not None:
            autopilot.command(numbers[:3], numbers[3:])
            return
        step = np.clip(numbers, -MAX_COMMAND, MAX_COMMAND) * time  # (6,) [m, rad]
        before_from_after = Pose(step[:3], rotation_from_xyz(*step[3:].tolist()))
        self._vehicle.place(self._vehicle.world_from_base @ before_from_after)


@dataclass(frozen=True, kw_only=True)
class ROSCmdVelToPATSpec(VehicleTopicSpec):
    """A subscription that moves a vehicle by geometry_msgs/Twist: x forward, y left, z up.

    It moves for the interval since the previous message; after more than 1 s it does not move.
    """

    subscribes: ClassVar[bool] = True

    messages: ClassVar[Mapping[str, type]] = {"topic": Twist}

    def bind(self, world: TopicWorld) -> CmdVelCommand:
        """Start to subscribe; raises UnknownName if there is no such vehicle."""
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
    """A command that moves a vehicle by twists in the axes of REP 103."""

    def __init__(self, twist: TwistCommand, sign: float) -> None:
        self._twist, self._sign = twist, sign
        self.state: GapState = twist.state

    def apply_command(self, twist: Twist) -> None:
        """Apply a twist: forward, left, up."""
        v, w, sign = twist.linear, twist.angular, self._sign
        self._twist.apply_command(
            Twist(
                linear=Vector3(v.x, sign * v.y, sign * v.z),
                angular=Vector3(w.x, sign * w.y, sign * w.z),
            )
        )


@dataclass(slots=True)
class GapState(Record):
    """The time of the last velocity."""

    last_step: int | None = None
    """The step at which it arrived."""


class Gap:
    """The interval between two velocities."""

    def __init__(self, world: TopicWorld) -> None:
        self._world = world
        self.state = GapState()
        """The time of the last velocity."""

    def measure(self) -> float:
        """Return the time since the last call [s]; 0 for the first or after `MAX_GAP`."""
        now, last_step = self._world.step, self.state.last_step
        self.state.last_step = now
        gap = 0.0 if last_step is None else (now - last_step) * self._world.timestep
        return gap if gap <= MAX_GAP else 0.0
