"""ROSJointStateToArm: commands the joints of a vehicle, by servos if it is simulated.

Positions, else velocities, else efforts. The joints of a vehicle that is not simulated are put
there, clamped to their limits, or moved by one step of the velocities. Not modelled: that a
command is refused when the arm would touch something.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..base.geometry import Array
from ..base.message_fields import find_invalid_number
from ..messages import JointState
from ..vehicle import Numbers, Servos, Vehicle
from .interface import Interface, TopicWorld, VehicleTopicSpec
from .ros_twist_to_pat import Gap, GapState

MAX_VALUE = sys.float_info.max
"""Of joints and servos the limits are those in the robot file."""


@dataclass(frozen=True, kw_only=True)
class ROSJointStateToArmSpec(VehicleTopicSpec):
    """Moves the joints of a vehicle by sensor_msgs/JointState."""

    subscribes: ClassVar[bool] = True

    messages: ClassVar[Mapping[str, type]] = {"topic": JointState}

    def bind(self, world: TopicWorld) -> JointCommand:
        """Listen from now on; raises UnknownName if there is no such vehicle."""
        command = JointCommand(world.vehicle(self.vehicle_name), Gap(world))
        world.bus.subscribe(
            self.topic,
            JointState,
            world.at_next_step(command.obey),
            remark=lambda m: find_invalid_number(m, [field_that_counts(m)], MAX_VALUE),
        )
        return command


def field_that_counts(message: JointState) -> str:
    """Positions, else velocities, else efforts."""
    if message.position.size:
        return "position"
    return "velocity" if message.velocity.size else "effort"


class JointCommand(Interface):
    """Moves the joints of a vehicle."""

    def __init__(self, vehicle: Vehicle, gap: Gap) -> None:
        self._vehicle, self._gap = vehicle, gap
        self._names = list(vehicle.joint_names)
        self._named: list[str] = []  # by the newest message
        self._places: Numbers = np.arange(len(self._names))  # of those in the joint vector, or -1
        self.state: GapState = gap.state

    def obey(self, message: JointState) -> None:
        """Take positions, else velocities, else efforts."""
        servos = self._vehicle.servos
        if servos is not None:
            self._steer(servos, message)
            return
        joints = self._vehicle.joints  # (n,) [rad or m]
        if message.position.size:
            numbers, values = self._numbered(message, message.position)
            joints[numbers] = values
        elif message.velocity.size:
            numbers, values = self._numbered(message, message.velocity)
            joints[numbers] += values * self._gap.take()
        self._vehicle.set_joints(joints)

    def _steer(self, servos: Servos, message: JointState) -> None:
        if message.position.size:
            servos.aim(*self._numbered(message, message.position))
        elif message.velocity.size:
            servos.drive(*self._numbered(message, message.velocity))
        else:
            servos.push(*self._numbered(message, message.effort))

    def _numbered(self, message: JointState, given: Array) -> tuple[Numbers, Array]:
        """The joints and their values, (n,) each; by name, or without names in order.

        Left out are unknown joints and values that are not finite; of a joint that is named twice
        the last value counts.
        """
        if message.name != self._named:
            self._named = list(message.name)
            named = self._named or self._names
            self._places = np.array([self._place(name) for name in named], np.int64)
        n = min(len(self._places), len(given))
        places, values = self._places[:n], np.array(given[:n], dtype=np.float64)
        last = {
            place: i
            for i, (place, value) in enumerate(zip(places.tolist(), values.tolist(), strict=True))
            if place >= 0 and math.isfinite(value)
        }
        if len(last) == n:
            return places, values
        chosen = list(last.values())
        return places[chosen], values[chosen]

    def _place(self, name: str) -> int:
        """Number of a joint in the joint vector; below 0 there is none."""
        return self._names.index(name) if name in self._names else -1
