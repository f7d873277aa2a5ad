"""ROSJointStateToArm: commands for the joints of a vehicle.

The first nonempty field of positions, velocities and efforts is applied. In a vehicle with
``u:dynamics`` these are setpoints of servos. In another vehicle joints are set to the positions,
clamped to their limits, or moved by the velocities for the interval since the previous velocities;
efforts are ignored. Not modelled: the refusal of a command because of a collision of the arm.
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
from ..vehicle import JointIndices, Servos, Vehicle
from .interface import Interface, TopicWorld, VehicleTopicSpec
from .ros_twist_to_pat import Gap, GapState

MAX_VALUE = sys.float_info.max
"""The greatest value accepted: any finite one, as the robot file limits joints and servos."""


@dataclass(frozen=True, kw_only=True)
class ROSJointStateToArmSpec(VehicleTopicSpec):
    """A subscription to commands for the joints of a vehicle as sensor_msgs/JointState."""

    subscribes: ClassVar[bool] = True

    messages: ClassVar[Mapping[str, type]] = {"topic": JointState}

    def bind(self, world: TopicWorld) -> JointCommand:
        """Start to subscribe; raise UnknownName if there is no such vehicle."""
        command = JointCommand(world.vehicle(self.vehicle_name), Gap(world))
        world.bus.subscribe(
            self.topic,
            JointState,
            world.defer_to_next_step(command.apply_command),
            remark=lambda m: find_invalid_number(m, [used_field(m)], MAX_VALUE),
        )
        return command


def used_field(message: JointState) -> str:
    """Return the name of the first nonempty field of position, velocity, effort."""
    if message.position.size:
        return "position"
    return "velocity" if message.velocity.size else "effort"


class JointCommand(Interface):
    """The application of commands to the joints of a vehicle."""

    def __init__(self, vehicle: Vehicle, gap: Gap) -> None:
        self._vehicle, self._gap = vehicle, gap
        self._joint_names = list(vehicle.joint_names)
        self._message_names: list[str] = []  # in the newest message
        self._joint_indices: JointIndices = np.arange(len(self._joint_names))  # -1: no such joint
        self.state: GapState = gap.state

    def apply_command(self, message: JointState) -> None:
        """Apply the first nonempty field of positions, velocities, efforts."""
        servos = self._vehicle.servos
        if servos is not None:
            self._command_servos(servos, message)
            return
        joints = self._vehicle.joints  # (n,) [rad or m]
        if message.position.size:
            joint_indices, values = self._select_joints(message, message.position)
            joints[joint_indices] = values
        elif message.velocity.size:
            joint_indices, values = self._select_joints(message, message.velocity)
            joints[joint_indices] += values * self._gap.measure()
        self._vehicle.set_joints(joints)

    def _command_servos(self, servos: Servos, message: JointState) -> None:
        if message.position.size:
            servos.set_position_targets(*self._select_joints(message, message.position))
        elif message.velocity.size:
            servos.set_velocity_targets(*self._select_joints(message, message.velocity))
        else:
            servos.set_efforts(*self._select_joints(message, message.effort))

    def _select_joints(self, message: JointState, commands: Array) -> tuple[JointIndices, Array]:
        """Return the indices of the joints that a message commands and their values, (n,) each.

        Joints are found by name; without names, values are in the order of the joint vector.
        Unknown joints and values that are not finite are left out. If a joint is named twice, the
        last value is used.
        """
        if message.name != self._message_names:
            self._message_names = list(message.name)
            names = self._message_names or self._joint_names
            self._joint_indices = np.array([self._joint_index(name) for name in names], np.int64)
        n = min(len(self._joint_indices), len(commands))
        joint_indices, values = self._joint_indices[:n], np.array(commands[:n], dtype=np.float64)
        last_rows = {
            index: i
            for i, (index, value) in enumerate(
                zip(joint_indices.tolist(), values.tolist(), strict=True)
            )
            if index >= 0 and math.isfinite(value)
        }
        if len(last_rows) == n:
            return joint_indices, values
        rows = list(last_rows.values())
        return joint_indices[rows], values[rows]

    def _joint_index(self, name: str) -> int:
        return self._joint_names.index(name) if name in self._joint_names else -1
